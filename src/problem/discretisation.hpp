// From the entries of a scene and the mesh to the equations of the bodies, contact apart.
#pragma once

#include "fem/assembly.hpp"
#include "fem/constraints.hpp"
#include "problem/entries.hpp"
#include "problem/multipoint_supports.hpp"

namespace mortise {

struct Discretisation {
  Model model;
  std::vector<ElasticLaw> laws;  ///< one a body
  SaddlePointSystem system;      ///< of the bodies; contact adds its rows (contact_pair.hpp)
  VecX initial_load;             ///< the part of system.f that initial strains make
  double initial_energy = 0;     ///< of the initial strains held at zero strain
  /// Sums of the forces of each of Entries::boundaries (zero of prescribed displacements) and Entries::body_forces.
  std::vector<Resultant> boundary_sums, body_sums;
  Resultant weight;  ///< of all bodies, by Entries::gravity
  MultipointSupports multipoint;
  SparseMatrix springs;  ///< the part of system.K that foundations make; without any it has no columns
};

/// Throws SceneError where two values are prescribed at one node, or a field has no value.
Discretisation discretise(const Entries& entries, const Mesh& mesh);

/// What the entries' loads, prescribed values and initial strains make, anew: for entries of the same kinds at the same
/// places on the same bodies. K, springs, scales stay. Throws as discretise.
void take_loads(const Entries& entries, const Mesh& mesh, Discretisation& discretisation);

/// Forces of the foundations on the nodes.
VecX spring_forces(const Discretisation& discretisation, const VecX& u);

/// Strain energy of the bodies, without foundations', 1/2 int (eps - eps0) : C : (eps - eps0), times depth
/// (model/model.hpp): J/m of a plane model in SI, J of rings.
double strain_energy(const Discretisation& discretisation, const VecX& u);
/// The same of K u that is known.
double strain_energy(const Discretisation& discretisation, const VecX& u, const VecX& Ku);

}  // namespace mortise
