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

/// What a body is at a point of its contact line.
struct Corner {
  Wedge wedge;
  bool end;          ///< its curve does not go on
  double edge;       ///< length of the longest one of its curve there
  double error = 0;  ///< of the angle, radians
  int node = -1;     ///< of its vertex; -1 where it has none there
};

/// A kink or an end of either curve of a pair that contact reaches.
struct ContactPlace {
  Vec2 position;
  std::array<int, 2> bodies;      ///< of the first and the second curve
  std::array<Corner, 2> corners;  ///< of both bodies
  /// Whether contact is closed between the first body's last face (Fan) and the second one's first, and between the
  /// second body's last face and the first one's first.
  std::array<bool, 2> joined;
  bool one_curve;      ///< both curves are meant to be one
  double given_slope;  ///< of a given gap away from the place
  bool soft = false;   ///< what is between both holds no face: they are no part of what is rigid in contact

  /// Whether it is the tip of a crack, whose faces both curves are.
  bool is_tip() const { return corners[0].node >= 0 && corners[0].node == corners[1].node; }
};

/// Those of one pair, however far from each other both curves are drawn. The wedges' angles are from the curves that
/// the edges stand for and, at an end, from the edge of the body's boundary beyond it, whose prescribed displacements
/// say what holds it. A body whose curve goes on there is a straight wedge, or one of its kink's angle, free beyond.
std::vector<ContactPlace> contact_places(const Surroundings& around, const Curve& first, const Curve& second,
                                         const ContactReach& reach, const GivenGap& given = {});

/// Of each pair those of its places at which a stress is singular, by the bodies as wedges (contact/williams.hpp).
/// Where pairs have a place in common, all bodies in contact there are one fan. Kinks of both curves of a pair are one
/// where their angles add up to 2 pi, as they do where the drawn curves coincide, or where `one_curve` says that both
/// are meant to: the bodies then share both faces, the exponent is the smallest of all modes, and a load that is
/// symmetric about the bisector does not excite the antisymmetric ones. Else the slope of the gap jumps there: where
/// contact is closed on both sides the bodies share both faces as those of a symmetric load do, elsewhere one; so it
/// does at an end on a line of symmetry from which a given gap rises or falls. As if contact were closed.
std::vector<std::vector<SingularPoint>> singular_points(const std::vector<std::vector<ContactPlace>>& of_pairs,
                                                        TipTable& tips, int threads = 1);

}  // namespace mortise
