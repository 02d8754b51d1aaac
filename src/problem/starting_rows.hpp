// The rows closed at first, from an earlier run.
#pragma once

#include "problem/contact_pair.hpp"

namespace mortise {

/// The closed rows of a run, for a later one to start from.
struct ActiveSet {
  struct Row {
    Vec2 place;  ///< of its first multiplier
    char active;
  };
  std::vector<std::vector<Row>> pairs;  ///< rows of each, along its curve
};

/// Each row of all pairs as the nearest one of `start`; none, which means all closed, where `start` is of other pairs.
std::vector<char> starting_rows(const ActiveSet& start, const Mesh& mesh, const std::vector<ContactPair>& pairs);

}  // namespace mortise
