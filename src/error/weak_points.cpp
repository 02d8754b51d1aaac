#include "error/weak_points.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/vectors.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

// The place that stands for "at the point" is so many times e-fold nearer to it than the edge is long: as the
// logarithms of error_estimate.cpp, from the scene's size down to the least edges that are made.
constexpr double folds = 15;

// Of c r^d on even edges of length h the part that the best hats miss in L2, over sqrt(h), with the amplitude d p(h):
// for d from 0.005 to 0.5 0.518 to 0.103 of it, within 2 % of this.
double missed(double d, double amplitude) { return 0.52 * amplitude * std::exp(-3.2 * d); }

// What the best hats miss of c r ln r on even edges of length h: in L2 over c h sqrt(h), and at the end over c h.
constexpr double hats_in_l2 = 0.11, hats_at_end = 0.36;

// Of each edge; the body on the left bulges where it is positive.
std::vector<double> curvatures(const Points& nodes, const Curve& curve) {
  std::vector<double> all;
  for (const Edge& edge : curve.edges) {
    const Vec2 start = edge_point(nodes, edge, -1).tangent, end = edge_point(nodes, edge, 1).tangent;
    all.push_back(std::atan2(cross(start, end), start.dot(end)) / edge_length(nodes, edge));
  }
  return all;
}

}  // namespace

double weak_change(double d) { return std::abs(std::expm1(-folds * d)); }

std::vector<SingularPoint> add_weak_points(const PressureLine& line, std::vector<SingularPoint>& points,
                                           LineError& error) {
  std::vector<SingularPoint> weak;
  std::erase_if(points, [&](const SingularPoint& point) {
    const double d = point.small_power;
    if (d == 0) return false;
    const Eigen::Index i = line.nearest(point.position);
    if (!line.loaded[i]) return true;
    double p = std::abs(line.p(i));  // at an edge's length, or extrapolated to the point
    for (const Eigen::Index next : {i - 1, i + 1})
      if (next >= 0 && next < line.p.size()) p = std::max(p, std::abs(line.p(next)));
    error.add_weak({i, missed(d, std::abs(d) * p) * std::sqrt(line.h(i)), 0.5 + std::min(d, 0.), true});
    error.raise(i, p * weak_change(d));
    weak.push_back(point);
    return true;
  });
  return weak;
}

void add_layer_ends(const PressureLine& line, const std::vector<SingularPoint>& points, const ContactLaw& law,
                    double modulus, LineError& error) {
  for (const SingularPoint& point : points) {
    const double d = point.small_power != 0 ? point.small_power : point.pressure_exponent - 1;
    const Eigen::Index i = line.nearest(point.position);
    if ((d == 0 && point.log_pressure == 0) || !line.loaded[i]) continue;
    // Between rollers p is constant but for a part of about d of it; elsewhere r^d is all of it.
    const bool rollers = std::ranges::all_of(point.wedges, [](const Wedge& w) { return w.outer == Face::symmetric; });
    const double p = std::abs(line.p(i)) * (rollers ? std::abs(d) : 1), h = line.h(i);
    const double amplitude = d == 0 ? point.log_pressure : std::abs(d) * p;
    if (amplitude == 0) continue;                                                     // p begins beside it
    const double longer = h * law.slope(law.overlap(std::abs(line.p(i)))) / modulus;  // the edge than E* / k
    const double soft = hats_in_l2 * amplitude * longer, closed = missed(std::max(d, 0.0), amplitude);
    error.add_weak({i, soft * closed / (soft + closed) * std::sqrt(h), 0.5 + closed / (soft + closed), true});
    const double folds_to_end = std::log1p(hats_at_end * longer);
    error.raise(i, d == 0 ? amplitude * folds_to_end : p * std::abs(std::expm1(-d * folds_to_end)));
  }
}

// The limit of a small power with p d = amplitude; hats that are symmetric about the place miss the same on both sides.
void add_weak_logarithm(const PressureLine& line, const Vec2& place, double amplitude, LineError& error) {
  const Eigen::Index i = line.nearest(place);
  error.add_weak({i, std::numbers::sqrt2 * missed(0, amplitude) * std::sqrt(line.h(i)), 0.5, false});
  error.raise(i, folds * amplitude);
}

void add_hidden_fillets(const Points& nodes, const ContactPair& pair, const PressureLine& line, LineError& error) {
  struct Fillet {
    double curvature;
    Vec2 place;
  };
  if (pair.spec.initial_gap == InitialGap::closed || pair.spec.initial_gap == InitialGap::given) return;
  const std::vector<double> own = curvatures(nodes, pair.multiplier), opposite = curvatures(nodes, pair.opposite);
  std::map<Eigen::Index, Fillet> sharpest;  // by edges of the multiplier side
  for (const ContactPoint& point : pair.points) {
    if (!line.loaded[point.edge] || !line.loaded[point.edge + 1]) continue;
    const double curvature = std::abs(own[point.edge] + opposite[point.opposite_edge]);
    Fillet& known = sharpest[point.edge];
    if (curvature > known.curvature)
      known = {curvature, edge_point(nodes, pair.opposite.edges[point.opposite_edge], point.eta).position};
  }
  for (const auto& [edge, fillet] : sharpest) {
    const double longer = (line.s(edge + 1) - line.s(edge)) * fillet.curvature;
    if (!(longer > 1)) continue;
    // Mean square of (h / s)^1/2 - 1 for s from r to h.
    const double more = std::log(longer) - 4 * (1 - 1 / std::sqrt(longer)) + 1 - 1 / longer;
    for (const Eigen::Index i : {edge, edge + 1}) {
      const double p = std::abs(line.p(i));
      error.add_data(i, p * std::sqrt(line.h(i) * more));
      error.raise(i, p * (std::sqrt(longer) - 1));
    }
    error.narrow_at.push_back({fillet.place, 1 / fillet.curvature});
  }
}

}  // namespace mortise
