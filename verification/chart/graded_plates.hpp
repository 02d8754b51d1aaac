// Two plates with elements that shrink towards the ends of the contact line, where the stress is singular.
#pragma once

#include <functional>
#include <map>

#include "mesh/mesh.hpp"

namespace mortise::chart {

/// The mesh of tests/support/two_plates (names as there) with its columns and rows moved: t in 0 ... 1/2 of the width
/// goes to (2 t)^grading / 2, mirrored, and the rows shrink towards the contact line in the same way. grading 1 is
/// even. `parameters` as those of geo/parabola_1.geo: n_upper, n_lower, order, kind, nine_node. Middle nodes lie on
/// `height`.
Mesh graded_plates(const std::function<double(double)>& height, const std::map<std::string, double>& parameters,
                   double grading);

}  // namespace mortise::chart
