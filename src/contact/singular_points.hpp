// Places where the stress on a contact line has no limit, so that no mesh shows it.
#pragma once

#include <array>

#include "contact/body_corners.hpp"
#include "contact/contact_line.hpp"

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

/// Of a vertex of a contact curve, whether contact is closed on its edges before and after it, up to it.
struct Reach {
  bool before, after;
  bool any() const { return before || after; }
  bool operator==(const Reach&) const = default;
};

/// Of the vertices of both curves, each in the order of its edges, the last one too (so once more the first of a closed
/// curve).
using ContactReach = std::array<std::vector<Reach>, 2>;

/// What a scene says of the gap, whatever its curves.
struct GivenGap {
  bool one_curve = false;                  ///< both curves are meant to be one
  std::array<double, 2> end_slopes{0, 0};  ///< of a gap that is given or added, away from the first curve's ends
  bool operator==(const GivenGap&) const = default;
};

/// Both bodies as wedges at each place that contact reaches, however far from each other they are drawn
/// (contact/williams.hpp): their angles from the curves that the edges stand for and, at an end, the edge of the body's
/// boundary beyond it, whose prescribed displacements say what holds it. A body whose curve goes on there is a straight
/// wedge, or one of its kink's angle, free beyond. Kinks of both curves are one where their angles add up to 2 pi, as
/// they do where the drawn curves coincide, or where `given` says that both are meant to: the bodies then share
/// both faces, the exponent is the smallest of all modes, and a load that is symmetric about the bisector does not
/// excite the antisymmetric ones. Else the slope of the gap jumps there: where contact is closed on both sides the
/// bodies share both faces as those of a symmetric load do, elsewhere one; so it does at an end on a line of symmetry
/// from which a given gap rises or falls. As if contact were closed.
std::vector<SingularPoint> singular_points(const Surroundings& around, const Curve& first, const Curve& second,
                                           const ContactReach& reach, const GivenGap& given = {});

}  // namespace mortise
