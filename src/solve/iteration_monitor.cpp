#include "solve/iteration_monitor.hpp"

#include <algorithm>
#include <cmath>

namespace mortise {
namespace {

constexpr double divergence = 1e6;  // growth of the size

}  // namespace

bool IterationMonitor::go_on(const Residuals& residuals, double size) {
  history_.push_back({residuals, 0, watch_.elapsed()});
  sizes_.push_back(size);
  smallest_ = std::min(smallest_, size);
  if (residuals.largest() <= tolerance_) status_ = SolveStatus::converged;
  if (!std::isfinite(size) || size > divergence * smallest_) status_ = SolveStatus::diverged;
  if (status_ != SolveStatus::not_converged || exhausted()) return false;
  ++steps_;
  return true;
}

void IterationMonitor::restart(double tolerance) {
  tolerance_ = tolerance;
  status_ = SolveStatus::not_converged;
  smallest_ = std::numeric_limits<double>::infinity();
}

double IterationMonitor::convergence_rate() const {
  if (sizes_.empty()) return 0;
  const std::size_t last = sizes_.size() - 1, middle = last / 2;
  if (last == middle || sizes_[middle] == 0) return 0;  // nothing was left to reduce
  return std::pow(sizes_[last] / sizes_[middle], 1 / double(last - middle));
}

}  // namespace mortise
