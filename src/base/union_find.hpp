// Numbers that hang together, by union and find.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace mortise {

class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// The smallest of those that hang together with i.
  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void join(int a, int b) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    parent_[high] = low;
  }

  /// Those that hang together, ascending, and the sets by their smallest.
  std::vector<std::vector<int>> sets() {
    std::vector<std::vector<int>> sets;
    std::vector<int> number(parent_.size(), -1);
    for (int i = 0; i < int(parent_.size()); ++i) {
      int& set = number[find(i)];
      if (set < 0) {
        set = int(sets.size());
        sets.emplace_back();
      }
      sets[set].push_back(i);
    }
    return sets;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace mortise
