// How thick a body is behind its contact curve.
#pragma once

#include "mesh/boundary_edges.hpp"
#include "mesh/curve.hpp"

namespace mortise {

/// The edges around a body. Bodies that share nodes (`bonded`: bonded_to) are one here: a layer on its ground is as
/// thick as both.
std::vector<Edge> outline(const BoundaryEdges& boundary, const std::vector<int>& bonded, int body);

/// For each edge of the curve, the length of the line from its middle along its inward normal to where that first
/// leaves the body. `outline` is that of the curve's body; its 3-node edges count as two straight ones.
std::vector<double> thickness_behind(const Points& nodes, const Curve& curve, const std::vector<Edge>& outline);

}  // namespace mortise
