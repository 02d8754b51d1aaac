// Prescribed displacements, and the motions that they leave free.
#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace mortise {

/// Degrees of freedom whose displacement is given. Both have one entry a degree of freedom.
struct Constraints {
  std::vector<char> fixed;
  VecX value;  ///< length; zero where not fixed
};

Constraints no_constraints(const Mesh& mesh);

/// Prescribes component 0 or 1 on a boundary. Throws InputError, with coordinates, where another value already
/// stands at a node (boundaries may share nodes, but must agree there).
void prescribe(const Mesh& mesh, int boundary, int component, double value, Constraints& constraints);

/// True if the displacement of a node along the unit vector n is prescribed.
bool prescribed_along(const Constraints& constraints, int node, const Vec2& n);

/// A small motion of a body as a whole: u(x) = translation + rotation * (-(x2 - centre2), x1 - centre1).
struct RigidMotion {
  int body;
  Vec2 translation;
  double rotation;  ///< radians
  Vec2 centre;      ///< of the body
};

/// Motions of single bodies and of groups of bodies that neither the constraints nor `rows * u = 0` resist.
/// `rows` (m x degrees of freedom) are the contact conditions that can hold a body; m may be zero.
/// Each element is one free motion: the bodies that move in it (unit size: translations of about 1).
std::vector<std::vector<RigidMotion>> free_motions(const Mesh& mesh, const Constraints& constraints,
                                                   const SparseMatrix& rows);

/// One free unknown for each free motion of single bodies, spread as far apart as they go: springs there would hold
/// the bodies. `motions` as found without contact rows.
std::vector<int> grounding_unknowns(const Mesh& mesh, const Constraints& constraints,
                                    const std::vector<std::vector<RigidMotion>>& motions);

/// The combination of `motions` in which the grounded `unknowns` move by `values`, of unit size. One entry a body.
std::vector<RigidMotion> motion_through(const Mesh& mesh, const std::vector<std::vector<RigidMotion>>& motions,
                                        const std::vector<int>& unknowns, const VecX& values);

/// "body 'upper': translation (0, 1), rotation 0; ..." for messages.
std::string describe(const Mesh& mesh, const std::vector<RigidMotion>& motion);

}  // namespace mortise
