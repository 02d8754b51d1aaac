#include "solve/open_motions.hpp"

#include <gtest/gtest.h>

#include <random>

#include "base/dense.hpp"
#include "solve/dense_rows.hpp"

namespace mortise {
namespace {

// Among all that differ by free motions and keep the open rows open: nearest to none, so that the way to any other
// leads away from none.
TEST(OpenMotions, TheLeastKeepOpenRowsOpenAndNoOthersThatDoAreSmaller) {
  std::mt19937 random(5);
  std::normal_distribution<double> value;
  const auto draw = [&] { return value(random); };
  int touching = 0;
  for (int run = 0; run < 100; ++run) {
    SCOPED_TRACE(run);
    const Eigen::Index m = 3 + run % 9, s = 2 + run % 4, count = 1 + run % s;
    ComplementarityProblem p{.compliance = MatX::Zero(m + s, m + s), .scale = VecX::Ones(m), .unilateral = {}};
    const MatX H = MatX::NullaryExpr(m, s, draw), free = MatX::NullaryExpr(s, count, draw);
    p.compliance.bottomLeftCorner(s, m) = H.transpose();
    const VecX rhs = VecX::Zero(m + s), at = VecX::NullaryExpr(s, draw);
    std::vector<char> closed(std::size_t(m), 0);
    closed[0] = 1;
    const VecX other = at + free * VecX::NullaryExpr(count, draw);
    const VecX w = H * (other - at) + VecX::NullaryExpr(m, [&] { return std::max(draw(), 0.0); });
    const VecX least = least_motions(DenseRows(p, rhs), at, free, w, closed);
    const VecX moved = least - at, left = w - H * moved;
    EXPECT_GE(left.tail(m - 1).minCoeff(), -1e-10) << "open rows stay open";
    touching += left.tail(m - 1).minCoeff() < 1e-10;
    const MatX Q = orthonormal(free);
    EXPECT_LE((moved - Q * (Q.transpose() * moved)).norm(), 1e-10 * (1 + moved.norm())) << "by free motions alone";
    EXPECT_GE((Q.transpose() * least).dot(Q.transpose() * (other - least)), -1e-9);
  }
  EXPECT_GT(touching, 20) << "where rows are in the way";
}

}  // namespace
}  // namespace mortise
