// Orders of elimination: permutations that keep nodes together, and what they fill.
#include "solve/block_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace mortise {
namespace {

constexpr int always = 0, never = 1 << 30;  // nested dissection

// The pattern of two unknowns a node on `columns` x `columns` quadrilaterals of 8 nodes, or of 4.
struct Grid {
  SparseMatrix upper;
  std::vector<int> blocks;
};

Grid grid(int columns, bool quadratic) {
  const int side = 2 * columns + 1;
  std::vector<int> number(std::size_t(side) * side, -1);
  int nodes = 0;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      if (const int odd = x % 2 + y % 2; odd == 0 || (quadratic && odd == 1)) number[y * side + x] = nodes++;
  Triplets entries;
  for (int y = 0; y + 2 < side; y += 2)
    for (int x = 0; x + 2 < side; x += 2) {
      std::vector<int> of_element;
      for (int k = 0; k < 9; ++k)
        if (const int node = number[(y + k / 3) * side + x + k % 3]; node >= 0) of_element.push_back(node);
      for (const int a : of_element)
        for (const int b : of_element)
          for (const int i : {2 * a, 2 * a + 1})
            for (const int j : {2 * b, 2 * b + 1})
              if (i <= j) entries.emplace_back(i, j, 1.0);
    }
  Grid g{SparseMatrix(2 * nodes, 2 * nodes), {}};
  g.upper.setFromTriplets(entries.begin(), entries.end());
  for (int i = 0; i < 2 * nodes; ++i) g.blocks.push_back(i / 2);
  return g;
}

// Entries of the factor in this order, by elimination of the nodes' graph: columns below the diagonal are merged into
// the column of their first entry (George & Liu 1981, chapter 5).
std::size_t filled(const Grid& g, const std::vector<int>& order) {
  const int count = g.blocks.back() + 1;
  std::vector<int> place(count);
  for (int k = 0; k < int(order.size()); ++k) place[g.blocks[order[k]]] = k / 2;
  std::vector<std::vector<int>> below(count);
  for (int j = 0; j < g.upper.cols(); ++j)
    for (SparseMatrix::InnerIterator it(g.upper, j); it; ++it) {
      const int a = place[g.blocks[it.row()]], b = place[g.blocks[j]];
      if (a != b) below[std::min(a, b)].push_back(std::max(a, b));
    }
  std::size_t entries = 0;
  for (int k = 0; k < count; ++k) {
    std::ranges::sort(below[k]);
    below[k].erase(std::unique(below[k].begin(), below[k].end()), below[k].end());
    entries += below[k].size();
    if (below[k].empty()) continue;
    std::vector<int>& next = below[below[k].front()];
    next.insert(next.end(), below[k].begin() + 1, below[k].end());
  }
  return entries;
}

void expect_nodes_together(const Grid& g, const std::vector<int>& order) {
  ASSERT_EQ(order.size(), g.blocks.size());
  for (std::size_t k = 0; k < order.size(); k += 2) EXPECT_EQ(order[k] + 1, order[k + 1]);
  std::vector<int> sorted = order, all(order.size());
  std::ranges::sort(sorted);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(sorted, all);
}

TEST(BlockOrder, IsAPermutationThatKeepsNodesTogether) {
  for (const bool quadratic : {false, true})
    for (const int columns : {1, 2, 3, 20})
      for (const int dissect : {always, never}) {
        const Grid g = grid(columns, quadratic);
        expect_nodes_together(g, block_order(g.upper, g.blocks, dissect));
      }
}

TEST(BlockOrder, OfNothingIsNothing) {
  for (const int dissect : {always, never}) EXPECT_TRUE(block_order(SparseMatrix(0, 0), {}, dissect).empty());
}

TEST(BlockOrder, TakesNodesThatNothingCouples) {
  Grid g = grid(5, true);
  g.upper = SparseMatrix(g.upper.rows(), g.upper.cols());
  g.upper.setIdentity();
  for (const int dissect : {always, never}) expect_nodes_together(g, block_order(g.upper, g.blocks, dissect));
}

// With n^2 elements the factor has O(n^2 log n) entries by nested dissection (George 1973); by rows it has O(n^3).
TEST(BlockOrder, DissectionFillsLessThanMinimumDegree) {
  for (const bool quadratic : {false, true}) {
    const Grid g = grid(80, quadratic);
    const std::size_t dissected = filled(g, block_order(g.upper, g.blocks, always));
    EXPECT_LT(dissected, filled(g, block_order(g.upper, g.blocks, never))) << quadratic;
  }
}

TEST(BlockOrder, DissectionOfQuadraticElementsIsThatOfTheirCorners) {
  // Nodes in the middles of sides add their own rows and columns, and little else: 3 times the nodes, less than 3^2
  // times the entries.
  const Grid corners = grid(60, false), all = grid(60, true);
  const std::size_t of_corners = filled(corners, block_order(corners.upper, corners.blocks, always));
  const std::size_t of_all = filled(all, block_order(all.upper, all.blocks, always));
  EXPECT_LT(of_all, 6 * of_corners);
}

TEST(BlockOrder, IsTheSameEachTime) {
  const Grid g = grid(30, true);
  EXPECT_EQ(block_order(g.upper, g.blocks, always), block_order(g.upper, g.blocks, always));
}

}  // namespace
}  // namespace mortise
