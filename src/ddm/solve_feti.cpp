#include "ddm/solve_feti.hpp"

#include "base/parallel.hpp"
#include "base/stopwatch.hpp"
#include "ddm/closed_rows.hpp"
#include "ddm/soft_rows.hpp"
#include "solve/active_set.hpp"
#include "solve/contact_factor.hpp"
#include "solve/threads.hpp"

namespace mortise {
namespace {

constexpr double first_tolerance = 1e-4;  // of the inner iterations, until they change no row
constexpr double dual_tolerance = 1e-5;   // of duals: products of errors, which are no more exact than a percent
constexpr Eigen::Index most_at_once = 8;  // duals: their vectors stay in the processor's caches with a body's matrix
constexpr double round_off = 10;          // tolerances: what is smaller opens and closes no row
constexpr double wide_gap = 0.3;          // of a row's part of the contact curve
constexpr int most_refinements = 2, most_corrections = 8;

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

  DualAnswers answers(const MatX& functionals, const MatX& loads) const override {
    const Eigen::Index count = functionals.cols(), blocks = (count + most_at_once - 1) / most_at_once;
    DualAnswers duals{.z = MatX::Zero(unknowns_, count), .mu = MatX(functionals.rows(), count)};
    for_each_index(blocks, solver_threads(), [&](std::size_t k) {
      const Eigen::Index first = Eigen::Index(k) * count / blocks,
                         some = (Eigen::Index(k) + 1) * count / blocks - first;
      MatX forces = MatX::Zero(unknowns_, some);
      for (Eigen::Index i = 0; i < some; ++i)
        if (const Eigen::Index load = first + i - (count - loads.cols()); load >= 0)
          forces.col(i) = loads.col(load) / stiffness_scale_;
      DualSystem::Answer answer = system_->answer(forces);
      answer.r -= row_scale_.cwiseInverse().asDiagonal() * functionals.middleCols(first, some);
      std::vector<IterationMonitor> monitors(some, IterationMonitor(dual_tolerance, max_iterations_));
      DualSolution found{.lambda = MatX::Zero(functionals.rows(), some), .mu = {}};
      rows_->solve(answer, monitors, found);
      system_->add_displacements(answer, found.lambda, found.mu, duals.z.middleCols(first, some));
      duals.mu.middleCols(first, some) = stiffness_scale_ * (row_scale_.cwiseInverse().asDiagonal() * found.lambda);
    });
    return duals;
  }

 private:
  std::shared_ptr<const DualSystem> system_;
  std::shared_ptr<const ClosedRows> rows_;
  VecX row_scale_;
  double stiffness_scale_;
  Eigen::Index unknowns_;
  int max_iterations_;
};

struct State {
  VecX u, lambda;  // n (length), m (stress units), as Solution's
};

// Of the rows' dimensionless ones.
VecX stresses(const SaddlePointSystem& s, const VecX& lambda) {
  return s.stiffness_scale * lambda.cwiseQuotient(s.row_scale);
}

// What a state leaves open of the rows, m.
VecX opening(const SaddlePointSystem& s, const VecX& u) { return (s.B * u - s.g).cwiseQuotient(s.row_scale); }

// Adds what the state leaves of the forces and the gaps. What was added of the displacements, over them.
double correct(const SaddlePointSystem& s, const DualSystem& system, const ClosedRows& rows, IterationMonitor& monitor,
               State& state) {
  const VecX Ku = s.K.selfadjointView<Eigen::Lower>() * state.u;
  DualSystem::Answer left = system.answer((s.f - Ku - s.B.transpose() * state.lambda) / s.stiffness_scale);
  left.r += opening(s, state.u);
  DualSolution x{.lambda = VecX::Zero(s.B.rows()), .mu = {}};
  rows.solve(left, {&monitor, 1}, x);
  const VecX before = state.u;
  state.lambda += stresses(s, x.lambda);
  system.add_displacements(left, x.lambda, x.mu, state.u);
  return fraction(largest_entry(state.u - before), largest_entry(state.u));
}

// Solved by conjugate gradients, each time from the last multipliers; loosely until no row changes.
class FetiRows : public ContactRows {
 public:
  FetiRows(const SaddlePointSystem& s, const DualSystem& system, const FetiOptions& options)
      : s_(s),
        system_(system),
        unilateral_(s.unilateral.empty() ? std::vector<char>(s.B.rows(), 0) : s.unilateral),
        tolerance_(s.unilateral.empty() ? options.tolerance : std::max(first_tolerance, options.tolerance)),
        final_tolerance_(options.tolerance),
        monitor_(options.tolerance, options.max_iterations) {
    x_.lambda = VecX::Zero(s.B.rows());
  }

