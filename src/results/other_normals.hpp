// What p would be along the normals of the opposite sides.
#pragma once

#include <optional>
#include <vector>

#include "results/results.hpp"

namespace mortise {

struct OtherNormals {
  double part;    ///< of its mean, by which p changes
  Vec2 position;  ///< of the largest p
  double angle;   ///< radians: between the normals of both sides there
};

/// Contact acts along the multiplier side's normals. Where the opposite side's have another direction all along, as
/// of a wedge in a slot that leans by a little more, the faces turn against one another until they have one, which
/// small displacements know nothing of: either side's would do. p of each pair with the other side's in those whose
/// normals agree nowhere in contact, to first order: K du + B^T dl = -dB^T l, B du = -dB u on closed rows. Nothing
/// where there are none, or where the solver has no factor.
std::vector<std::optional<OtherNormals>> other_normals(const Results& results);

}  // namespace mortise
