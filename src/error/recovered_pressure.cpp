#include "error/recovered_pressure.hpp"

#include <cmath>
#include <limits>

#include "contact/projection.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

// On an edge the patches of its two ends are blended, as in recovered_stress.
double pressure_at(const Problem& problem, const StressPatches& patches, const Curve& curve, const Place& at,
                   const Vec2& n) {
  const Edge& e = curve.edges[at.edge];
  const Vec2 x = edge_point(problem.mesh.nodes, e, at.xi).position;
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(patches.coefficients.cols());
  for (int end = 0; end < 2; ++end)
    patches.add_at(point_of(problem.points, curve.body, e.nodes[end]), x, (1 + (end == 0 ? -at.xi : at.xi)) / 2, sum);
  const Vec4 s = whole_stress(problem.discretisation.laws, curve.body, sum, x);
  return -(s(0) * n.x() * n.x() + s(1) * n.y() * n.y() + 2 * s(3) * n.x() * n.y());
}

bool swings_more(const JudgedLine& e, const VecX& swing) {
  const VecX along = e.local.along();
  for (Eigen::Index i = 0; i < swing.size(); ++i)
    if (e.line.loaded[i] && std::isfinite(swing(i)) && swing(i) * std::sqrt(e.line.h(i)) > along(i)) return true;
  return false;
}

}  // namespace

std::vector<int> points_of_pair(const BodyPoints& points, const ContactPair& pair) {
  std::vector<int> list;
  for (const Curve* curve : {&pair.multiplier, &pair.opposite})
    for (const Edge& edge : curve->edges)
      for (int end = 0; end < 2; ++end) list.push_back(point_of(points, curve->body, edge.nodes[end]));
  return list;
}

std::array<VecX, 2> recovered_pressures(const Problem& problem, const StressPatches& patches, const ContactPair& pair,
                                        const PressureNodes& nodes) {
  const Points& x = problem.mesh.nodes;
  const Eigen::Index count = nodes.s.size();
  std::array<VecX, 2> p;
  p.fill(VecX::Constant(count, std::numeric_limits<double>::quiet_NaN()));
  for (Eigen::Index i = 0; i < count; ++i) {
    if (!nodes.smooth[i]) continue;
    const int edge = int(std::min(i / nodes.step, Eigen::Index(pair.multiplier.edges.size()) - 1));
    const Place at{edge, 2.0 * double(i - nodes.step * edge) / nodes.step - 1};
    const Line line = pair.geometry.line_from(x, pair.multiplier, at);
    p[0](i) = pressure_at(problem, patches, pair.multiplier, at, line.n);
    if (const auto hit = project_onto_curve(x, pair.opposite, line))
      p[1](i) = pressure_at(problem, patches, pair.opposite, {hit->edge, hit->xi}, line.n);
  }
  return p;
}

void add_swings(const Problem& problem, const VecX& u, const std::vector<JudgedLine>& lines,
                std::optional<LocalRecovery>& known) {
  const std::vector<ContactPair>& pairs = problem.pairs;
  std::vector<PressureNodes> nodes(pairs.size());
  std::vector<VecX> errors(pairs.size());  // of pairs that need stresses; else empty
  std::vector<int> beside;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    nodes[k] = pressure_nodes(lines[k].line, lines[k].excluded);
    const VecX swing = means_at_vertices(nodes[k], swings(nodes[k]));
    if (!swings_more(lines[k], swing)) continue;
    errors[k] = swing;
    const std::vector<int> of_pair = points_of_pair(problem.points, pairs[k]);
    beside.insert(beside.end(), of_pair.begin(), of_pair.end());
  }
  if (beside.empty()) return;
  if (!known || known->at() != beside) known.emplace(beside, problem.mesh, problem.points);
  const StressPatches patches = known->recover(problem.mesh, problem.points, problem.discretisation.laws, u);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (errors[k].size() == 0) continue;
    for (const VecX& p : recovered_pressures(problem, patches, pairs[k], nodes[k]))
      errors[k] = errors[k].cwiseMin(means_at_vertices(nodes[k], nodes[k].p - p));
    set_swing(errors[k], lines[k].line, lines[k].local);
  }
}

}  // namespace mortise
