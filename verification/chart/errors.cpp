#include "errors.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "fem/edges.hpp"
#include "fem/quadrature.hpp"

namespace mortise::chart {
namespace {

double energy_error(const Results& r, const test::Field& exact) {
  const auto& laws = r.problem.discretisation.laws;
  const double norm = test::field_errors(r.problem.mesh, laws, VecX::Zero(r.solution.u.size()), exact).energy;
  return test::field_errors(r.problem.mesh, laws, r.solution.u, exact).energy / norm;
}

struct Place {
  Vec2 position;
  double p, ds;
};

Place place_at(const Results& r, int edge, double xi, double weight) {
  const ContactPair& pair = r.problem.pairs.front();
  const EdgePoint at = edge_point(r.problem.mesh.nodes, pair.multiplier.edges[edge], xi);
  return {at.position, interpolate(pair, r.recovery.contacts.front().pressure, {edge, xi}), weight * at.jacobian()};
}

}  // namespace

RunErrors run_errors(const Results& r, const Problem& problem) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  RunErrors e{unknown, unknown, unknown, unknown};
  if (problem.exact) e.energy = energy_error(r, *problem.exact);
  if (!problem.pressure) return e;
  const LineRule rule = gauss_legendre(5);
  const Curve& curve = r.problem.pairs.front().multiplier;
  const double length = r.recovery.contacts.front().length;
  double s = 0, sum = 0, norm = 0, inner_sum = 0, inner_norm = 0, worst = 0, largest = 0;
  for (int edge = 0; edge < int(curve.edges.size()); ++edge) {
    double along = s;
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const Place at = place_at(r, edge, rule.points[q], rule.weights[q]);
      const double exact = problem.pressure(at.position), difference = at.p - exact, middle = along + at.ds / 2;
      sum += at.ds * difference * difference;
      norm += at.ds * exact * exact;
      along += at.ds;
      if (middle < left_out * length || middle > (1 - left_out) * length) continue;
      inner_sum += at.ds * difference * difference;
      inner_norm += at.ds * exact * exact;
      worst = std::max(worst, std::abs(difference));
      largest = std::max(largest, std::abs(exact));
    }
    for (const double xi : {-1., 0., 1.}) {
      const double node = xi < 0 ? s : xi > 0 ? along : (s + along) / 2;
      if (node < left_out * length || node > (1 - left_out) * length) continue;
      const Place at = place_at(r, edge, xi, 0);
      worst = std::max(worst, std::abs(at.p - problem.pressure(at.position)));
    }
    s = along;
  }
  e.p_l2 = std::sqrt(sum / norm);
  e.p_l2_inner = std::sqrt(inner_sum / inner_norm);
  e.p_max_inner = worst / largest;
  return e;
}

void write_pressure(const Results& r, const std::string& path) {
  std::vector<Place> places;
  const Curve& curve = r.problem.pairs.front().multiplier;
  for (int edge = 0; edge < int(curve.edges.size()); ++edge) {
    const int pieces = curve.edges[edge].node_count == 3 ? 16 : 1;
    for (int i = edge == 0 ? 0 : 1; i <= pieces; ++i) places.push_back(place_at(r, edge, -1 + 2. * i / pieces, 0));
  }
  if (places.front().position.x() > places.back().position.x()) std::reverse(places.begin(), places.end());
  std::ofstream file(path);
  file.precision(17);
  file << "x,p\n";
  for (const Place& at : places) file << at.position.x() << ',' << at.p << '\n';
}

}  // namespace mortise::chart
