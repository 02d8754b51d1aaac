#include "ddm/soft_rows.hpp"

#include <gtest/gtest.h>

#include <random>

namespace mortise::test {
namespace {

// Bodies in a row, each with `each` rows to the next: compliances of both sides of a row, and two motions a body.
struct Row {
  SparseMatrix matrix;  // lower triangle
  Eigen::Index rows;
};

Row chain(int bodies, int each, std::mt19937& random) {
  std::normal_distribution<double> draw;
  const int rows = each * (bodies + 1);
  Triplets entries;
  for (int b = 0; b < bodies; ++b) {
    const int count = 2 * each, first = b * each;
    const MatX half = MatX::NullaryExpr(count, count, [&] { return draw(random); });
    const MatX C = half * half.transpose();
    for (int j = 0; j < count; ++j) {
      for (int i = j; i < count; ++i) entries.emplace_back(first + i, first + j, C(i, j));
      for (int k = 0; k < 2; ++k) entries.emplace_back(rows + 2 * b + k, first + j, draw(random));
    }
  }
  Row made{SparseMatrix(rows + 2 * bodies, rows + 2 * bodies), rows};
  made.matrix.setFromTriplets(entries.begin(), entries.end());
  return made;
}

TEST(SoftRows, SolveToRoundOffHoweverFarTheComplianceOfRowsIsApart) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> power(-12, 8);
  for (const int bodies : {1, 4, 20}) {
    const Row made = chain(bodies, 5, random);
    const VecX compliance =
        VecX::NullaryExpr(made.rows, [&](Eigen::Index a) { return a % 3 == 0 ? 1e-12 : std::pow(10, power(random)); });
    SoftRows soft(made.matrix, made.rows);
    ASSERT_TRUE(soft.factorise(VecX::Ones(made.rows)));  // the next starts from C again
    ASSERT_TRUE(soft.factorise(compliance));
    const VecX gap = VecX::NullaryExpr(made.rows, [&] { return power(random); }),
               work = VecX::NullaryExpr(2 * bodies, [&] { return power(random); });
    const ContactRows::Forces found = soft.solve(gap, work);
    SparseMatrix matrix = made.matrix;
    for (Eigen::Index a = 0; a < made.rows; ++a) matrix.coeffRef(a, a) += compliance(a);
    const VecX left = stacked(gap, work) - matrix.selfadjointView<Eigen::Lower>() * stacked(found.lambda, found.mu);
    const double terms = largest_entry(stacked(gap, work)) + largest_entry(found.lambda) + largest_entry(found.mu);
    EXPECT_LT(largest_entry(left), 1e-11 * terms) << bodies << " bodies";
  }
}

}  // namespace
}  // namespace mortise::test