  // Of the last active set.
  VecX displacements(const VecX& lambda, const VecX& mu) const {
    if (state_.u.size() > 0) return state_.u;
    VecX u = s_.constraints.value;
    system_.add_displacements(system_.load, lambda, mu, u);
    return u;
  }

  Answer solve(const std::vector<char>& closed, const VecX& at) override {
    Answer answer;
    rows_ = std::make_shared<ClosedRows>(system_, closed);
    answer.dependent_row = rows_->dependent_row;
    answer.status = SolveStatus::dependent_row;
    if (answer.dependent_row >= 0) return answer;
    const bool corrects = !system_.slender.empty();
    monitor_.restart(corrects ? std::max(first_tolerance, tolerance_) : tolerance_);
    DualSystem::Forces forces = system_.load;
    if (at.size() > 0) forces.r -= system_.opening(at);
    rows_->solve(forces, {&monitor_, 1}, x_);
    if (at.size() > 0) x_.mu += at;
    state_ = {};
    if (corrects) correct_round_off();
    answer.status = monitor_.status();
    answer.lambda = x_.lambda;
    answer.mu = x_.mu;
    const VecX pressed = system_.multiply(answer.lambda), moved = system_.opening(answer.mu);
    answer.w = corrects ? opening(s_, state_.u) : VecX(system_.load.r - pressed - moved);
    answer.negligible_tension = round_off * tolerance_ * largest_entry(answer.lambda.cwiseQuotient(s_.row_scale));
    answer.negligible_penetration =
        round_off * tolerance_ * (corrects ? largest_entry(state_.u) : size_of(answer.w, pressed, moved));
    answer.driven_mode = rows_->driven_motion(system_.load.h, answer.lambda);
    answer.opening = system_.opening(answer.driven_mode);
    return answer;
  }

  bool refine() override {
    const bool better = tolerance_ > final_tolerance_;
    tolerance_ = final_tolerance_;
    return better;
  }
  MatX free_motions() const override { return rows_->free_motions; }

  const VecX& scale() const override { return s_.row_scale; }
  const std::vector<char>& unilateral() const override { return unilateral_; }
  Eigen::Index motions() const override { return system_.H.cols(); }
  VecX diagonal() const override { return system_.diagonal; }
  VecX stiffness() const override { return system_.stiffness(); }
  MatX openings() const override { return system_.H; }
  VecX gaps(const Forces& forces) const override {
    return system_.load.r - system_.multiply(forces.lambda) - system_.opening(forces.mu);
  }
  VecX unbalanced(const VecX& lambda) const override { return system_.load.h - system_.resultants(lambda); }

  bool soften(const VecX& compliance) override {
    if (!softened_) softened_.emplace(system_.matrix(), s_.B.rows());
    return softened_->factorise(compliance);
  }

  Forces solve_softened(const VecX& gap, const VecX& work) override { return softened_->solve(gap, work); }

  const IterationMonitor& monitor() const { return monitor_; }
  /// Of the last active set.
  const std::shared_ptr<const ClosedRows>& rows() const { return rows_; }

 private:
  // What openings w are compared with, where they are those of pressures and motions.
  double size_of(const VecX& w, const VecX& pressed, const VecX& moved) const {
    const VecX gap = s_.g.cwiseQuotient(s_.row_scale), displaced = w + gap;  // one side against the other
    // Gaps as they are drawn, which may be far wider than anything moves, are no terms that the iteration has off.
    const double terms = largest(largest_entry(system_.load.r + gap), largest_entry(pressed));
    return system_.size(largest(largest_entry(displaced), largest_entry(moved)), terms);
  }

