// Ends and kinks of contact lines, and what the bodies are there.
#pragma once

#include <array>

#include "contact/body_corners.hpp"
#include "contact/contact_line.hpp"

namespace mortise {

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

/// A body that shares a node with another, or is tied to it.
struct BondedBody {
  int body, node;
  Wedge wedge;
  double turn;  ///< as of AcrossTie
};

/// What a body is at a point of its contact line.
struct Corner {
  Wedge wedge;
  bool end;                                     ///< its curve does not go on
  double edge;                                  ///< length of the longest one of its curve there
  double error = 0;                             ///< of the angle, radians
  int node = -1;                                ///< of its vertex; -1 where it has none there
  std::optional<Vec2> before = {}, after = {};  ///< tangents of its curve that ends, that begins there
  /// The bodies that are one with it there, between the curve's end and the next face, counter-clockwise.
  std::vector<BondedBody> bonded = {};
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
  double shortest;     ///< length of the shortest edge that meets there, of the curve whose end or kink it is
  bool soft = false;   ///< what is between both holds no face: they are no part of what is in contact without it

  /// Whether it is the tip of a crack, whose faces both curves are: they share its node, or are tied there and of one
  /// material all around.
  bool is_tip() const;
};

/// Those of one pair, however far from each other both curves are drawn. The wedges' angles are from the curves that
/// the edges stand for and, at an end, from the edge of the body's boundary beyond it, whose prescribed displacements
/// say what holds it. A body whose curve goes on there is a straight wedge, or one of its kink's angle, free beyond.
std::vector<ContactPlace> contact_places(const Surroundings& around, const Curve& first, const Curve& second,
                                         const ContactReach& reach, const GivenGap& given = {});

}  // namespace mortise
