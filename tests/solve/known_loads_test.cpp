#include "solve/known_loads.hpp"

#include <gtest/gtest.h>

#include <random>

namespace mortise {
namespace {

// K = tridiag(-1, 2.1, -1) with rows of B on a few unknowns, as SplitCholesky takes it.
SplitCholesky chain(int n, const std::vector<int>& rows) {
  Triplets entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 2.1);
    if (i > 0) entries.emplace_back(i - 1, i, -1);
  }
  for (std::size_t r = 0; r < rows.size(); ++r) {
    entries.emplace_back(rows[r], n + int(r), 1);
    entries.emplace_back(n + int(r), n + int(r), border_beta);
  }
  const int size = n + int(rows.size());
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  std::vector<int> blocks;
  for (int i = 0; i < n; ++i) blocks.push_back(i / 2);
  return SplitCholesky(std::move(matrix), blocks);
}

// Whatever was asked before: more loads than are remembered, sums of them, and such as hardly differ from a sum.
TEST(KnownLoads, AnswerAsIfAskedFirst) {
  const int n = 60;
  const SplitCholesky factor = chain(n, {3, 20, 41});
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return VecX(VecX::NullaryExpr(n, [&] { return normal(random); })); };
  KnownLoads loads;
  std::vector<VecX> asked;
  for (int k = 0; k < 80; ++k) {
    VecX load = k % 4 == 0 ? draw() : normal(random) * asked[random() % asked.size()];
    if (k % 4 >= 2) load += normal(random) * asked[random() % asked.size()];
    if (k % 4 == 3) load += std::pow(10, -3 * (k % 5)) * draw();
    asked.push_back(load);
    const VecX y = factor.forward(load);
    const double alone = largest_entry(factor.backward(y, VecX::Zero(3)));
    EXPECT_NEAR(loads.displacement(factor, 3, load, y), alone, 1e-12 * alone) << k;
  }
  EXPECT_EQ(loads.displacement(factor, 3, VecX::Zero(n), VecX::Zero(factor.size())), 0);
}

}  // namespace
}  // namespace mortise
