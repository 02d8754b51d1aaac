#include "error/data_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "contact/least_gap.hpp"
#include "error/data_works.hpp"
#include "error/gap_misfit.hpp"
#include "error/pressure_bars.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

// Where the gap jumps within the loaded line p has no limit: a corner of a rigid punch's exponent.
void add_jumps(const GapErrors& gap, const PressureLine& line, std::vector<SingularPoint>& points) {
  for (const auto& [edge, position] : gap.jumps) {
    if (!line.loaded[edge] && !line.loaded[edge + 1]) continue;
    points.push_back({.position = position,
                      .edge = line.s(edge + 1) - line.s(edge),
                      .exponent = 0.5,
                      .pressure_exponent = 0.5,
                      .meeting = Meeting::kink,
                      .wedges = {}});
  }
}

// An edge that carries nothing and stays open whatever its gap is off by has none.
void add_gap_errors(const Problem& problem, const VecX& u, const AccuracySpec& spec,
                    std::vector<PressureEstimate>& pressures) {
  const double negligible = negligible_force(pressures, spec);
  for (std::size_t k = 0; k < pressures.size(); ++k) {
    const GapErrors gap = gap_errors(problem.mesh, problem.pairs[k], problem.discretisation.laws);
    if (gap.l2.size() == 0) continue;
    PressureEstimate& e = pressures[k];
    const std::vector<Interval> gaps = gap_ranges(u, problem.pairs[k]);
    for (Eigen::Index i = 0; i < gap.l2.size(); ++i)
      if (e.line.p(i) != 0 || e.line.p(i + 1) != 0 || gaps[i].low <= gap.off(i))
        for (const int end : {0, 1}) e.local.add_data(i + end, gap.l2(i));
    if (!problem.pairs[k].spec.stiffness) add_jumps(gap, e.line, e.singular);
    find_excluded(spec.exclude, negligible, e);
    find_bars(e);
  }
}

// Edges of the multiplier side at each node of both sides of a pair.
std::map<int, std::set<int>> edges_at_nodes(const ContactPair& pair) {
  std::map<int, std::set<int>> edges;
  for (const ContactPoint& point : pair.points)
    for (const Edge& edge : {pair.multiplier.edges[point.edge], pair.opposite.edges[point.opposite_edge]})
      for (int a = 0; a < edge.node_count; ++a) edges[edge.nodes[a]].insert(point.edge);
  return edges;
}

// An initial strain that a cell does not follow makes stresses of its own size there. Where the cell is on the line
// they are a part of p at its vertices: means over windows, which are many times as wide, hardly feel them.
void add_strains_on_line(const Problem& problem, ErrorEstimate& estimate) {
  const std::vector<DataMisfit>& parts = problem.misfits.parts;
  const auto is_strain = [](const DataMisfit& part) { return part.kind == DataMisfit::Kind::strain; };
  if (std::ranges::none_of(parts, is_strain)) return;
  for (std::size_t k = 0; k < problem.pairs.size(); ++k) {
    const std::map<int, std::set<int>> edges = edges_at_nodes(problem.pairs[k]);
    PressureEstimate& e = estimate.pressures[k];
    for (const DataMisfit& part : parts) {
      if (!is_strain(part)) continue;
      const Cell& cell = problem.mesh.cells[part.cell];
      std::set<int> vertices;
      for (int a = 0; a < node_count(cell.kind); ++a)
        if (const auto at = edges.find(cell.nodes[a]); at != edges.end())
          for (const int edge : at->second) vertices.insert({edge, edge + 1});
      const int last = int(e.line.p.size()) - 1;
      if (e.line.closed && (vertices.contains(0) || vertices.contains(last))) vertices.insert({0, last});  // one vertex
      const ElasticLaw& law = problem.discretisation.laws[cell.body];
      const double volume = estimate.energy.areas(part.cell) * law.model.depth(centre_of(problem.mesh.nodes, cell).x());
      const double stress = part.size * std::sqrt(law.young / volume);
      for (const int i : vertices)
        if (e.line.loaded[i]) e.local.add_data(i, stress * std::sqrt(e.line.h(i)));
    }
  }
}

