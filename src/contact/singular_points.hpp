// Where the stress on a contact line has no limit, so that no mesh shows it.
#pragma once

#include <array>

#include "contact/contact_line.hpp"
#include "contact/williams.hpp"
#include "fem/constraints.hpp"

namespace mortise {

/// How two bodies meet at a point of their contact line: the ends of both curves; a corner, an end or a kink, on a
/// curve that goes on; one kink of both curves.
enum class Meeting { ends, corner, kink };

/// A kink of either curve, or an end of it, at which the stress is singular: stress ~ r^(exponent - 1).
struct SingularPoint {
  Vec2 position;
  double edge;               ///< length of the longest edge of either curve that meets there
  double exponent;           ///< real part, in (0, singular_limit)
  double pressure_exponent;  ///< the same of the contact pressure; 1: bounded, only the bodies' stress is singular
  Meeting meeting;
  std::array<Wedge, 2> wedges;  ///< of the first and the second curve's body
};

/// Exponents above this count as regular: r^-0.05 doubles within a million edges.
inline constexpr double singular_limit = 0.95;

/// Both bodies as wedges at each place (contact/williams.hpp): their angles from the curves that the edges stand for
/// and, at an end, the edge of the body's boundary beyond it, whose prescribed displacements say what holds it. A body
/// whose curve goes on there is a straight wedge, or one of its kink's angle, free beyond. Where both curves go on
/// through a kink they share both faces: the exponent is the smallest of all modes, and a load that is symmetric about
/// the bisector does not excite the antisymmetric ones. As if contact were closed; `laws` one a body.
std::vector<SingularPoint> singular_points(const Mesh& mesh, const SideTable& table, const Curve& first,
                                           const Curve& second, const Constraints& constraints,
                                           const std::vector<ElasticLaw>& laws, TipTable& tips);

/// The exponent of a body's own corner at a node, its faces free of contact: 1 where it has none below, and inside.
double corner_exponent(const Mesh& mesh, int node, const Constraints& constraints, const ElasticLaw& law);

}  // namespace mortise
