#include "preprint_solvers/band_order.hpp"

#include <algorithm>

namespace mortise {
namespace {

struct Graph {
  const SparseMatrix& matrix;  // both triangles

  const int* begin(int i) const { return matrix.innerIndexPtr() + matrix.outerIndexPtr()[i]; }
  const int* end(int i) const { return matrix.innerIndexPtr() + matrix.outerIndexPtr()[i + 1]; }
  int degree(int i) const { return int(end(i) - begin(i)); }
};

// Appends to `order` what can be reached from `root` through unknowns that are not `seen`: level by level, the
// neighbours of each by their degree.
void search(const Graph& graph, int root, std::vector<char>& seen, std::vector<int>& order) {
  std::vector<int> fresh;
  order.push_back(root);
  seen[root] = 1;
  for (std::size_t at = order.size() - 1; at < order.size(); ++at) {
    fresh.clear();
    for (const int* j = graph.begin(order[at]); j != graph.end(order[at]); ++j)
      if (!seen[*j]) {
        seen[*j] = 1;
        fresh.push_back(*j);
      }
    std::stable_sort(fresh.begin(), fresh.end(), [&](int a, int b) { return graph.degree(a) < graph.degree(b); });
    order.insert(order.end(), fresh.begin(), fresh.end());
  }
}

}  // namespace

std::vector<int> band_order(const SparseMatrix& lower) {
  const int n = int(lower.rows());
  const SparseMatrix both = lower.selfadjointView<Eigen::Lower>();
  const Graph graph{both};
  std::vector<char> seen(n, 0);
  std::vector<int> order;
  for (int i = 0; i < n; ++i) {
    if (seen[i]) continue;
    const auto first = std::ptrdiff_t(order.size());
    search(graph, i, seen, order);
    for (int again = 0; again < 2; ++again) {  // from the end of the last search
      const int root = order.back();
      for (auto k = order.begin() + first; k != order.end(); ++k) seen[*k] = 0;
      order.resize(first);
      search(graph, root, seen, order);
    }
  }
  std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace mortise
