// Lists as sets.
#pragma once

#include <algorithm>
#include <vector>

namespace mortise {

/// Sorts the list; what it has twice or more it keeps once.
template <typename T>
void keep_each_once(std::vector<T>& list) {
  std::ranges::sort(list);
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace mortise
