#include "preprint_solvers/ddm_rows.hpp"

#include <limits>

namespace mortise {
namespace {

constexpr double first_tolerance = 1e-2;  // until no row changes
constexpr double round_off = 10;          // tolerances: what is smaller opens and closes no row

}  // namespace

GroupPair group_pair(BodyGroup neumann, BodyGroup dirichlet, const SaddlePointSystem& s) {
  const Eigen::Index m = s.B.rows(), springs = neumann.motions + dirichlet.motions;
  GroupPair groups{.neumann = std::move(neumann),
                   .dirichlet = std::move(dirichlet),
                   .gap0 = (s.B * s.constraints.value - s.g).cwiseQuotient(s.row_scale),
                   .problem = {.compliance = MatX::Zero(m + springs, m + springs),
                               .scale = s.row_scale,
                               .unilateral = s.unilateral.empty() ? std::vector<char>(m, 0) : s.unilateral},
                   .rhs = {}};
  const BodyGroup &first = groups.neumann, &second = groups.dirichlet;
  groups.problem.compliance.topLeftCorner(m, m) = first.C + second.C;
  groups.problem.compliance.bottomLeftCorner(springs, m) << first.H.transpose(), second.H.transpose();
  groups.rhs =
      stacked(groups.gap0 + first.load.response + second.load.response, stacked(first.load.work, second.load.work));
  return groups;
}

DdmRows::DdmRows(const GroupPair& groups, const DdmOptions& options)
    : DenseRows(groups.problem, groups.rhs),
      groups_(groups),
      options_(options),
      asked_(options.tolerance),
      tolerance_(asked_),
      lambda_(VecX::Zero(groups.gap0.size())) {
  if (options.acceleration == Acceleration::krylov && std::ranges::count(groups.problem.unilateral, 1) > 0)
    tolerance_ = std::max(first_tolerance, options.tolerance);
}

Spectrum DdmRows::closed_spectrum() const {
  const InterfaceIteration iteration = make_iteration(options_.scheme, interface_);
  return iteration.dependent_row < 0 ? spectrum(iteration, interface_.gap.size()) : Spectrum{};
}

bool DdmRows::refine() {
  const bool better = tolerance_ > asked_;
  tolerance_ = std::max(first_tolerance * tolerance_, asked_);
  return better;
}

RelaxationOptions DdmRows::relaxation(const InterfaceIteration& iteration) {
  RelaxationOptions relaxation{options_.acceleration, 1, tolerance_,
                               std::max(1, options_.max_iterations - int(history_.size()))};
  beta_ = 0;
  if (options_.acceleration != Acceleration::krylov && interface_.gap.size() > 0) {
    spectrum_ = spectrum(iteration, interface_.gap.size());
    relaxation.beta = beta_ = options_.beta.value_or(spectrum_.best_beta());
  }
  return relaxation;
}

SolveStatus DdmRows::iterate(const InterfaceIteration& iteration, VecX& lambda) {
  // z of the Neumann-Dirichlet iteration is at hand; the other schemes ask the Dirichlet group.
  const bool direct = options_.scheme == Scheme::neumann_dirichlet;
  const auto left_of = [&](const VecX& at, const VecX& taken) { return residuals(interface_, at, taken - at); };
  const Measure measure = [&](const VecX& x, const VecX& z) {
    if (direct) return residuals(interface_, x, z);
    const VecX at = iteration.multipliers(x);
    return left_of(at, solve_dirichlet(interface_, at).lambda);
  };
  VecX x = iteration.start(lambda);
  for (double least = std::numeric_limits<double>::infinity();;) {
    RelaxationResult result = relax(iteration.correction, measure, x, relaxation(iteration));
    const double before = history_.empty() ? 0 : history_.back().seconds;
    for (IterationStep& step : result.history) {
      step.seconds += before;
      history_.push_back(step);
    }
    convergence_rate_ = result.convergence_rate;
    x = std::move(result.x);
    const VecX at = iteration.multipliers(x);
    lambda = solve_dirichlet(interface_, at).lambda;
    if (result.status != SolveStatus::converged) return result.status;
    // An accelerated z is a sum of many, with their round-off.
    history_.back().residuals = left_of(at, lambda);
    const double left = history_.back().residuals.largest();
    if (left <= tolerance_) return SolveStatus::converged;
    if (!(left < least / 2)) return SolveStatus::not_converged;
    least = left;
  }
}

ContactRows::Answer DdmRows::solve(const std::vector<char>& closed, const VecX& at) {
  std::vector<int> rows;
  for (std::size_t a = 0; a < closed.size(); ++a)
    if (closed[a]) rows.push_back(int(a));
  const VecX gap0 = at.size() > 0 ? VecX(groups_.gap0 - openings() * at) : groups_.gap0;
  interface_ = make_interface(groups_.neumann, groups_.dirichlet, gap0, scale(), rows);
  const InterfaceIteration iteration = make_iteration(options_.scheme, interface_);
  Answer answer;
  if (iteration.dependent_row >= 0) {
    answer.status = SolveStatus::dependent_row;
    answer.dependent_row = rows[iteration.dependent_row];
    return answer;
  }
  VecX lambda = lambda_(rows);
  answer.status = iterate(iteration, lambda);
  const DirichletSolution taken = solve_dirichlet(interface_, lambda);
  lambda_.setZero();
  for (std::size_t k = 0; k < rows.size(); ++k) lambda_(rows[k]) = lambda(k);
  answer.lambda = lambda_;
  answer.mu = at.size() > 0 ? VecX(taken.mu + at) : taken.mu;
  answer.w = gaps({.lambda = answer.lambda, .mu = answer.mu});
  const VecX moved = rhs().head(gap0.size()) - answer.w;
  answer.negligible_tension = round_off * tolerance_ * largest_entry(lambda.cwiseQuotient(interface_.scale));
  answer.negligible_penetration = round_off * tolerance_ * largest_entry(moved);
  answer.driven_mode =
      interface_.dirichlet_closed->driven_mode(stacked(interface_.gap - interface_.neumann.C * lambda, interface_.work),
                                               stacked(taken.lambda, taken.mu), lambda);
  answer.opening = openings() * answer.driven_mode;
  return answer;
}

}  // namespace mortise
