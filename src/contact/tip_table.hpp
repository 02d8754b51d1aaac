// Exponents at many places, computed once for those that are alike.
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "contact/williams.hpp"

namespace mortise {

/// Tips are alike whose angles are one to 1e-10. Any thread may ask.
class TipTable {
 public:
  /// With a joint whose pressure is asked for those of all its states (contact/joint_states.hpp).
  TipExponents find(const Fan& fan, std::optional<std::size_t> joint = {});

 private:
  std::map<std::vector<double>, TipExponents> known_;
  std::mutex mutex_;
};

}  // namespace mortise
