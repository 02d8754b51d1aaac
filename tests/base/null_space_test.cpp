// The null space of large sparse matrices, against what is known of it.
#include "base/null_space.hpp"

#include <gtest/gtest.h>

namespace mortise {
namespace {

// Chains of `length` unknowns with springs of 1 between neighbours; chain k hangs from a spring of held(k).
SparseMatrix chains(int length, const std::vector<double>& held) {
  Triplets entries;
  for (int k = 0; k < int(held.size()); ++k) {
    const int first = k * length;
    entries.emplace_back(first, first, held[k]);
    for (int i = first; i + 1 < first + length; ++i)
      for (const auto& [r, c, v] : {std::tuple{i, i, 1}, {i + 1, i + 1, 1}, {i, i + 1, -1}, {i + 1, i, -1}})
        entries.emplace_back(r, c, v);
  }
  const Eigen::Index n = length * Eigen::Index(held.size());
  SparseMatrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

// Of a chain that nothing holds: all unknowns move alike.
TEST(NullSpace, OfChainsIsTheMotionOfEachFreeOne) {
  for (const int length : {5, 100}) {  // by all eigenvectors, and by inverse iteration
    const std::vector<double> held{1, 0, 1e-3, 0, 0};
    const MatX V = null_space(chains(length, held), 1e-12);
    ASSERT_EQ(V.cols(), 3) << length;
    EXPECT_LE((V.transpose() * V - MatX::Identity(3, 3)).norm(), 1e-12);
    for (int k = 0; k < int(held.size()); ++k) {
      const MatX part = V.middleRows(k * length, length);
      for (int i = 1; i < length; ++i) EXPECT_LE((part.row(i) - part.row(0)).norm(), 1e-7) << k << " " << i;
      EXPECT_NEAR(part.row(0).norm(), held[k] == 0 ? 1 / std::sqrt(length) : 0, 1e-7) << k;
    }
  }
}

// The smallest eigenvalue of a chain that hangs from a weak spring k is k / length.
TEST(NullSpace, EndsAtTheLimit) {
  const int length = 200;
  for (const double spring : {1e-9, 1e-5}) {
    EXPECT_EQ(null_space(chains(length, {spring}), 0.5 * spring / length).cols(), 0);
    EXPECT_EQ(null_space(chains(length, {spring}), 2 * spring / length).cols(), 1);
  }
  EXPECT_EQ(null_space(chains(length, {1}), 1e-12).cols(), 0);
}

}  // namespace
}  // namespace mortise
