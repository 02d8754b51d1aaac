#include "error/sliding_kinks.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "base/vectors.hpp"
#include "contact/curvature_jumps.hpp"
#include "contact/least_gap.hpp"
#include "error/weak_points.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

constexpr double least_asked = 0.001;  // of a mesh of one's own: bars are judged at the nodes

// How far the sides slide at the contact point nearest to a place.
double slide_at(const ContactPair& pair, const PressureLine& line, const Vec2& x, const VecX& u) {
  double nearest = std::numeric_limits<double>::infinity(), slide = 0;
  for (const ContactPoint& point : pair.points) {
    const double end = (1 + point.xi) / 2;
    const Vec2 at = (1 - end) * line.position[point.edge] + end * line.position[point.edge + 1];
    if ((at - x).norm() >= nearest) continue;
    nearest = (at - x).norm();
    slide = std::abs(cross(parted(u, pair, point), point.normal));
  }
  return slide;
}

struct Loaded {
  double length, mean;  // of p in L2
};

Loaded loaded(const PressureLine& line) {
  double length = 0, square = 0;
  for (Eigen::Index i = 0; i < line.p.size(); ++i) {
    if (line.loaded[i]) length += line.h(i);
    square += line.h(i) * line.p(i) * line.p(i);
  }
  return {length, std::sqrt(square / length)};
}

}  // namespace

void judge_small_kinks(const ContactPair& pair, double modulus, const VecX& u, double asked,
                       PressureEstimate& estimate) {
  const PressureLine& line = estimate.line;
  const auto [length, mean] = loaded(line);
  const double least = seen_of_asked * (asked > 0 ? asked : least_asked);
  std::erase_if(estimate.singular, [&](SingularPoint& point) {
    if (point.small_turn == 0) return false;
    const double opens =
        modulus * point.small_turn * slide_at(pair, line, point.position, u) / (2 * std::numbers::pi * mean);
    if (!(std::sqrt(2 * opens / length) > least)) return true;
    point.log_pressure = mean;  // counts as one: an exponent near 0 has no layers that a mesh could have
    return false;
  });
}

void add_curvature_jumps(const Points& nodes, const ContactPair& pair, const std::array<ElasticLaw, 2>& laws,
                         const VecX& u, const std::vector<Reach>& reach, PressureEstimate& estimate) {
  if (!pair.geometry.normals) return;
  const ContactLine& line = *pair.geometry.multiplier;
  const double mean = loaded(estimate.line).mean;
  for (const CurvatureJump& at : curvature_jumps(nodes, pair.multiplier, line)) {
    const bool within = at.xi > -1;
    const bool before = within ? reach[at.edge].after : reach[at.edge].before,
               after = within ? reach[at.edge + 1].before : reach[at.edge].after;
    if (!before && !after) continue;
    const Vec2 place = line.at(at.edge, at.xi).position;
    const double amplitude = contact_modulus(laws[0], laws[1]) * std::abs(at.jump) *
                             slide_at(pair, estimate.line, place, u) / (2 * std::numbers::pi);
    if (amplitude > mean) {
      estimate.singular.push_back({.position = place,
                                   .edge = edge_length(nodes, pair.multiplier.edges[at.edge]),
                                   .exponent = 1,
                                   .pressure_exponent = 1,
                                   .meeting = Meeting::corner,
                                   .wedges = {wedge(std::numbers::pi, laws[0]), wedge(std::numbers::pi, laws[1])},
                                   .log_pressure = amplitude});
    } else if (before && after) {
      add_weak_logarithm(estimate.line, place, amplitude, estimate.local);
    }
  }
}

double opened_by_kinks(const ContactPair& pair, double modulus, const VecX& u, const PressureEstimate& estimate) {
  const PressureLine& line = estimate.line;
  double opened = 0;
  for (const SingularPoint& point : estimate.singular) {
    const Eigen::Index kink = line.nearest(point.position);
    const auto [before, after] = line.faced_beside(kink);
    const double turn = std::numbers::pi - point.wedges[0].angle, other = std::numbers::pi - point.wedges[1].angle;
    if (point.meeting != Meeting::corner || !before || !after || std::abs(turn) < sharpest_joint) continue;
    const double least =
        modulus * std::abs(turn + other) * slide_at(pair, line, point.position, u) / (2 * std::numbers::pi);
    for (const int step : {-1, 1}) {
      double pressed = 0;
      for (auto i = line.beside(kink, step); i && *i != kink; i = line.beside(*i, step)) {
        const double r = line.distance(line.s(kink), line.s(*i));
        if (line.p(*i) > 0) pressed = r;
        if (line.p(*i) * r >= least) break;
      }
      opened = std::max(opened, pressed);
    }
  }
  return opened;
}

}  // namespace mortise
