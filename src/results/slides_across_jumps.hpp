// What p is off by where sides slide along one another across places at which the curvature of either jumps.
#pragma once

#include <optional>
#include <vector>

#include "results/line_motion.hpp"

namespace mortise {

struct SlideAcrossJump {
  double part;    ///< of p in L2
  Vec2 position;  ///< of the jump that makes most of it
  double slid;    ///< how far the sides slide along one another there, length
};

/// The undeformed gap g0 counts where the sides lie as drawn; moved on by s they have s g0' more of it. Where the
/// curvature of one side jumps by k the slope of that does by k s, and p is off by what such a wedge does to it, A = E*
/// k s / 2 pi times a logarithm (docs/theory.md section 8), as far as contact is closed on both sides and the body is
/// thick. Jumps of both sides at one place do nothing: the normals turn as the gap does. Only of pairs whose gap is
/// drawn. `places`: of place_motions. `modulus`: E*.
std::optional<SlideAcrossJump> slide_across_jumps(const Points& nodes, const ContactPair& pair,
                                                  const std::vector<PlaceMotion>& places, double modulus);

}  // namespace mortise
