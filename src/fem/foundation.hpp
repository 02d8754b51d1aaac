// Elastic foundations: springs along a boundary that hold it to the ground.
#pragma once

#include <functional>
#include <vector>

#include "fem/line_cuts.hpp"
#include "mesh/mesh.hpp"
#include "model/model.hpp"

namespace mortise {

/// The springs' stiffness at a place with its outward unit normal: 2 x 2, symmetric, positive semidefinite, stress per
/// length. Of a normal foundation of modulus k (Winkler's) k n n^T.
using Foundation = std::function<Eigen::Matrix2d(const Vec2& position, const Vec2& normal)>;

/// Appends int N_a k N_b ds, times depth (model/model.hpp), over the sides of a boundary: entries of the lower triangle
/// of a matrix like the stiffness. Four Gauss points on each piece of an edge.
void add_foundation(const Mesh& mesh, const Model& model, const CutSides& on, const Foundation& foundation,
                    Triplets& entries);

/// The springs' stiffness (lower triangle given) as conditions: motions with rows * u = 0 they do not resist. Each row
/// over its largest entry, so that weak springs count as strong ones do.
SparseMatrix spring_rows(const SparseMatrix& stiffness);

/// Of each degree of freedom the springs' own stiffness over that of the elements, the diagonals' entries; 1 where no
/// element has it, 0 where no spring does. Both lower triangles.
VecX spring_parts(const SparseMatrix& stiffness, const SparseMatrix& of_elements);

}  // namespace mortise
