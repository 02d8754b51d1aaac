// Places where the stress on a contact line has no limit, so that no mesh shows it.
#pragma once

#include "contact/contact_places.hpp"
#include "contact/tip_table.hpp"

namespace mortise {

/// How two bodies meet at a point of their contact line: the ends of both curves; a corner, an end or a kink, on a
/// curve that goes on, or one of two kinks that are not one; one kink of both curves; the tip of a crack, whose faces
/// they are.
enum class Meeting { ends, corner, kink, tip };

/// A kink of either curve, or an end of it, at which the stress is singular: stress ~ r^(exponent - 1), or the
/// logarithm of it.
struct SingularPoint {
  Vec2 position;
  double edge;               ///< length of the longest edge of either curve that meets there
  double exponent;           ///< real part, in (0, singular_limit]; 1: only the logarithm
  double pressure_exponent;  ///< the same of the contact pressure; 1: bounded, only the bodies' stress is singular
  Meeting meeting;
  std::array<Wedge, 2> wedges;  ///< of the first and the second curve's body
  /// Where the slope of the gap jumps and contact is closed on both sides, p = -log_pressure ln r + ...; stress, 0
  /// where it does not.
  double log_pressure = 0;
  /// Of one kink of both curves that turns too little for exponents to say what it does: by how much, radians, else 0.
  double small_turn = 0;
  /// p ~ r^small_power, to zero or without limit, so slowly that the point is none of those above (exponent 1); else 0.
  double small_power = 0;

  /// Whether p has no limit there.
  bool is_unbounded() const { return pressure_exponent < 1 || log_pressure > 0; }
  /// Whether p is as smooth there as elsewhere though the bodies' stress has no limit: p_h swings from node to node,
  /// the more the shorter the edges.
  bool is_swinging() const { return meeting == Meeting::tip && !is_unbounded(); }
};

/// Of each pair those of its places at which a stress is singular, by the bodies as wedges (contact/williams.hpp).
/// Where pairs have a place in common, all bodies in contact there are one fan. Kinks of both curves of a pair are one
/// where their angles add up to 2 pi, as they do where the drawn curves coincide, or where `one_curve` says that both
/// are meant to: the bodies then share both faces, the exponent is the smallest of all modes, and a load that is
/// symmetric about the bisector does not excite the antisymmetric ones. Else the slope of the gap jumps there: where
/// contact is closed on both sides the bodies share both faces as those of a symmetric load do, elsewhere one; so it
/// does at an end on a line of symmetry from which a given gap rises or falls. As if contact were closed there, or open
/// where a mode of closed joints pulls (contact/joint_states.hpp).
std::vector<std::vector<SingularPoint>> singular_points(const std::vector<std::vector<ContactPlace>>& of_pairs,
                                                        TipTable& tips, int threads = 1);

}  // namespace mortise
