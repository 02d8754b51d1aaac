// The numbers that a file gives nodes or elements: any > 0, each once.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh_files/msh_input.hpp"

namespace mortise {

/// The tags while they are read, and where each stands. Both functions throw InputError with the place.
class Tags {
 public:
  /// "node" or "element".
  explicit Tags(std::string what) : what_(std::move(what)) {}
  void reserve(std::int64_t count);
  /// Of the input's record.
  void add(const MshInput& input, std::int64_t tag) { add_at(input, input.record(), tag); }
  void add_at(const MshInput& input, std::size_t place, std::int64_t tag);
  void require_once(const MshInput& input) const;

  const std::vector<std::int64_t>& all() const { return tags_; }

 private:
  std::string what_;
  std::vector<std::int64_t> tags_;
  std::vector<std::size_t> places_;  // of each, for MshInput::fail_at
};

}  // namespace mortise
