#include "solve/block_order.hpp"

#include <amd.h>
#include <metis.h>

#include <algorithm>
#include <mutex>
#include <stdexcept>

namespace mortise {
namespace {

static_assert(sizeof(idx_t) == sizeof(int));

// Who is coupled to whom: the neighbours of i are row[start[i]] ... row[start[i + 1] - 1], rising.
struct Graph {
  std::vector<int> start{0}, row;

  int size() const { return int(start.size()) - 1; }
  int degree(int i) const { return start[i + 1] - start[i]; }
  const int* begin(int i) const { return row.data() + start[i]; }
  const int* end(int i) const { return row.data() + start[i + 1]; }
};

// Of each block the ones before it.
Graph blocks_before(const SparseMatrix& upper, const std::vector<int>& blocks, const std::vector<int>& first_of) {
  Graph graph;
  graph.row.reserve(1);  // AMD wants an address also where nothing is coupled
  for (int b = 0; b + 1 < int(first_of.size()); ++b) {
    for (SparseMatrix::InnerIterator it(upper, first_of[b]); it; ++it) {
      const int r = blocks[it.row()];
      if (r < b && (int(graph.row.size()) == graph.start.back() || graph.row.back() != r)) graph.row.push_back(r);
    }
    graph.start.push_back(int(graph.row.size()));
  }
  return graph;
}

// The part of a graph between kept nodes, in both directions; `number` of a kept one is its place among them, else -1.
Graph both_ways(const Graph& before, const std::vector<int>& number) {
  Graph both;
  const auto for_each_edge = [&](auto visit) {
    for (int b = 0; b < before.size(); ++b)
      for (const int* r = before.begin(b); number[b] >= 0 && r != before.end(b); ++r)
        if (number[*r] >= 0) visit(number[b], number[*r]);
  };
  both.start.assign(*std::ranges::max_element(number) + 2, 0);
  for_each_edge([&](int b, int r) {
    ++both.start[b + 1];
    ++both.start[r + 1];
  });
  for (int i = 0; i < both.size(); ++i) both.start[i + 1] += both.start[i];
  both.row.resize(std::max(1, both.start.back()));  // METIS wants an address as AMD does
  std::vector<int> next(both.start.begin(), both.start.end() - 1);
  for_each_edge([&](int b, int r) {
    both.row[next[b]++] = r;
    both.row[next[r]++] = b;
  });
  return both;
}

// Whether all neighbours of b are a or neighbours of a.
bool covers(const Graph& graph, int a, int b) {
  const int* at = graph.begin(a);
  for (const int* j = graph.begin(b); j != graph.end(b); ++j) {
    if (*j == a) continue;
    while (at != graph.end(a) && *at < *j) ++at;
    if (at == graph.end(a) || *at != *j) return false;
  }
  return true;
}

// Calls visit(a) for each neighbour that covers b and is above it: has more neighbours, or as many and comes first.
template <typename Visit>
void for_each_cover(const Graph& graph, int b, Visit visit) {
  for (const int* a = graph.begin(b); a != graph.end(b); ++a) {
    const int more = graph.degree(*a) - graph.degree(b);
    if ((more > 0 || (more == 0 && *a < b)) && covers(graph, *a, b)) visit(*a);
  }
}

std::vector<int> minimum_degree(const Graph& before) {
  std::vector<int> order(before.size());
  if (amd_order(before.size(), before.start.data(), before.row.data(), order.data(), nullptr, nullptr) < AMD_OK)
    throw std::runtime_error("AMD ordering failed");
  return order;
}

// The place of each node in METIS's order.
std::vector<int> dissected(Graph graph) {
  static std::mutex one;  // it draws from the process's random numbers, from a seed of its own
  const std::lock_guard lock(one);
  idx_t options[METIS_NOPTIONS], size = graph.size();
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_COMPRESS] = 0;
  std::vector<int> order(graph.size()), place(graph.size());
  if (METIS_NodeND(&size, graph.start.data(), graph.row.data(), nullptr, options, order.data(), place.data()) !=
      METIS_OK)
    throw std::runtime_error("METIS ordering failed");
  return place;
}

// A node in the middle of a side is coupled to nothing that each end of the side is not coupled to. So the graph of the
// nodes that nothing covers has all there is to dissect, a third of the nodes of quadratic elements; a covered node is
// eliminated just before the first of those that cover it.
std::vector<int> nested_dissection(const Graph& before) {
  const int count = before.size();
  std::vector<int> number(count);
  for (int b = 0; b < count; ++b) number[b] = b;
  const Graph all = both_ways(before, number);
  std::vector<int> cover_start{0}, covers_of;
  for (int b = 0, kept = 0; b < count; ++b) {
    for_each_cover(all, b, [&](int a) { covers_of.push_back(a); });
    number[b] = int(covers_of.size()) == cover_start.back() ? kept++ : -1;
    cover_start.push_back(int(covers_of.size()));
  }
  const std::vector<int> place = dissected(both_ways(before, number));
  // Sorted by place: first those that go with a kept node, then itself.
  std::vector<int> key(count);
  for (int b = 0; b < count; ++b) {
    key[b] = number[b] >= 0 ? 2 * place[number[b]] + 1 : 2 * count;
    for (int k = cover_start[b]; k < cover_start[b + 1]; ++k)
      if (const int a = covers_of[k]; number[a] >= 0) key[b] = std::min(key[b], 2 * place[number[a]]);
  }
  std::vector<int> order(count);
  for (int b = 0; b < count; ++b) order[b] = b;
  std::ranges::stable_sort(order, {}, [&](int b) { return key[b]; });
  return order;
}

}  // namespace

std::vector<int> block_order(const SparseMatrix& upper, const std::vector<int>& blocks, int dissect) {
  if (blocks.empty()) return {};
  const int n = int(blocks.size());
  std::vector<int> first_of(blocks.back() + 2, n);
  for (int i = n - 1; i >= 0; --i) first_of[blocks[i]] = i;
  const Graph before = blocks_before(upper, blocks, first_of);
  std::vector<int> order;
  order.reserve(n);
  for (const int b : n < dissect ? minimum_degree(before) : nested_dissection(before))
    for (int i = first_of[b]; i < first_of[b + 1]; ++i) order.push_back(i);
  return order;
}

}  // namespace mortise