  // A slender body moves far under pressures that are off by round-off.
  void correct_round_off() {
    state_ = {.u = s_.constraints.value, .lambda = stresses(s_, x_.lambda)};
    system_.add_displacements(system_.load, x_.lambda, x_.mu, state_.u);
    double added = 1;
    for (int pass = 0;
         pass < most_corrections && monitor_.status() == SolveStatus::converged && added > tolerance_ / first_tolerance;
         ++pass) {
      monitor_.restart(first_tolerance);
      added = correct(s_, system_, *rows_, monitor_, state_);
    }
    x_.lambda = state_.lambda.cwiseProduct(s_.row_scale) / s_.stiffness_scale;
  }

  const SaddlePointSystem& s_;
  const DualSystem& system_;
  const std::vector<char> unilateral_;
  double tolerance_, final_tolerance_;
  std::optional<SoftRows> softened_;
  IterationMonitor monitor_;
  std::shared_ptr<const ClosedRows> rows_;
  DualSolution x_;
  State state_;  // where slender parts' round-off was corrected
};

// But for wide gaps, which loads seldom close.
std::vector<char> closed_at_first(const SaddlePointSystem& s) {
  if (!s.start.empty()) return s.start;
  std::vector<char> closed(s.B.rows());
  for (Eigen::Index a = 0; a < s.B.rows(); ++a) closed[a] = -s.g(a) <= wide_gap * s.row_scale(a) * s.row_scale(a);
  return closed;
}

}  // namespace

Solution solve_by_feti(const SaddlePointSystem& s, const FetiOptions& options, const std::vector<double>& slenderness) {
  Solution solution;
  solution.constraint_tolerance = options.tolerance;
  Stopwatch watch;
  const auto system = std::make_shared<const DualSystem>(s, slenderness);
  if (system->failed_at >= 0) {
    solution.status = SolveStatus::not_positive_definite;
    solution.failed_at = system->failed_at;
    return solution;
  }
  solution.factorise_seconds = watch.lap();
  FetiRows rows(s, *system, options);
  const ActiveSetResult set = find_active_set(rows, closed_at_first(s));
  take_active_set(s, set, solution);
  if (solution.status == SolveStatus::dependent_row || solution.status == SolveStatus::unconstrained) return solution;
  solution.lambda = stresses(s, set.lambda);
  solution.u = rows.displacements(set.lambda, set.mu);
  measure_residuals(s, solution);
  // A few hundred round-offs of the terms of the gaps, which springs against unbalanced loads make larger than any
  // displacement.
  const double lost = 1e-13 * fraction(largest_entry(system->load.r), largest_entry(solution.u));
  const double tension = s.stiffness_scale * set.negligible_tension;
  int refining_steps = 0;
  for (int pass = 0; pass < most_refinements && solution.status == SolveStatus::converged; ++pass) {
    const double left = pass == 0 ? largest(solution.constraint_residual, lost) : solution.constraint_residual;
    if (solution.force_residual <= 1e-11 && left <= options.tolerance) break;
    IterationMonitor monitor(first_tolerance, options.max_iterations);
    State state{.u = solution.u, .lambda = solution.lambda};
    correct(s, *system, *rows.rows(), monitor, state);
    refining_steps += monitor.steps();
    Solution refined = solution;
    refined.u = std::move(state.u);
    refined.lambda = std::move(state.lambda);
    // Of a body without load it is round-off of the others' forces that is refined, which may pull at closed rows.
    if (!is_infeasible(s, solution, tension) && is_infeasible(s, refined, tension)) break;
    measure_residuals(s, refined);
    solution = std::move(refined);
  }
  const IterationMonitor& monitor = rows.monitor();
  solution.iteration = Iteration{.method = "feti",
                                 .acceleration = Acceleration::krylov,
                                 .settings = {},
                                 .advice = {},
                                 .tolerance = options.tolerance,
                                 .steps = monitor.steps() + refining_steps,
                                 .convergence_rate = monitor.convergence_rate(),
                                 .history = monitor.history(),
                                 .figures = {}};
  solution.factor = std::make_shared<FetiFactor>(system, rows.rows(), s, options.max_iterations);
  solution.solve_seconds = watch.lap();
  return solution;
}

}  // namespace mortise
