#include "model/patterns.hpp"

#include <vector>

namespace mortise {

// After the last star that was met, the shortest piece of the name that lets the rest match.
bool matches(const std::string& pattern, const std::string& name) {
  std::size_t p = 0, n = 0, star = std::string::npos, resume = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = n;
    } else if (p < pattern.size() && pattern[p] == name[n]) {
      ++p;
      ++n;
    } else if (star != std::string::npos) {
      p = star + 1;
      n = ++resume;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string::npos;
}

// share[i][j]: whether what is left of both from letters i and j on can be one text. A star is nothing, or one letter
// of the other (or its star) and the same star again.
bool share_a_name(const std::string& first, const std::string& second) {
  const std::size_t n = first.size(), m = second.size();
  std::vector<std::vector<char>> share(n + 2, std::vector<char>(m + 2, 0));
  for (std::size_t i = n + 1; i-- > 0;)
    for (std::size_t j = m + 1; j-- > 0;) {
      const bool ends = i == n && j == m, star = i < n && first[i] == '*', other_star = j < m && second[j] == '*';
      const bool equal = i < n && j < m && first[i] == second[j];
      share[i][j] = ends || (equal && share[i + 1][j + 1]) ||
                    (star && (share[i + 1][j] || (j < m && share[i][j + 1]))) ||
                    (other_star && (share[i][j + 1] || (i < n && share[i + 1][j])));
    }
  return share[0][0];
}

}  // namespace mortise
