// From where the error sits to the element sizes of the next mesh.
#pragma once

#include "error/error_estimate.hpp"
#include "mesh/size_field.hpp"

namespace mortise {

/// Elements grow by this part of the way away from where they must be small.
inline constexpr double size_growth = 0.3;

/// Sizes at the vertices (one a node, length) with which the estimate's line() and far_field() are expected to fall by
/// these factors, with the fewest elements (docs/theory.md eq. 48 to 50): the far field by each cell's part, which
/// falls as h^6; the local error by each vertex's, h^2.5; the border of contact in proportion. Elements may also grow.
VecX wanted_sizes(const Mesh& mesh, const std::vector<ContactPair>& pairs, const ErrorEstimate& estimate,
                  double line_factor, double far_factor);

/// Layers towards every singular point of a contact line, so small that what the point does to p elsewhere is a part
/// of `error` (relative).
std::vector<SizeLayers> singular_layers(const Mesh& mesh, const ErrorEstimate& estimate, double error);

}  // namespace mortise
