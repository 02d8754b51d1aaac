// How thick a body is behind its contact curve.
#pragma once

#include "mesh/curve.hpp"

namespace mortise {

/// The edges of a body's cells that no second cell has, in the cells' direction (the body lies on their left). Bodies
/// that share nodes are one here: a layer on its ground is as thick as both.
std::vector<Edge> outline(const Mesh& mesh, int body);

/// For each edge of the curve, the length of the line from its middle along its inward normal to where that first
/// leaves the body. `outline` is that of the curve's body; its 3-node edges count as two straight ones.
std::vector<double> thickness_behind(const Points& nodes, const Curve& curve, const std::vector<Edge>& outline);

}  // namespace mortise