// The edge of a line whose chord is nearest to a place, and how far away.
std::pair<Eigen::Index, double> nearest_edge(const PressureLine& line, const Vec2& x) {
  std::pair<Eigen::Index, double> nearest{0, std::numeric_limits<double>::infinity()};
  for (Eigen::Index e = 0; e + 1 < line.p.size(); ++e) {
    if (!line.loaded[e] || !line.loaded[e + 1]) continue;
    const Vec2 from = line.position[e], along = line.position[e + 1] - from;
    const double part = std::clamp((x - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double away = (from + part * along - x).norm();
    if (away < nearest.second) nearest = {e, away};
  }
  return nearest;
}

// A load that a cell does not follow, of force F, is one of no resultant and no moment to the body, and farther away
// than the cell's size h its stresses fall faster than those of a force. Nearer they are those of F: beneath it, at
// depth d, a pressure of F / pi d within, as each of two bodies in contact takes one half, and twice as much of F on a
// boundary (Flamant), which is 5 / (16 pi) F^2 / d and four times that in the squares along the line. Of peaks that are
// as narrow as d windows see nothing.
void add_loads_by_line(const Problem& problem, const Solution& solution, ErrorEstimate& estimate) {
  using enum DataMisfit::Kind;
  constexpr double force_below = std::numbers::inv_pi;
  const Mesh& mesh = problem.mesh;
  for (const DataMisfit& part : problem.misfits.parts) {
    if (part.kind != force && part.kind != foundation) continue;
    const Cell& cell = mesh.cells[part.cell];
    const bool on_side = part.side >= 0;
    const double h =
        on_side ? edge_length(mesh.nodes, side_edge(cell, part.side)) : std::sqrt(2 * estimate.energy.areas(part.cell));
    const double F = part.sum * (part.kind == foundation ? largest_on(mesh, part, solution.u) : 1) /
                     problem.discretisation.laws[cell.body].model.depth(part.at.x());
    for (std::size_t k = 0; k < problem.pairs.size(); ++k) {
      const ContactPair& pair = problem.pairs[k];
      if (pair.multiplier.body != cell.body && pair.opposite.body != cell.body) continue;
      PressureEstimate& e = estimate.pressures[k];
      const auto [edge, away] = nearest_edge(e.line, part.at);
      if (!std::isfinite(away)) continue;
      const double d = std::max(away, part.spread / 2);
      const int power = on_side ? 3 : 2;
      const double reaching = (on_side ? 2 : 1) * F * std::pow(std::min(1.0, h / d), power);
      for (const Eigen::Index i : {edge, edge + 1}) {
        e.local.add_load({i, std::sqrt(5 * force_below / 16 / d) * reaching, part.at, h, power});
        e.local.raise(i, force_below * reaching / std::max((e.line.position[i] - part.at).norm(), d));
      }
    }
  }
}

}  // namespace

void add_data_errors(const Problem& problem, const Solution& solution, const AccuracySpec& spec,
                     ErrorEstimate& estimate) {
  const std::vector<DataMisfit>& parts = problem.misfits.parts;
  add_gap_errors(problem, solution.u, spec, estimate.pressures);
  if (parts.empty() || problem.pairs.empty()) return;
  add_strains_on_line(problem, estimate);
  add_loads_by_line(problem, solution, estimate);
  const MatX works = estimate.data_works.cwiseAbs();
  if (works.cols() == 0) return;
  const Eigen::Index windows = estimate.far.windows.count, shared = estimate.far.parts.cols();
  VecX far = VecX::Zero(Eigen::Index(estimate.far.windows.dual.size())), fluctuations = VecX::Zero(shared - windows);
  const auto grow = [](double& part, double by) { part += part < 0 ? -by : by; };
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const DataMisfit& part = parts[i];
    const Eigen::Index row = Eigen::Index(i);
    for (int k = 0; k < int(shared); ++k) {
      grow(estimate.far.parts(part.cell, k), works(row, k));
      if (k >= windows) {
        fluctuations(k - windows) += works(row, k);
        continue;
      }
      estimate.far.windows.for_each_window(problem.mesh.cells[part.cell].body, k, part.at,
                                           [&](int window, double share) { far(window) += share * works(row, k); });
    }
    for (Eigen::Index k = shared; k < works.cols(); ++k) {
      grow(estimate.goal->parts(part.cell, k - shared), works(row, k));
      estimate.goal->besides(k - shared) += works(row, k);
    }
  }
  Eigen::Index window = 0, fluctuation = 0;
  for (PressureEstimate& e : estimate.pressures) {
    if (e.fluctuation) e.fluctuation->far += fluctuations(fluctuation++);
    e.far += far.segment(window, Eigen::Index(e.windows.size()));
    window += Eigen::Index(e.windows.size());
    find_bars(e);
  }
}

}  // namespace mortise
