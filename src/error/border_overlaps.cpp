#include "error/border_overlaps.hpp"

#include <algorithm>

#include "error/line_part.hpp"
#include "error/pressure_windows.hpp"

namespace mortise {
namespace {

// Of the edges at which contact ends the largest overlap of the bodies on them, length; 0 on all others.
VecX overlaps_at_borders(const ContactPair& pair, const PressureEstimate& estimate, const VecX& u) {
  const VecX opened = openings(pair, u);
  VecX on_edge = VecX::Zero(Eigen::Index(pair.multiplier.edges.size())), at_borders = on_edge;
  for (std::size_t i = 0; i < pair.points.size(); ++i) {
    const ContactPoint& point = pair.points[i];
    on_edge(point.edge) = std::max(on_edge(point.edge), -(point.gap + opened(Eigen::Index(i))));
  }
  for (const LineError::Border& border : estimate.local.borders) {
    const std::array<Eigen::Index, 2> edges = edges_at(estimate.line, border.edge);
    double most = 0;
    for (const Eigen::Index e : edges)
      if (e >= 0) most = std::max(most, on_edge(e));
    for (const Eigen::Index e : edges)
      if (e >= 0) at_borders(e) = std::max(at_borders(e), most);
  }
  return at_borders;
}

// m: of the rows of all pairs.
VecX opened_rows(const ContactPair& pair, const VecX& overlaps, Eigen::Index rows) {
  VecX weights = VecX::Zero(pair.coupling.B.rows()), all = VecX::Zero(rows);
  for (const ContactPoint& point : pair.points)
    if (overlaps(point.edge) > 0) add_pressure_at(pair, point.edge, point.xi, point.dA * overlaps(point.edge), weights);
  all.segment(pair.first_row, weights.size()) = weights;
  return all;
}

}  // namespace

BorderOverlaps::BorderOverlaps(const Problem& problem, const Solution& solution,
                               const std::vector<PressureEstimate>& pressures, bool each) {
  const SaddlePointSystem& system = problem.discretisation.system;
  const Eigen::Index pairs = Eigen::Index(problem.pairs.size());
  MatX rows(system.B.rows(), 0);
  shares_.resize(pairs, 0);
  for (Eigen::Index k = 0; k < pairs; ++k) {
    const ContactPair& pair = problem.pairs[k];
    if (pair.spec.stiffness || pressures[k].local.borders.empty()) continue;
    const VecX opened = opened_rows(pair, overlaps_at_borders(pair, pressures[k], solution.u), rows.rows());
    if (!opened.any()) continue;
    if (each || rows.cols() == 0) {
      rows.conservativeResize(Eigen::NoChange, rows.cols() + 1);
      rows.rightCols(1).setZero();
      shares_.conservativeResize(Eigen::NoChange, rows.cols());
      shares_.rightCols(1).setZero();
    }
    rows.rightCols(1) += opened;
    shares_.rightCols(1)(k) = opened.lpNorm<1>();
  }
  if (rows.cols() == 0) return;
  for (auto column : shares_.colwise()) column /= column.sum();
  answers_ = contact_factor(system, solution)->answers(rows, {});
}

MatX BorderOverlaps::changes(const MatX& rows, const MatX& loads) const {
  if (shares_.cols() == 0) return MatX::Zero(shares_.rows(), rows.cols());
  MatX found = -answers_.mu.transpose() * rows;
  if (loads.cols() > 0) found.rightCols(loads.cols()) += answers_.z.transpose() * loads;
  MatX all = shares_ * found.cwiseAbs();
  const Eigen::RowVectorXd sums = found.colwise().sum().cwiseAbs(), sizes = all.colwise().sum();
  for (Eigen::Index f = 0; f < all.cols(); ++f)
    if (sizes(f) > 0) all.col(f) *= sums(f) / sizes(f);
  return all;
}

WindowOverlaps BorderOverlaps::of_windows(const std::vector<ContactPair>& pairs,
                                          const std::vector<PressureEstimate>& pressures) const {
  std::vector<double> windows;
  VecX squares = VecX::Zero(shares_.cols());
  for (std::size_t k = 0; k < pairs.size(); ++k)
    for (const PressureWindow& window : pressures[k].windows) {
      if (shares_.cols() == 0) {
        windows.push_back(0);
        continue;
      }
      const VecX found = answers_.mu.middleRows(pairs[k].first_row, window.weights.size()).transpose() * window.weights;
      const double sum = std::abs(found.sum()), size = found.lpNorm<1>();
      windows.push_back(sum);
      if (size > 0) squares += window.length * (sum / size * found).cwiseAbs2();
    }
  return {Eigen::Map<VecX>(windows.data(), Eigen::Index(windows.size())), shares_ * squares.cwiseSqrt()};
}

VecX BorderOverlaps::motion(Eigen::Index unknowns) const {
  return shares_.cols() > 0 ? VecX(answers_.z.rowwise().sum()) : VecX::Zero(unknowns);
}

}  // namespace mortise
