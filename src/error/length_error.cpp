#include "error/length_error.hpp"

#include <algorithm>
#include <cmath>

#include "contact/least_gap.hpp"
#include "error/goal_estimate.hpp"
#include "error/pressure_bars.hpp"
#include "error/sliding_kinks.hpp"

namespace mortise {
namespace {

// Whether p falls from the nearest vertex that is not left out to one beside a place where it has no limit: it may as
// well be open there.
bool falls_to(const PressureEstimate& e, Eigen::Index i) {
  const Eigen::Index last = e.line.p.size() - 1;
  const auto known = [&](Eigen::Index k) { return k >= 0 && k <= last && !e.excluded[k] ? e.line.p(k) : 0; };
  for (Eigen::Index away = 1; away <= last; ++away)
    if (const double p = std::max(known(i - away), known(i + away)); p > 0) return e.line.p(i) < p;
  return false;
}

// Edges on which p ends, though it may be no border: p_h is zero there as it swings, or beside a place without limit.
void add_ends_of_pressure(const PressureLine& line, std::vector<char>& undecided) {
  for (Eigen::Index edge = 0; edge + 1 < line.p.size(); ++edge)
    if (line.faced[edge] && (line.p(edge) != 0) != (line.p(edge + 1) != 0)) undecided[edge] = 1;
}

// Edges that carry p, but no more than it may be off by.
void add_hardly_pressed(const PressureEstimate& e, std::vector<char>& undecided) {
  const PressureLine& line = e.line;
  const auto hardly = [&](Eigen::Index i) {
    return line.p(i) > 0 && line.p(i) <= e.bar(i) && (!e.excluded[i] || falls_to(e, i));
  };
  for (Eigen::Index edge = 0; edge + 1 < line.p.size(); ++edge)
    if (line.faced[edge] && hardly(edge) && hardly(edge + 1)) undecided[edge] = 1;
}

// Where p falls to a place at which it has no limit, as P - K r^(lambda - 1), contact ends before it: at the r where
// that is zero, K h^(lambda - 1) what p falls by along the edge.
double ends_before_points(const PressureEstimate& e) {
  const PressureLine& line = e.line;
  double length = 0;
  for (const SingularPoint& point : e.singular) {
    if (!(point.pressure_exponent < 1)) continue;
    const Eigen::Index at = line.nearest(point.position);
    for (const int step : {-1, 1}) {
      const auto next = line.beside(at, step);
      if (!next || !(0 < line.p(at) && line.p(at) < line.p(*next))) continue;
      const Eigen::Index edge = line.edge_to(*next, step);
      const double falls = 1 - line.p(at) / line.p(*next);
      length += (line.s(edge + 1) - line.s(edge)) * std::pow(falls, 1 / (1 - point.pressure_exponent));
    }
  }
  return length;
}

// Edges beyond a border that what p is off by along the line there would close.
void add_hardly_open(const PressureEstimate& e, const LineError::Border& border, double modulus,
                     const std::vector<Interval>& gaps, std::vector<char>& undecided) {
  const PressureLine& line = e.line;
  const Eigen::Index open = open_vertex(line, border);
  const int step = open == border.edge ? -1 : 1;
  const double off = error_safety * e.local.pointwise(line)(open);
  double length = 0;
  Eigen::Index i = open;
  for (Eigen::Index left = line.p.size() - 1; left > 0; --left) {
    const auto next = line.beside(i, step);
    if (!next) return;
    i = *next;
    const Eigen::Index edge = line.edge_to(i, step);
    if (!line.faced[edge] || line.p(i) != 0) return;
    length += line.s(edge + 1) - line.s(edge);
    if (modulus * gaps[edge].high > 2 * length * off) return;
    undecided[edge] = 1;
  }
}

}  // namespace

double length_error(const Problem& problem, const ContactPair& pair, const VecX& u, const PressureEstimate& e) {
  const PressureLine& line = e.line;
  const std::vector<ElasticLaw>& laws = problem.discretisation.laws;
  std::vector<char> undecided(line.faced.size(), 0);
  double error = 0;
  for (const LineError::Border& border : e.local.borders) {
    undecided[border.edge] = 1;
    error += error_safety * border_motion(e, border);
  }
  if (pair.spec.condition == Condition::unilateral && !pair.spec.stiffness) {
    const double modulus = contact_modulus(laws[pair.multiplier.body], laws[pair.opposite.body]);
    const std::vector<Interval> gaps = gap_ranges(u, pair);
    error += opened_by_kinks(pair, modulus, u, e);
    for (const LineError::Border& border : e.local.borders) add_hardly_open(e, border, modulus, gaps, undecided);
  }
  if (pair.spec.condition == Condition::unilateral) {
    error += ends_before_points(e);
    add_ends_of_pressure(line, undecided);
    add_hardly_pressed(e, undecided);
  }
  for (std::size_t edge = 0; edge < undecided.size(); ++edge)
    if (undecided[edge]) error += line.s(Eigen::Index(edge) + 1) - line.s(Eigen::Index(edge));
  return error;
}

}  // namespace mortise
