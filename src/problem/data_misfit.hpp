// The variation of a scene's functions of place within elements of the mesh.
#pragma once

#include <string>

#include "fem/material.hpp"
#include "mesh/mesh.hpp"
#include "problem/entries.hpp"

namespace mortise {

/// What an entry's functions are off by, in a cell or along one of its sides, from what stands for them there in the
/// mean: a polynomial of degree 2 along an edge, 1 over a cell, of initial strains that of the stresses that are
/// recovered there (2 in quadratic cells); of prescribed displacements what the nodes make of them. Loads and
/// displacements have the right mean all the same, by quadrature that is as fine as the function. And the body that a
/// straight side of the outline cuts off the curve that it stands for, or adds to it.
struct DataMisfit {
  enum class Kind { force, foundation, strain, displacement, outline };
  Kind kind;
  int cell;
  int side = -1;  ///< of the cell; -1: the cell
  /// force: int |f - polynomial| dA. foundation: the same of the modulus, force over length. strain: the energy norm of
  /// the difference, root of an energy. displacement: int |g - g_h| dA, length times dA. outline: the volume that is
  /// missing, negative where it is too much.
  double size;
  Vec2 mean = Vec2::Zero();  ///< of a displacement: int (g - g_h) dA along x and y
  Vec2 at = Vec2::Zero();    ///< place of the largest difference
  double finest;             ///< over what length the function changes there
  /// Of loads: int |f - polynomial| dA, force or force over length, and the length over which it acts, of the cell the
  /// side of the square on which its mean would have its mean square.
  double sum = 0, spread = 0;
};

/// The same of an entry's function, in all.
struct EntryMisfit {
  std::string key;         ///< "boundary.0.pressure (line 12)"
  double part = 0;         ///< mean difference over mean size, both without sign (root mean squares over bodies)
  Vec2 at = Vec2::Zero();  ///< the largest difference of all edges or cells
  double finest = 0;       ///< over what length the function changes there,
  double size = 0;         ///< and the length of the edge or the side of the cell
};

struct DataMisfits {
  std::vector<DataMisfit> parts;     ///< where a function is not resolved
  std::vector<EntryMisfit> entries;  ///< that have any
};

/// Of all entries but gaps (error/gap_misfit.hpp). Constants cost nothing. `laws`: one a body.
DataMisfits data_misfits(const Entries& entries, const Mesh& mesh, const std::vector<ElasticLaw>& laws);

/// Where straight sides stand for a curve, as they turn at both ends by less than a corner does: on an arc of curvature
/// kappa a chord of length h leaves kappa h^3 / 12. Of bent sides, which leave less by orders, nothing, and of those
/// between bonded bodies.
std::vector<DataMisfit> outline_misfits(const Mesh& mesh, const Model& model);

}  // namespace mortise
