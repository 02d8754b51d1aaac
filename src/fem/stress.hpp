// Stresses recovered from the displacements.
#pragma once

#include <vector>

#include "fem/elements.hpp"
#include "fem/material.hpp"
#include "mesh/body_points.hpp"

namespace mortise {

/// Of each node's displacement the strain (11, 22, 33, gamma_12) at a point of a cell: 4 x 2 n, components alternate.
using NodalStrains = Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, 18>;
NodalStrains nodal_strains(const Cell& cell, const Model& model, const CellShape& shape, const CellPoint& at);

/// Stress (11, 22, 33, 12) at one point of a cell. `u` holds all degrees of freedom.
Vec4 stress_at(const Mesh& mesh, const Cell& cell, const ElasticLaw& law, const VecX& u, const CellShape& shape);

struct StressField {
  Stresses points;   ///< a row a body point (mesh/body_points.hpp): average over the body's cells at the node
  Stresses centres;  ///< a row a cell
};

/// Each cell's stress is sampled at its superconvergent points (fem/quadrature.hpp stress_points), extended to its
/// nodes by the polynomial through these samples, and averaged there over the cells of one body.
StressField recover_stress(const Mesh& mesh, const BodyPoints& points, const std::vector<ElasticLaw>& laws,
                           const VecX& u);

}  // namespace mortise
