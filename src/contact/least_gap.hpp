// The nearest approach of the curves of a pair, also between the points at which contact is integrated.
#pragma once

#include "base/interval.hpp"
#include "contact/segments.hpp"
#include "fem/rigid_motions.hpp"

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

/// By how much `u` parts the sides at a point of the interface, length.
Vec2 parted(const VecX& u, const ContactInterface& interface, const ContactPoint& point);

/// By how much a rigid motion opens the gap there, length.
double opened(const Points& nodes, const std::vector<RigidMotion>& motion, const ContactInterface& interface,
              const ContactPoint& point);

/// How far the sides are apart at a point of the interface, undeformed gap and opening by `u` (two a node), length.
double gap_at(const VecX& u, const ContactInterface& interface, const ContactPoint& point);

/// On each edge of the multiplier side the gaps at its points; of an edge without points nothing: from infinity to
/// -infinity.
std::vector<Interval> gap_ranges(const VecX& u, const ContactInterface& interface);

/// A place where the gap is less than on both sides of it.
struct Trough {
  ContactPoint point;  ///< without weight
  /// Of the gap along the multiplier side, 1 / length: of the parabolas that the points on either side of it make, the
  /// larger and the smaller.
  double curvature, least_curvature;
};

/// All of them, with the gap deformed by `u`: between points that are next to one another on the curve, and to its
/// ends. `on`: of each edge of the multiplier side, whether those of its points are looked for; empty: of all.
std::vector<Trough> troughs(const Points& nodes, const VecX& u, const ContactInterface& interface,
                            const std::vector<char>& on = {});

/// Whether curves without pressure on a mesh and on a finer one at their least gap are open between its points too:
/// they come nearer nowhere by more than `round_off`, or the least gap, which is then known to half of itself, is open.
bool stays_open(const LeastGap& coarser, const LeastGap& finer, double round_off);

}  // namespace mortise
