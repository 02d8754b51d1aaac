#include "fem/line_cuts.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace mortise::test {
namespace {

// An edge from x = 0 to 1 and an expression upon it.
class OnEdge {
 public:
  explicit OnEdge(const std::string& text, bool blind = false)
      : field_(blind ? Field("f", {.key = "load", .functions = {of(text)}}) : Field(text, {.key = "load"})),
        range_(field_) {}

  std::vector<double> cuts() const { return resolving_cuts(function()); }
  double integral() const {
    const LineRule rule = cut_rule(cuts(), 4);
    double sum = 0;
    for (std::size_t q = 0; q < rule.points.size(); ++q) sum += rule.weights[q] / 2 * function().at(rule.points[q]);
    return sum;
  }
  LineMisfit what_is_left() const { return misfit(function(), cuts()); }
  OnEdge&& moved_to(const Points& nodes) && {
    nodes_ = nodes;
    if (nodes.rows() == 3) edge_ = {3, {0, 1, 2}};
    return std::move(*this);
  }
  int looked_at() const {  // places, for the cuts
    int count = 0;
    LineFunction f = function();
    f.at = [at = f.at, &count](double xi) { return ++count, at(xi); };
    resolving_cuts(f);
    return count;
  }

 private:
  // As a function of a file: no range is known of it.
  static std::shared_ptr<NamedFunction> of(const std::string& text) {
    return std::make_shared<NamedFunction>(
        NamedFunction{"f", [field = Field(text, {.key = "load"})](const Vec2& x) { return field(x); }});
  }
  LineFunction function() const {
    LineScale scale;
    scale.look_at(along_edge(nodes_, edge_, field_, range_, {}));
    LineFunction f = along_edge(nodes_, edge_, field_, range_, {});
    f.scale = scale.value();
    return f;
  }

  Points nodes_{{0.0, 0.0}, {1.0, 0.0}};
  Edge edge_{2, {0, 1, -1}};
  Field field_;
  FieldRange range_;
};

TEST(LineCuts, AreNoneOfWhatFourPointsIntegrate) {
  for (const char* text : {"1 + x - 3 * x^2", "x * (1 - x)", "exp(x / 10) + sin(x / 10)"})
    EXPECT_EQ(OnEdge(text).cuts(), (std::vector<double>{-1, 1})) << text;
}

// What is constant but for round-off needs no looking, as a formula or along its edge.
TEST(LineCuts, AreNoneOfConstants) {
  const Points level{{-3.7, 30.1}, {5.3, 30.1}},
      circle{{33, 0}, {33 * std::cos(0.1), 33 * std::sin(0.1)}, {33 * std::cos(0.05), 33 * std::sin(0.05)}};
  for (const char* text : {"1.3", "1.3 + 0 * cos(2 * theta)", "1 + 1e-14 * x", "x > 99 ? 1 : 1", "9.81e3 * (30.1 - y)",
                           "2.5 * y", "1e6 * (30.1 - y) + 3", "cos(y)^2"}) {
    const OnEdge on = OnEdge(text).moved_to(level);
    EXPECT_EQ(on.cuts(), (std::vector<double>{-1, 1})) << text;
    EXPECT_LE(on.looked_at(), 100) << text;
  }
  for (const char* text : {"r", "sqrt(x^2 + y^2) + 3", "1 + r^2"}) {
    const OnEdge on = OnEdge(text).moved_to(circle);
    EXPECT_EQ(on.cuts(), (std::vector<double>{-1, 1})) << text;
    EXPECT_LE(on.looked_at(), 10000) << text;  // of 33000
  }
}

TEST(LineCuts, MakeIntegralsOfSpikesWavesAndJumpsExact) {
  const double root = std::sqrt(std::numbers::pi);
  for (const double w : {1e-2, 1e-4, 1e-7}) {
    const std::string width = std::to_string(1e7 * w) + "e-7";
    EXPECT_NEAR(OnEdge("exp(-((x - 0.4137) / " + width + ")^2)").integral(), w * root, 1e-8 * w + 1e-10) << w;
    EXPECT_NEAR(OnEdge("abs(x - 0.4137) < " + width + " ? 1 : 0").integral(), 2 * w, 1e-9) << w;
  }
  EXPECT_NEAR(OnEdge("x < 0.437 ? 10 : 1").integral(), 10 * 0.437 + 0.563, 1e-8);
  EXPECT_NEAR(OnEdge("sin(300 * x)").integral(), (1 - std::cos(300.0)) / 300, 1e-9);
  EXPECT_NEAR(OnEdge("1 / sqrt(x)").integral(), 2, 1e-4);
}

TEST(LineCuts, FindWhatAFileHasInSixtyFourPoints) {
  EXPECT_NEAR(OnEdge("exp(-((x - 0.4137) / 0.02)^2)", true).integral(), 0.02 * std::sqrt(std::numbers::pi), 1e-9);
  EXPECT_NEAR(OnEdge("x < 0.437 ? 10 : 1", true).integral(), 10 * 0.437 + 0.563, 1e-8);
  EXPECT_EQ(OnEdge("x^2", true).cuts().size(), 2u);
}

TEST(LineMisfit, IsWhatAParabolaLeavesOfAFunction) {
  // A step at the middle less its projection 1/2 + 3/4 xi: the mean of |difference| is 2 int_0^1 |1/2 - 3/4 t| dt / 2.
  const LineMisfit step = OnEdge("x < 0.5 ? 0 : 1").what_is_left();
  EXPECT_NEAR(step.mean, 5. / 24, 0.01);  // by four points on either side
  EXPECT_NEAR(step.mean_of_f, 0.5, 1e-9);
  const LineMisfit with_parabola = OnEdge("(x < 0.5 ? 0 : 1) + 1 + 3 * x - 5 * (2 * x - 1)^2").what_is_left();
  EXPECT_NEAR(with_parabola.mean, step.mean, 0.01);  // on other cuts
  const LineMisfit spike = OnEdge("exp(-((x - 0.4137) / 1e-3)^2)").what_is_left();
  EXPECT_NEAR(spike.at, 2 * 0.4137 - 1, 1e-3);
  EXPECT_LT(spike.finest, 4e-3);
  EXPECT_EQ(OnEdge("x^2").what_is_left().mean, 0);
}

}  // namespace
}  // namespace mortise::test
