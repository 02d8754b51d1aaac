#include "solve/dense_rows.hpp"

#include <limits>

#include "solve/refine.hpp"

namespace mortise {
namespace {

constexpr double least_tension = 1e-10;           // of the largest multiplier (over its scale)
constexpr double negligible_penetration = 1e-11;  // of the largest term of any w
constexpr double unheld = 1e-14;  // of the mean stiffness against motions: a few round-offs of its largest part

std::vector<int> active_rows(const std::vector<char>& active) {
  std::vector<int> rows;
  for (std::size_t a = 0; a < active.size(); ++a)
    if (active[a]) rows.push_back(int(a));
  return rows;
}

// Of the absolute values of the first m rows and columns of a lower triangle.
VecX row_sums(const MatX& lower, Eigen::Index m) {
  VecX sums = VecX::Zero(m);
  for (Eigen::Index j = 0; j < m; ++j) {
    const auto below = lower.col(j).segment(j + 1, m - j - 1).cwiseAbs();
    sums(j) += std::abs(lower(j, j)) + below.sum();
    sums.tail(m - j - 1) += below;
  }
  return sums;
}

}  // namespace

DenseRows::DenseRows(const ComplementarityProblem& problem, const VecX& rhs) : p_(problem), rhs_(rhs) {
  if (p_.round_off > 0)
    negligible_stress_ = p_.round_off / largest_entry(p_.compliance.diagonal().head(rows()).cwiseProduct(p_.scale));
}

ContactRows::Answer DenseRows::solve(const std::vector<char>& closed, const VecX& at) {
  system_.emplace(p_.compliance, springs(), active_rows(closed));
  Answer answer;
  answer.dependent_row = system_->dependent_row();
  if (answer.dependent_row >= 0) {
    answer.status = SolveStatus::dependent_row;
    return answer;
  }
  VecX rhs = rhs_, x = VecX::Zero(rhs_.size());  // x: what is known of it
  const bool correction = p_.known.size() > 0;
  if (correction) {
    for (Eigen::Index a = 0; a < rows(); ++a)
      if (!closed[a]) x(a) = -p_.known(a);
    rhs -= p_.compliance.selfadjointView<Eigen::Lower>() * x;
  }
  if (at.size() > 0) {
    rhs.head(rows()) -= opened(at);
    x.tail(springs()) = at;
  }
  const VecX found = system_->solve(rhs);
  x += found;
  const VecX sum = (p_.compliance.selfadjointView<Eigen::Lower>() * x).head(rows()), moved = opened(x.tail(springs()));
  answer.w = rhs_.head(rows()) - sum;
  answer.lambda = x.head(rows());
  if (correction) answer.lambda += p_.known;
  answer.mu = x.tail(springs());
  // Springs against unbalanced loads make the terms of w larger than any displacement; 1e-13 of them, a few hundred
  // round-offs, stays negligible.
  const double terms = largest(largest_entry(rhs_.head(rows())), largest_entry(sum)),
               moved_most = largest(largest_entry(answer.w), largest_entry(moved)),
               largest_gap = correction       ? p_.displacement
                             : springs() == 0 ? terms
                                              : largest(moved_most, 1e-2 * terms),
               largest_stress = largest_entry(answer.lambda.cwiseQuotient(p_.scale));
  answer.negligible_tension = std::max(least_tension * largest_stress, negligible_stress_);
  answer.negligible_penetration = std::max(negligible_penetration * largest_gap, p_.round_off);
  answer.driven_mode = system_->driven_mode(rhs, found, answer.lambda);
  answer.opening = opened(answer.driven_mode);
  return answer;
}

VecX DenseRows::gaps(const Forces& forces) const {
  const auto C = p_.compliance.topLeftCorner(rows(), rows()).selfadjointView<Eigen::Lower>();
  return rhs_.head(rows()) - C * unknown(forces.lambda) - opened(forces.mu);
}

VecX DenseRows::unbalanced(const VecX& lambda) const { return rhs_.tail(springs()) - Ht() * unknown(lambda); }

bool DenseRows::soften(const VecX& compliance) {
  compliance_ = compliance;
  if (row_sums_.size() == 0) row_sums_ = row_sums(p_.compliance, rows());
  coupled_.clear();
  soft_ = VecX::Zero(rows());
  for (Eigen::Index a = 0; a < rows(); ++a) {
    if (compliance(a) <= far_more * row_sums_(a))
      coupled_.push_back(int(a));
    else
      soft_(a) = 1 / (compliance(a) + p_.compliance(a, a));
  }
  MatX C = p_.compliance(coupled_, coupled_);
  C.diagonal() += compliance(coupled_);
  softened_ = DenseCholesky(std::move(C));
  if (softened_.failed() >= 0) return false;
  if (springs() == 0) return true;
  reduced_ = softened_.lower(Ht()(Eigen::all, coupled_).transpose());
  MatX T = reduced_.transpose() * reduced_ + Ht() * soft_.asDiagonal() * Ht().transpose();
  T.diagonal().array() += unheld * T.diagonal().mean();
  motions_.compute(T);
  return true;
}

// What is left out between soft rows and all others is solved for again: pressures far away may move a row by more than
// its gap, however soft it is.
ContactRows::Forces DenseRows::solve_softened(const VecX& gap, const VecX& work) {
  const VecX unit = stacked(diagonal(), stiffness()).cwiseSqrt().cwiseMax(std::numeric_limits<double>::min());
  const auto C = p_.compliance.topLeftCorner(rows(), rows()).selfadjointView<Eigen::Lower>();
  const VecX x = refined(
      stacked(gap, work), unit,
      [&](const VecX& left) { return uncoupled_solution(left.head(rows()), left.tail(springs())); },
      [&](const VecX& found) {
        const VecX lambda = found.head(rows());
        return stacked(C * lambda + compliance_.cwiseProduct(lambda) + opened(found.tail(springs())), Ht() * lambda);
      });
  return {.lambda = x.head(rows()), .mu = x.tail(springs())};
}

VecX DenseRows::uncoupled_solution(const VecX& gap, const VecX& work) const {
  VecX y = softened_.lower(gap(coupled_)), mu = VecX::Zero(springs());
  if (springs() > 0) {
    mu = motions_.solve(reduced_.transpose() * y + Ht() * soft_.cwiseProduct(gap) - work);
    y -= reduced_ * mu;
  }
  VecX lambda = soft_.cwiseProduct(gap - opened(mu));
  lambda(coupled_) = VecX(softened_.upper(y));
  return stacked(lambda, mu);
}

}  // namespace mortise
