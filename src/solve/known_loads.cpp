#include "solve/known_loads.hpp"

#include <limits>

namespace mortise {
namespace {

// Two vectors each: together less than the factor of a body has for each unknown.
constexpr std::size_t most_known = 16;

// Of a load, what the rounding of each entry leaves of a sum of others.
constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();

}  // namespace

double KnownLoads::displacement(const SplitCholesky& factor, Eigen::Index rows, const VecX& load, const VecX& y) {
  VecX rest = load, sum = VecX::Zero(load.size());
  for (const Known& known : known_) {
    const double part = known.load.dot(rest) / known.load.squaredNorm();
    rest -= part * known.load;
    sum += part * known.u;
  }
  if (!known_.empty() && rest.norm() <= rounding * load.norm()) return largest_entry(sum);
  const VecX u = factor.backward(y, VecX::Zero(rows));
  if (known_.size() < most_known && rest.squaredNorm() > 0) known_.push_back({std::move(rest), u - sum});
  return largest_entry(u);
}

}  // namespace mortise
