#include "results/line_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/vectors.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

constexpr double kink = 20 * std::numbers::pi / 180;  // more is no curvature

// A place of one side: where it was and by how much it moved, with the force there.
struct Moved {
  double force;
  Vec2 x, u;
};

Vec2 mean_place(const std::vector<Moved>& side) {
  Vec2 sum = Vec2::Zero();
  double force = 0;
  for (const Moved& m : side) {
    sum += m.force * m.x;
    force += m.force;
  }
  return sum / force;
}

// The angle of the turn about the means that takes the places nearest to where they have moved (Kabsch, in the plane:
// the sums of cross and of dot products are its sine and cosine).
double turn(const std::vector<Moved>& side) {
  const Vec2 centre = mean_place(side);
  double sine = 0, cosine = 0;  // the mean displacement drops out, as the arms' sum is zero
  for (const Moved& m : side) {
    const Vec2 arm = m.x - centre;
    sine += m.force * cross(arm, arm + m.u);
    cosine += m.force * arm.dot(arm + m.u);
  }
  return std::abs(std::atan2(sine, cosine));
}

}  // namespace

std::vector<double> edge_curvatures(const Points& nodes, const Curve& curve) {
  const std::size_t count = curve.edges.size();
  const auto tangent = [&](std::size_t e, double xi) { return edge_point(nodes, curve.edges[e], xi).tangent; };
  std::vector<double> list;
  for (std::size_t e = 0; e < count; ++e) {
    double turn = angle_between(tangent(e, -1), tangent(e, 1));
    const auto take = [&](std::size_t a, std::size_t b) {
      if (const double found = angle_between(tangent(a, 0), tangent(b, 0)); found < kink) turn = std::max(turn, found);
    };
    if (e + 1 < count || curve.closed) take(e, (e + 1) % count);
    if (e > 0 || curve.closed) take((e + count - 1) % count, e);
    list.push_back(turn / edge_length(nodes, curve.edges[e]));
  }
  return list;
}

std::optional<LineMotion> line_motion(const Points& nodes, const ContactPair& pair, const ContactResults& contact,
                                      const VecX& u) {
  const std::vector<double> curvature = edge_curvatures(nodes, pair.multiplier),
                            opposite_curvature = edge_curvatures(nodes, pair.opposite);
  std::vector<Moved> side, other;
  double force = 0, square = 0, length = 0, slid = 0, curved = 0;
  const bool both_ways = pair.spec.condition != Condition::unilateral;  // tension too
  const double least = 1e-3 * largest_entry(contact.pressure);
  for (const ContactPoint& c : pair.points) {
    const double signed_p = interpolate(pair, contact.pressure, {c.edge, c.xi});
    const double p = both_ways ? std::abs(signed_p) : signed_p;
    if (!(p > least)) continue;
    const Edge &edge = pair.multiplier.edges[c.edge], &facing = pair.opposite.edges[c.opposite_edge];
    side.push_back({p * c.dA, edge_point(nodes, edge, c.xi).position, edge_value(u, edge, c.xi)});
    other.push_back({p * c.dA, edge_point(nodes, facing, c.eta).position, edge_value(u, facing, c.eta)});
    const Vec2 moved = other.back().u - side.back().u;
    force += p * c.dA;
    square += p * p * c.dA;
    length += c.ds;
    slid += p * c.dA * cross(moved, c.normal);
    curved += p * c.dA * moved.norm() * std::max(curvature[c.edge], opposite_curvature[c.opposite_edge]);
  }
  if (!(force > 0)) return {};
  return LineMotion{.turned = std::max(turn(side), turn(other)),
                    .slid = std::abs(slid / force) / length,
                    .curved = curved / force,
                    .position = mean_place(side),
                    .norm = std::sqrt(square)};
}

}  // namespace mortise
