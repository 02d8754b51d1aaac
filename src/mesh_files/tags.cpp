#include "mesh_files/tags.hpp"

#include <algorithm>
#include <numeric>

namespace mortise {
namespace {

/// Index of an entry that came before, or -1 if all differ.
std::int64_t first_repeated(const std::vector<std::int64_t>& tags) {
  if (std::adjacent_find(tags.begin(), tags.end(), std::greater_equal<>()) == tags.end()) return -1;
  std::vector<std::int64_t> order(tags.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return tags[a] < tags[b]; });
  const auto same = [&](auto a, auto b) { return tags[a] == tags[b]; };
  const auto found = std::adjacent_find(order.begin(), order.end(), same);
  return found == order.end() ? -1 : *(found + 1);
}

}  // namespace

void Tags::reserve(std::int64_t count) {
  tags_.reserve(count);
  places_.reserve(count);
}

void Tags::add_at(const MshInput& input, std::size_t place, std::int64_t tag) {
  if (tag <= 0) input.fail_at(place, "the " + what_ + "'s tag is " + std::to_string(tag) + "; expected a number > 0");
  tags_.push_back(tag);
  places_.push_back(place);
}

void Tags::require_once(const MshInput& input) const {
  if (const std::int64_t repeated = first_repeated(tags_); repeated >= 0)
    input.fail_at(places_[repeated], "the " + what_ + " " + std::to_string(tags_[repeated]) + " is listed twice");
}

}  // namespace mortise
