#include "solve/block_order.hpp"

#include <amd.h>
#include <metis.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <numeric>
#include <stdexcept>

namespace mortise {
namespace {

static_assert(sizeof(idx_t) == sizeof(int));

// Who is coupled to whom: the neighbours of i are row[start[i]] ... row[start[i + 1] - 1], rising.
struct BlockGraph {
  std::vector<int> start{0}, row;

  int size() const { return int(start.size()) - 1; }
  int degree(int i) const { return start[i + 1] - start[i]; }
  const int* begin(int i) const { return row.data() + start[i]; }
  const int* end(int i) const { return row.data() + start[i + 1]; }
};

// Unknowns by the nodes that they belong to: those of node b are unknowns[first[b]] ... unknowns[first[b + 1] - 1].
struct Nodes {
  const std::vector<int>& unknowns;  // ascending
  std::vector<int> first, number;    // of each node; of each block the node, -1: none of these unknowns has it

  Nodes(const std::vector<int>& of, const std::vector<int>& blocks) : unknowns(of), number(blocks.back() + 1, -1) {
    for (int i = 0; i < int(unknowns.size()); ++i)
      if (int& node = number[blocks[unknowns[i]]]; node < 0) {
        node = int(first.size());
        first.push_back(i);
      }
    first.push_back(int(unknowns.size()));
  }
  int size() const { return int(first.size()) - 1; }
};

// Of each node the ones before it.
BlockGraph nodes_before(const SparseMatrix& upper, const std::vector<int>& blocks, const Nodes& nodes) {
  BlockGraph graph;
  graph.row.reserve(1);  // AMD wants an address also where nothing is coupled
  for (int b = 0; b < nodes.size(); ++b) {
    for (SparseMatrix::InnerIterator it(upper, nodes.unknowns[nodes.first[b]]); it; ++it) {
      const int r = nodes.number[blocks[it.row()]];
      if (r >= 0 && r < b && (int(graph.row.size()) == graph.start.back() || graph.row.back() != r))
        graph.row.push_back(r);
    }
    graph.start.push_back(int(graph.row.size()));
  }
  return graph;
}

// The part of a graph between kept nodes, in both directions; `number` of a kept one is its place among them, else -1.
BlockGraph both_ways(const BlockGraph& before, const std::vector<int>& number) {
  BlockGraph both;
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
bool covers(const BlockGraph& graph, int a, int b) {
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
void for_each_cover(const BlockGraph& graph, int b, Visit visit) {
  for (const int* a = graph.begin(b); a != graph.end(b); ++a) {
    const int more = graph.degree(*a) - graph.degree(b);
    if ((more > 0 || (more == 0 && *a < b)) && covers(graph, *a, b)) visit(*a);
  }
}

struct Order {
  std::vector<int> nodes;     // in the order of elimination
  int first = 0, second = 0;  // as of Dissection
};

// The place of each node in METIS's order, and how many come before its first separator on either side.
struct Places {
  std::vector<int> of;
  std::array<idx_t, 3> sizes;
};

Places dissected(BlockGraph graph) {
  static std::mutex one;  // it draws from the process's random numbers, from a seed of its own
  const std::lock_guard lock(one);
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_COMPRESS] = 0;
  Places places{std::vector<int>(graph.size()), {}};
  std::vector<int> order(graph.size());
  // The order of METIS_NodeND, which does not say where its first separator begins.
  if (METIS_NodeNDP(graph.size(), graph.start.data(), graph.row.data(), nullptr, 2, options, order.data(),
                    places.of.data(), places.sizes.data()) != METIS_OK)
    throw std::runtime_error("METIS ordering failed");
  return places;
}

// A node in the middle of a side is coupled to nothing that each end of the side is not coupled to. So the graph of the
// nodes that nothing covers has all there is to dissect, a third of the nodes of quadratic elements; a covered node is
// eliminated just before the first of those that cover it. It is on that one's side of the separator: all its
// neighbours are neighbours of that one.
Order nested_dissection(const BlockGraph& before) {
  const int count = before.size();
  std::vector<int> number(count);
  for (int b = 0; b < count; ++b) number[b] = b;
  const BlockGraph all = both_ways(before, number);
  std::vector<int> cover_start{0}, covers_of;
  for (int b = 0, kept = 0; b < count; ++b) {
    for_each_cover(all, b, [&](int a) { covers_of.push_back(a); });
    number[b] = int(covers_of.size()) == cover_start.back() ? kept++ : -1;
    cover_start.push_back(int(covers_of.size()));
  }
  const Places places = dissected(both_ways(before, number));
  // Sorted by place: first those that go with a kept node, then itself.
  std::vector<int> key(count);
  for (int b = 0; b < count; ++b) {
    key[b] = number[b] >= 0 ? 2 * places.of[number[b]] + 1 : 2 * count;
    for (int k = cover_start[b]; k < cover_start[b + 1]; ++k)
      if (const int a = covers_of[k]; number[a] >= 0) key[b] = std::min(key[b], 2 * places.of[number[a]]);
  }
  Order order{std::vector<int>(count)};
  for (int b = 0; b < count; ++b) order.nodes[b] = b;
  std::ranges::stable_sort(order.nodes, {}, [&](int b) { return key[b]; });
  const int left = 2 * places.sizes[0], both = left + 2 * places.sizes[1];
  order.first = int(std::ranges::count_if(key, [&](int k) { return k < left; }));
  order.second = int(std::ranges::count_if(key, [&](int k) { return k < both; })) - order.first;
  return order;
}

Order minimum_degree(const BlockGraph& before) {
  Order order{std::vector<int>(before.size()), before.size()};
  if (amd_order(before.size(), before.start.data(), before.row.data(), order.nodes.data(), nullptr, nullptr) < AMD_OK)
    throw std::runtime_error("AMD ordering failed");
  return order;
}

}  // namespace

Dissection dissection(const SparseMatrix& upper, const std::vector<int>& blocks, const std::vector<int>& unknowns,
                      int dissect) {
  if (unknowns.empty()) return {};
  const Nodes nodes(unknowns, blocks);
  const BlockGraph before = nodes_before(upper, blocks, nodes);
  const Order order = int(unknowns.size()) < dissect ? minimum_degree(before) : nested_dissection(before);
  Dissection result;
  result.order.reserve(unknowns.size());
  for (int k = 0; k < nodes.size(); ++k) {
    const int b = order.nodes[k];
    result.order.insert(result.order.end(), &unknowns[nodes.first[b]], &unknowns[0] + nodes.first[b + 1]);
    if (k + 1 == order.first) result.first = int(result.order.size());
    if (k + 1 == order.first + order.second) result.second = int(result.order.size()) - result.first;
  }
  return result;
}

std::vector<int> block_order(const SparseMatrix& upper, const std::vector<int>& blocks, int dissect) {
  std::vector<int> all(blocks.size());
  std::iota(all.begin(), all.end(), 0);
  return dissection(upper, blocks, all, dissect).order;
}

}  // namespace mortise
