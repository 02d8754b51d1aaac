#include "contact/tip_table.hpp"

#include <cmath>

#include "contact/joint_states.hpp"

namespace mortise {
namespace {

// What is alike makes one key, the angles as whoever comes first has them.
std::vector<double> key_of(Fan& fan, std::optional<std::size_t> joint) {
  std::vector<double> key{joint ? double(*joint) : -1, double(fan.first), double(fan.last)};
  for (const Joint of_two : fan.joints) key.push_back(double(of_two));
  for (Wedge& w : fan.wedges) {
    w.round(1e-10);
    const Eigen::Matrix3d ratios = w.compliance / fan.wedges[0].compliance(2, 2);
    key.insert(key.end(), {w.angle, w.first.value_or(0)});
    key.insert(key.end(), ratios.data(), ratios.data() + ratios.size());
  }
  return key;
}

}  // namespace

TipExponents TipTable::find(const Fan& asked, std::optional<std::size_t> joint) {
  Fan fan = asked;
  const std::vector<double> key = key_of(fan, joint);
  {
    const std::lock_guard lock(mutex_);
    if (const auto at = known_.find(key); at != known_.end()) return at->second;
  }
  const TipExponents found = joint ? exponents_of_states(fan, *joint) : exponents(fan);
  const std::lock_guard lock(mutex_);
  return known_.emplace(key, found).first->second;
}

}  // namespace mortise
