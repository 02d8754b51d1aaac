// What p would be along the normals of the opposite sides.
#pragma once

#include <optional>
#include <vector>

#include "results/results.hpp"

namespace mortise {

struct OtherNormals {
  double part = 0;               ///< of p, in L2, by which it changes
  Vec2 position = Vec2::Zero();  ///< where it changes and the normals differ, the most of both
  double angle = 0;              ///< radians: between the normals of both sides there
};

/// Contact acts along the multiplier side's normals, of the undeformed body; the opposite side's would do as well, and
/// where the sides slide along one another by s and the normals differ by the angle a, the gaps differ by s a. p of
/// each pair with the other sides' normals, to first order: K du + B^T dl = -dB^T l, B du = -dB u on closed rows; of
/// unilateral contact the change is nowhere more than sqrt(2) p, as p that is lost stands elsewhere. A spin of a whole
/// circle that is the multiplier side counts for nothing (line_motion.hpp). `least`: a part that matters; where all are
/// far less, by what half-planes would do, they are left at 0. Nothing of pairs that the answer does not tell: whose
/// faces give way or are facets, or where the solver has no factor.
std::vector<std::optional<OtherNormals>> other_normals(const Results& results, double least);

}  // namespace mortise
