// Products with duals that are kept: what is a sum of known ones is not solved for.
#include "error/body_products.hpp"

#include <gtest/gtest.h>

#include "app/solve_scene.hpp"
#include "base/errors.hpp"

namespace mortise::test {
namespace {

// Counts what it is asked for.
class CountingFactor : public ContactFactor {
 public:
  explicit CountingFactor(std::shared_ptr<const ContactFactor> of) : of_(std::move(of)) {}
  DualAnswers answers(const MatX& functionals, const MatX& loads) const override {
    count += functionals.cols();
    return of_->answers(functionals, loads);
  }
  mutable Eigen::Index count = 0;

 private:
  std::shared_ptr<const ContactFactor> of_;
};

TEST(BodyProducts, SolveOnceForWhatAddsUp) {
  const Results r = solve_scene(read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/parabola_1.toml",
                                           {{"mesh.parameters.n_upper", "8"}, {"mesh.parameters.n_lower", "10"}}));
  const auto factor = std::make_shared<CountingFactor>(r.solution.factor);
  const Eigen::Index rows = r.solution.lambda.size();
  const MatX w =
      MatX::NullaryExpr(rows, 3, [](Eigen::Index i, Eigen::Index k) { return std::sin(double(i * (k + 2))); });
  const MatX loads = VecX::Unit(r.solution.u.size(), r.solution.u.size() / 2);
  BodyProducts kept(true);
  // What a kept one says of functionals, the last of them with the load, and how many it has solved for.
  const auto solved_for = [&](const MatX& functionals, const MatX& of_loads) {
    const Eigen::Index before = factor->count;
    const auto compare = [&](Eigen::Index first, const DualSums& duals) {
      const MatX z = r.solution.factor->duals(functionals, of_loads);
      EXPECT_EQ(first, 0);
      EXPECT_LE((duals.fields() - z).norm(), 1e-9 * z.norm());
      EXPECT_LE((duals.field(z.cols() - 1) - z.rightCols(1)).norm(), 1e-9 * z.norm());
    };
    const ErrorProducts found = kept.with_duals(r.problem, r.solution.u, factor, {functionals, of_loads}, compare);
    const ErrorProducts alone =
        BodyProducts().with_duals(r.problem, r.solution.u, r.solution.factor, {functionals, of_loads});
    EXPECT_LE((found.products - alone.products).norm(), 1e-9 * alone.products.norm());
    return factor->count - before;
  };
  const MatX none(r.solution.u.size(), 0);
  EXPECT_EQ(solved_for(w, none), 3);
  EXPECT_EQ(solved_for(w, none), 0);
  MatX sums = w;
  sums.col(1) += 2 * w.col(0) - 3 * w.col(2);
  EXPECT_EQ(solved_for(sums, none), 0);
  sums(0, 2) += 1e-6;  // what a sum of the others is not
  EXPECT_EQ(solved_for(sums, none), 1);
  EXPECT_EQ(solved_for(w, loads), 1);
  EXPECT_EQ(solved_for(w, loads), 0);
  // More than twice those asked at once are forgotten, loads are not.
  EXPECT_EQ(solved_for(w.leftCols(1), none), 1);
  EXPECT_EQ(solved_for(w, loads), 1);
}

}  // namespace
}  // namespace mortise::test
