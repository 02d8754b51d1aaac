#include "ddm/solve_feti.hpp"

#include <cmath>

#include "base/stopwatch.hpp"
#include "ddm/closed_rows.hpp"
#include "solve/contact_factor.hpp"

namespace mortise {
namespace {

constexpr double first_tolerance = 1e-4;  // of the inner iterations, until they change no row
constexpr double dual_tolerance = 1e-5;   // of duals: products of errors, which are no more exact than a percent
constexpr double round_off = 10;          // tolerances: what is smaller opens and closes no row
constexpr int max_active_sets = 100, max_stalled = 10, most_refinements = 2;

// Duals by the same iteration.
class FetiFactor : public ContactFactor {
 public:
  FetiFactor(std::shared_ptr<const DualSystem> system, std::shared_ptr<const ClosedRows> rows,
             const SaddlePointSystem& s, int max_iterations)
      : system_(std::move(system)),
        rows_(std::move(rows)),
        row_scale_(s.row_scale),
        stiffness_scale_(s.stiffness_scale),
        unknowns_(s.K.cols()),
        max_iterations_(max_iterations) {}

  MatX duals(const MatX& functionals, const MatX& loads) const override {
    const Eigen::Index count = functionals.cols();
    MatX z = MatX::Zero(unknowns_, count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const Eigen::Index load = k - (count - loads.cols());
      DualSystem::Answer forces =
          system_->answer(load < 0 ? VecX::Zero(unknowns_).eval() : VecX(loads.col(load) / stiffness_scale_));
      forces.r -= functionals.col(k).cwiseQuotient(row_scale_);
      IterationMonitor monitor(dual_tolerance, max_iterations_);
      DualSolution x{.lambda = VecX::Zero(functionals.rows()), .mu = {}};
      rows_->solve(forces, monitor, x);
      VecX dual = VecX::Zero(unknowns_);
      system_->add_displacements(forces, x.lambda, x.mu, dual);
      z.col(k) = dual;
    }
    return z;
  }

 private:
  std::shared_ptr<const DualSystem> system_;
  std::shared_ptr<const ClosedRows> rows_;
  VecX row_scale_;
  double stiffness_scale_;
  Eigen::Index unknowns_;
  int max_iterations_;
};

std::vector<char> closed_at_first(const SaddlePointSystem& s) {
  std::vector<char> closed = s.start;
  if (closed.empty()) closed.assign(s.B.rows(), 1);
  for (Eigen::Index a = 0; a < s.B.rows(); ++a)
    if (s.unilateral.empty() || !s.unilateral[a]) closed[a] = 1;
  return closed;
}

// What is left open of the rows, and what a driven motion opens.
struct Openings {
  VecX w, driven;
  double size;  // of the largest term of w
};

// Unilateral rows that are closed and in tension, or open and penetrated; `step` has the most of both.
std::vector<int> infeasible_rows(const SaddlePointSystem& s, const VecX& lambda, const Openings& openings,
                                 double tolerance, const std::vector<char>& closed, ActiveSetStep& step) {
  const VecX stress = lambda.cwiseQuotient(s.row_scale);
  const double tension = tolerance * largest_entry(stress), penetration = tolerance * openings.size,
               least_opening = 1e-8 * largest_entry(openings.driven);
  std::vector<int> infeasible;
  for (std::size_t a = 0; a < closed.size(); ++a) {
    step.active += closed[a];
    if (s.unilateral.empty() || !s.unilateral[a]) continue;
    if (closed[a]) {
      step.tension = std::max(step.tension, s.stiffness_scale * stress(a));
      if (stress(a) > tension) infeasible.push_back(int(a));
      continue;
    }
    step.penetration = std::max(step.penetration, -openings.w(a));
    const bool driven = std::abs(openings.driven(a)) > least_opening;
    if (driven ? openings.driven(a) < 0 : openings.w(a) < -penetration) infeasible.push_back(int(a));
  }
  return infeasible;
}

// The active set method around the conjugate gradients.
class Outer {
 public:
  Outer(const SaddlePointSystem& s, const DualSystem& system, const FetiOptions& options)
      : s_(s),
        system_(system),
        tolerance_(options.tolerance),
        max_iterations_(options.max_iterations),
        monitor_(options.tolerance, options.max_iterations) {}

  int refining_steps = 0;  ///< after the monitor's

  const IterationMonitor& monitor() const { return monitor_; }
  /// Of the last active set.
  const std::shared_ptr<const ClosedRows>& rows() const { return rows_; }

  void run(Solution& solution) {
    DualSolution x{.lambda = VecX::Zero(s_.B.rows()), .mu = {}};
    find_active_set(x, solution);
    if (solution.status == SolveStatus::dependent_row || solution.status == SolveStatus::unconstrained) return;
    solution.lambda = s_.stiffness_scale * x.lambda.cwiseQuotient(s_.row_scale);
    solution.u = s_.constraints.value;
    system_.add_displacements(system_.load, x.lambda, x.mu, solution.u);
    measure_residuals(s_, solution);
    for (int pass = 0; pass < most_refinements && solution.status == SolveStatus::converged; ++pass) {
      if (solution.force_residual <= 1e-11 && solution.constraint_residual <= tolerance_) break;
      refine(solution);
    }
  }

