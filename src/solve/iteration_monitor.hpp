// Says when an iteration stops, and keeps its record.
#pragma once

#include "base/stopwatch.hpp"
#include "solve/solution.hpp"

namespace mortise {

/// What every iteration asks between its steps. It ends as converged where the largest residual is at most the
/// tolerance; as diverged where `size` is 1e6 times the smallest seen, or not finite; as not_converged after max_steps.
class IterationMonitor {
 public:
  IterationMonitor(double tolerance, int max_steps) : tolerance_(tolerance), max_steps_(max_steps) {}

  /// Of an iterate, and the Euclidean norm of what is left of it. True while there is something left to do.
  bool go_on(const Residuals& residuals, double size);
  /// The relaxation of the step that was taken.
  void took(double beta) { history_.back().beta = beta; }
  /// The iteration starts anew from where it stands, and is held to another tolerance.
  void restart(double tolerance);

  SolveStatus status() const { return status_; }
  int steps() const { return steps_; }
  bool exhausted() const { return steps_ >= max_steps_; }
  double tolerance() const { return tolerance_; }
  const std::vector<IterationStep>& history() const { return history_; }
  /// As Iteration::convergence_rate.
  double convergence_rate() const;

 private:
  double tolerance_;
  int max_steps_, steps_ = 0;
  SolveStatus status_ = SolveStatus::not_converged;
  std::vector<IterationStep> history_;
  std::vector<double> sizes_;
  double smallest_ = std::numeric_limits<double>::infinity();
  Stopwatch watch_;
};

}  // namespace mortise
