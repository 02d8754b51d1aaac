#include "solve/direct.hpp"

#include <algorithm>
#include <utility>

#include "base/stopwatch.hpp"
#include "solve/active_set.hpp"
#include "solve/bordered_system.hpp"
#include "solve/known_loads.hpp"

namespace mortise {
namespace {

constexpr int max_passes = 6;

VecX on(const std::vector<int>& free, const VecX& v) { return v(free); }

bool is_without_solution(const Solution& solution) {
  return solution.status == SolveStatus::dependent_row || solution.status == SolveStatus::unconstrained;
}

// The first pass solves, as a rule to round-off of the residual itself; others refine where it did not.
class Passes {
 public:
  Passes(const SaddlePointSystem& s, const FactoredBodies& bodies, KnownLoads& loads, ComplementarityProblem& problem,
         Solution& solution)
      : s_(s), factor_(bodies.factor), free_(bodies.free), loads_(loads), problem_(problem), solution_(solution) {
    solution_.u = s_.constraints.value;
    solution_.lambda = VecX::Zero(s_.B.rows());
    problem_.round_off = problem_.displacement = 0;
    problem_.known = {};
  }

  // False if another pass would change nothing, or nothing for the better.
  bool next() {
    const Eigen::Index m = s_.B.rows();
    VecX unbalanced = pass_ > 0 ? solution_.unbalanced : s_.f;
    if (pass_ == 0 && solution_.u.any()) unbalanced -= s_.K.selfadjointView<Eigen::Lower>() * solution_.u;
    const VecX load = on(free_, unbalanced) / s_.stiffness_scale, y = factor_.forward(load);
    VecX rhs = factor_.at_border(y);
    rhs.head(m) -= (s_.g - s_.B * solution_.u).cwiseQuotient(s_.row_scale);
    const std::optional<VecX> lambda = multipliers_for(load, y, rhs);
    if (!lambda) return false;
    solution_.u(free_) += factor_.backward(y, *lambda);
    solution_.lambda += s_.stiffness_scale * lambda->head(m).cwiseQuotient(s_.row_scale);
    measure_residuals(s_, solution_);
    const double left = largest(solution_.force_residual, solution_.constraint_residual),
                 before = std::exchange(left_, left);
    const bool exact = left < 1e-11;
    const bool stands = pass_ > 0 && !infeasible_ && !(left < before / 2);
    if (solution_.status != SolveStatus::converged || (stands && !exact)) return false;
    infeasible_ = is_infeasible(s_, solution_, tension_);
    if (!exact && !infeasible_) feasible_ = solution_;
    ++pass_;
    return !exact || infeasible_;
  }

  std::optional<MultiplierSystem> system;  // of the active set

 private:
  // What lambda and mu change by; nothing where no active set is found, or none for the better.
  std::optional<VecX> multipliers_for(const VecX& load, const VecX& y, const VecX& rhs) {
    if (pass_ > 0 && !infeasible_) return system->solve(rhs);
    if (pass_ > 0) {
      problem_.known = solution_.lambda.cwiseProduct(s_.row_scale) / s_.stiffness_scale;
      problem_.displacement = largest_entry(solution_.u);
      problem_.round_off = 0;
    } else if (!s_.unilateral.empty()) {
      // Of the largest displacement without contact, floating bodies held by their springs: gaps are its differences.
      problem_.round_off =
          1e-12 * largest(largest_entry(s_.constraints.value), loads_.displacement(factor_, rhs.size(), load, y));
    }
    ActiveSetResult set = find_active_set(problem_, rhs, pass_ > 0 ? solution_.active : s_.start);
    if (pass_ > 0 && set.status != SolveStatus::converged) {  // those before stay; the checks look at them
      if (feasible_) solution_ = *std::exchange(feasible_, {});
      return {};
    }
    take_active_set(s_, set, solution_);
    if (pass_ == 0) tension_ = s_.stiffness_scale * set.negligible_tension;
    if (is_without_solution(solution_)) return {};
    feasible_.reset();  // of other rows
    if (pass_ > 0) set.lambda -= problem_.known;
    const VecX change = stacked(set.lambda, set.mu);
    system = std::move(set.system);
    return change;
  }

  const SaddlePointSystem& s_;
  const SplitCholesky& factor_;
  const std::vector<int>& free_;
  KnownLoads& loads_;
  ComplementarityProblem& problem_;
  Solution& solution_;
  int pass_ = 0;
  bool infeasible_ = false;
  // What is refined, where its rows are as they must be: what it leaves of the forces on a body without load, round-off
  // of the others', may pull at rows that the refinement keeps closed.
  std::optional<Solution> feasible_;
  double left_ = 0;     // residual of the pass before
  double tension_ = 0;  // that is round-off, as the first pass has it
};

}  // namespace

DirectSolver::DirectSolver(const SaddlePointSystem& s) : system_(s) {
  Stopwatch watch;
  BorderedSystem reduced = bordered_system(s);
  SplitCholesky factor(std::move(reduced.matrix), reduced.blocks);
  if (factor.failed_at() >= 0) {
    failed_at_ = reduced.free[std::min(factor.failed_at(), int(reduced.free.size()) - 1)];
    return;
  }
  problem_.compliance = factor.take_border_compliance();
  problem_.scale = s.row_scale;
  problem_.unilateral = s.unilateral.empty() ? std::vector<char>(s.B.rows(), 0) : s.unilateral;
  bodies_ = std::make_shared<FactoredBodies>(std::move(reduced.free), std::move(factor));
  factorise_seconds_ = watch.lap();
}

Solution DirectSolver::solve() {
  Solution solution;
  if (failed_at_ >= 0) {
    solution.status = SolveStatus::not_positive_definite;
    solution.failed_at = failed_at_;
    return solution;
  }
  Stopwatch watch;
  solution.factorise_seconds = std::exchange(factorise_seconds_, 0);
  Passes passes(system_, *bodies_, loads_, problem_, solution);
  for (int pass = 0; pass < max_passes && passes.next(); ++pass) {
  }
  if (is_without_solution(solution)) return solution;
  if (!std::isfinite(largest(solution.force_residual, solution.constraint_residual)))
    solution.status = SolveStatus::not_converged;
  if (!factor_ || solution.active != closed_)
    factor_ = std::make_shared<DirectFactor>(system_, bodies_, *std::move(passes.system));
  closed_ = solution.active;
  solution.factor = factor_;
  solution.solve_seconds = watch.lap();
  return solution;
}

Solution solve_directly(const SaddlePointSystem& system) { return DirectSolver(system).solve(); }

}  // namespace mortise
