#include "error/dual_functionals.hpp"

#include <algorithm>

namespace mortise {
namespace {

MatX window_functionals(const std::vector<ContactPair>& pairs, const std::vector<PressureEstimate>& pressures,
                        const SharedDuals& shared, Eigen::Index rows) {
  MatX columns = MatX::Zero(rows, shared.count);
  int window = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    for (const PressureWindow& w : pressures[k].windows)
      columns.col(shared.dual[window++]).segment(pairs[k].first_row, w.weights.size()) += w.weights;
  return columns;
}

MatX fluctuation_functionals(const std::vector<ContactPair>& pairs, const std::vector<PressureEstimate>& pressures,
                             Eigen::Index rows) {
  const Eigen::Index count = std::ranges::count_if(pressures, [](const auto& e) { return e.fluctuation.has_value(); });
  MatX columns = MatX::Zero(rows, count);
  Eigen::Index column = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (const auto& found = pressures[k].fluctuation)
      columns.col(column++).segment(pairs[k].first_row, found->weights.size()) = found->weights;
  return columns;
}

}  // namespace

MatX dual_functionals(const Problem& problem, const std::vector<PressureEstimate>& pressures,
                      const SharedDuals& windows, const MatX& also, const MatX& goals) {
  const Eigen::Index rows = problem.discretisation.system.B.rows();
  const MatX parts[] = {window_functionals(problem.pairs, pressures, windows, rows),
                        fluctuation_functionals(problem.pairs, pressures, rows), also, goals};
  Eigen::Index count = 0;
  for (const MatX& part : parts) count += part.cols();
  MatX all(rows, count);
  Eigen::Index column = 0;
  for (const MatX& part : parts)
    if (part.cols() > 0) {
      all.middleCols(column, part.cols()) = part;
      column += part.cols();
    }
  return all;
}

}  // namespace mortise
