// Stiffness and loads. Degree of freedom 2 i + c is component c of the displacement of node i.
#pragma once

#include <functional>
#include <vector>

#include "fem/material.hpp"
#include "mesh/mesh.hpp"
#include "model/resultant.hpp"

namespace mortise {

/// K_ab = int B_a^T C B_b (docs/theory.md eq. 4), lower triangle, 2 nodes x 2 nodes, stress times depth
/// (model/model.hpp). `laws` holds one law a body. Its columns are shared out over `threads`; K does not depend on
/// them.
SparseMatrix assemble_stiffness(const Mesh& mesh, const std::vector<ElasticLaw>& laws, int threads = 1);

/// A force per volume as a function of the place; empty: none.
using BodyForce = std::function<Vec2(const Vec2& position)>;

/// load += int N b over the bodies, one b a body. Returns their sum.
Resultant add_body_forces(const Mesh& mesh, const Model& model, const std::vector<BodyForce>& forces, VecX& load);

/// Traction (force per area) on a boundary as a function of the place and the outward unit normal.
using Traction = std::function<Vec2(const Vec2& position, const Vec2& normal)>;

/// load += int N t over the sides of a boundary (mesh/side_table.hpp), four Gauss points an edge. Returns their
/// sum.
Resultant add_traction(const Mesh& mesh, const Model& model, const std::vector<CellSide>& sides,
                       const Traction& traction, VecX& load);

}  // namespace mortise