 private:
  void find_active_set(DualSolution& x, Solution& solution) {
    double tolerance = s_.unilateral.empty() ? tolerance_ : std::max(first_tolerance, tolerance_);
    std::size_t fewest = s_.B.rows() + 1;
    solution.active = closed_at_first(s_);
    for (int set = 1, left = max_stalled;; ++set) {
      rows_ = std::make_shared<ClosedRows>(system_, solution.active);
      solution.failed_at = rows_->dependent_row;
      solution.status = SolveStatus::dependent_row;
      if (solution.failed_at >= 0) return;
      monitor_.restart(tolerance);
      rows_->solve(system_.load, monitor_, x);
      solution.status = monitor_.status();
      if (solution.status != SolveStatus::converged) return;
      solution.rigid_modes = rows_->free_motions;
      examine(x, tolerance, solution);
      const bool driven = solution.driven_mode.any();
      if (solution.infeasible.empty()) {
        if (driven) solution.status = SolveStatus::unconstrained;
        if (driven || tolerance == tolerance_) return;
        tolerance = tolerance_;
        continue;
      }
      solution.status = SolveStatus::not_converged;
      if (set == max_active_sets) return;
      if (solution.infeasible.size() < fewest) {
        fewest = solution.infeasible.size();
        left = max_stalled;
      } else if (--left < 0) {  // as solve/active_set.cpp
        solution.infeasible.resize(1);
      }
      solution.steps.back().changed = int(solution.infeasible.size());
      for (const int a : solution.infeasible) solution.active[a] ^= 1;
    }
  }

  void examine(const DualSolution& x, double tolerance, Solution& solution) const {
    const VecX closing = system_.closing(x.lambda, x.mu);
    solution.driven_mode = rows_->driven_motion(system_.load, x.lambda);
    const Openings openings{.w = system_.load.r - closing,
                            .driven = system_.rows().whole(system_.H * solution.driven_mode),
                            .size = largest(largest_entry(system_.load.r), largest_entry(closing))};
    solution.infeasible =
        infeasible_rows(s_, x.lambda, openings, round_off * tolerance, solution.active, solution.steps.emplace_back());
  }

  // By what the solution leaves of the forces and the gaps.
  void refine(Solution& solution) {
    const VecX Ku = s_.K.selfadjointView<Eigen::Lower>() * solution.u;
    DualSystem::Answer left = system_.answer((s_.f - Ku - s_.B.transpose() * solution.lambda) / s_.stiffness_scale);
    left.r -= (s_.g - s_.B * solution.u).cwiseQuotient(s_.row_scale);
    DualSolution x{.lambda = VecX::Zero(s_.B.rows()), .mu = {}};
    IterationMonitor monitor(first_tolerance, max_iterations_);
    rows_->solve(left, monitor, x);
    refining_steps += monitor.steps();
    solution.lambda += s_.stiffness_scale * x.lambda.cwiseQuotient(s_.row_scale);
    system_.add_displacements(left, x.lambda, x.mu, solution.u);
    measure_residuals(s_, solution);
  }

  const SaddlePointSystem& s_;
  const DualSystem& system_;
  double tolerance_;
  int max_iterations_;
  IterationMonitor monitor_;
  std::shared_ptr<const ClosedRows> rows_;
};

}  // namespace

Solution solve_by_feti(const SaddlePointSystem& s, const FetiOptions& options) {
  Solution solution;
  solution.constraint_tolerance = options.tolerance;
  Stopwatch watch;
  const auto system = std::make_shared<const DualSystem>(s);
  if (system->failed_at >= 0) {
    solution.status = SolveStatus::not_positive_definite;
    solution.failed_at = system->failed_at;
    return solution;
  }
  solution.factorise_seconds = watch.lap();
  Outer outer(s, *system, options);
  outer.run(solution);
  if (solution.status == SolveStatus::dependent_row || solution.status == SolveStatus::unconstrained) return solution;
  const IterationMonitor& monitor = outer.monitor();
  solution.iteration = Iteration{.method = "feti",
                                 .acceleration = Acceleration::krylov,
                                 .settings = {},
                                 .advice = {},
                                 .tolerance = options.tolerance,
                                 .steps = monitor.steps() + outer.refining_steps,
                                 .convergence_rate = monitor.convergence_rate(),
                                 .history = monitor.history(),
                                 .figures = {}};
  solution.factor = std::make_shared<FetiFactor>(system, outer.rows(), s, options.max_iterations);
  solution.solve_seconds = watch.lap();
  return solution;
}

}  // namespace mortise
