// Where the stress on a contact line has no limit, so that no mesh shows it.
#pragma once

#include "contact/projection.hpp"
#include "fem/constraints.hpp"

namespace mortise {

/// A corner of either curve, or an end of it, at which the stress is singular.
struct SingularPoint {
  Vec2 position;
  double edge;  ///< length of the longest edge of either curve that meets there
};

/// Bodies of interior angles a and b that meet without friction at a corner (a or b is not straight) have singular
/// stresses there where a + b is more than a half-plane, or one of them alone is (Dundurs & Lee 1972 for a wedge on a
/// half-plane; Williams 1952). A corner on a symmetry plane counts with its mirror image; a clamped one from 60 degrees
/// on, where a free face beside it would make it singular (Williams 1952, Poisson's ratio 0.3). Angles are within 20
/// degrees, what a mesh of a curved line shows at its vertices.
std::vector<SingularPoint> singular_points(const Mesh& mesh, const Curve& first, const Curve& second,
                                           const Constraints& constraints);

}  // namespace mortise
