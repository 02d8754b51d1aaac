#include "solve/known_loads.hpp"

#include <gtest/gtest.h>

#include <random>

namespace mortise {
namespace {

// K = tridiag(-1, 2.1, -1) with rows of B on a few unknowns, as SplitCholesky takes it.
SplitCholesky chain(int n, const std::vector<int>& rows) {
  std::vector<Eigen::Triplet<double>> entries;
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
  SplitCholesky factor = chain(n, {3, 20, 41});
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
    const bool with_u = k % 3 > 0;
    const LoadResponse response = loads.respond(factor, load, with_u), alone = respond(factor, load, true);
    EXPECT_LE(largest_entry(response.at_border - alone.at_border), 1e-12 * largest_entry(alone.at_border)) << k;
    if (with_u) EXPECT_LE(largest_entry(response.u - alone.u), 1e-12 * largest_entry(alone.u)) << k;
    const VecX lambda = VecX::NullaryExpr(3, [&] { return normal(random); });
    const VecX with = alone.with(factor, lambda);
    EXPECT_LE(largest_entry(response.with(factor, lambda) - with), 1e-12 * largest_entry(with)) << k;
  }
  EXPECT_EQ(largest_entry(loads.respond(factor, VecX::Zero(n), true).u), 0);
}

}  // namespace
}  // namespace mortise
