// The nearest approach of the curves of a pair that bear nothing.
#pragma once

#include "contact/segments.hpp"

namespace mortise {

/// The nearest contact point; if the curves of a pair face nowhere: infinite, no approach.
struct LeastGap {
  double gap;   ///< deformed, the least of all points, length; negative: drawn curves pass through one another there
  Vec2 place;   ///< of it, undeformed
  double edge;  ///< length of the multiplier side's edge there
  double approach;  ///< the most that the curves come nearer anywhere, length
};

/// `u`: displacements, two a node.
LeastGap least_gap(const Points& nodes, const VecX& u, const ContactInterface& interface);

/// Whether curves without pressure on a mesh and on a finer one at their least gap are open between its points too:
/// they come nearer nowhere by more than `round_off`, or the least gap, which is then known to half of itself, is open.
bool stays_open(const LeastGap& coarser, const LeastGap& finer, double round_off);

}  // namespace mortise
