// p from its moments with hat functions.
#include "error/pressure_form.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "fem/quadrature.hpp"

namespace mortise {
namespace {

using Along = std::function<double(double)>;

// Moments by many points on each edge, graded towards its ends.
LoadedPiece piece_of(
    const VecX& s, const Along& p, const Along& depth = [](double) { return 1.0; }) {
  const Eigen::Index count = s.size();
  LoadedPiece piece{.s = s,
                    .depth = s.unaryExpr(depth),
                    .moments = VecX::Zero(count),
                    .joined = std::vector<char>(count - 1),
                    .ends = {}};
  piece.ends[0].place = piece.ends[0].centre = s(0);
  piece.ends[1].place = piece.ends[1].centre = s(count - 1);
  const LineRule rule = gauss_legendre(40);
  for (Eigen::Index e = 0; e + 1 < count; ++e)
    for (int half : {0, 1})
      for (std::size_t i = 0; i < rule.points.size(); ++i) {
        const double x = (1 + rule.points[i]) / 2, h = s(e + 1) - s(e),
                     t = half == 0 ? x * x * x / 2 : 1 - x * x * x / 2;
        const double f = h * rule.weights[i] / 2 * 1.5 * x * x * p(s(e) + t * h) * depth(s(e) + t * h);
        piece.moments(e) += f * (1 - t);
        piece.moments(e + 1) += f * t;
      }
  return piece;
}

VecX uneven_vertices(int edges) {
  VecX s = VecX::LinSpaced(edges + 1, 0, 1);
  for (Eigen::Index i = 1; i < edges; ++i) s(i) += 0.3 / edges * std::sin(7.0 * i);
  return s;
}

double worst_difference(const PressureForm& form, const Along& p, double from, double to) {
  double off = 0;
  for (int i = 0; i <= 500; ++i) {
    const double s = from + (to - from) * i / 500;
    off = std::max(off, std::abs(form.at(s) - p(s)));
  }
  return off;
}

double moment_of_form(const PressureForm& form, VecX s, int lever) {
  for (double& x : s) x = std::max(x, form.ends[0].place);
  return piece_of(s, [&](double x) { return form.at(x) * (lever == 0 ? 1 : x); }).moments.sum();
}

double moment_of(const LoadedPiece& piece, int lever) {
  return lever == 0 ? piece.moments.sum() : piece.moments.dot(piece.s);
}

TEST(PressureForm, HasACubicExactly) {
  const Along p = [](double s) { return 2 - s + 3 * s * s * s; };
  EXPECT_LE(worst_difference(fit_form(piece_of(uneven_vertices(9), p)), p, 0, 1), 1e-12);
}

TEST(PressureForm, ComesNearerWithTheFourthPowerOfTheEdges) {
  const Along p = [](double s) { return 2 + std::sin(4 * s); };
  double before = 1;
  for (const int edges : {12, 24, 48}) {
    const double off = worst_difference(fit_form(piece_of(uneven_vertices(edges), p)), p, 0, 1);
    EXPECT_LT(off, before / 11);
    before = off;
  }
  EXPECT_LE(before, 2e-6);
}

TEST(PressureForm, FollowsAPowerUpToThePoint) {
  const Along p = [](double s) { return std::pow(s, -0.4) * std::cos(s); };
  LoadedPiece piece = piece_of(uneven_vertices(20), p);
  piece.ends[0].exponent = 0.6;
  EXPECT_LE(worst_difference(fit_form(piece), p, 1e-3, 1), 1e-4);
}

TEST(PressureForm, FollowsAPowerFromWithinTheNextEdge) {
  const Along p = [](double s) { return std::pow(s + 0.02, -0.4) * std::cos(s); };
  LoadedPiece piece = piece_of(uneven_vertices(20), p);
  piece.ends[0].exponent = 0.6;
  piece.ends[0].centre = -0.02;
  EXPECT_LE(worst_difference(fit_form(piece), p, 0, 1), 1e-5);
}

// Of rings: the moments are with r ds, and that of the axis hardly counts.
TEST(PressureForm, IsEvenAboutTheAxis) {
  const Along p = [](double s) { return std::cos(2 * s); };
  LoadedPiece piece = piece_of(uneven_vertices(20), p, [](double s) { return s; });
  piece.ends[0].mirrored = true;
  const PressureForm form = fit_form(piece);
  EXPECT_LE(worst_difference(form, p, 0, 1), 2e-5);
  EXPECT_NEAR(form.q(0), form.q(1), 1e-12);
}

// The place of the border in its edge.
class Border : public testing::TestWithParam<double> {};

TEST_P(Border, IsFoundWithinItsEdge) {
  const VecX s = VecX::LinSpaced(41, -0.2, 1);
  const double h = s(1) - s(0), end = s(3) + GetParam() * h;
  const Along p = [&](double x) { return x > end ? std::sqrt(x - end) * (1 + x) : 0; };
  // As of a solve: the first vertex of the piece is the one beyond the border.
  LoadedPiece piece = piece_of(s.tail(38), p);
  piece.ends[0].border = true;
  piece.ends[0].exponent = 1.5;
  place_borders(piece);
  EXPECT_NEAR(piece.ends[0].place, end, 2e-3 * h);
  const PressureForm form = fit_form(piece);
  EXPECT_LE(worst_difference(form, p, 0, 1), 0.01 * std::sqrt(h));
  EXPECT_EQ(form.at(end - h), 0);
  for (const int lever : {0, 1}) EXPECT_NEAR(moment_of_form(form, s, lever), moment_of(piece, lever), 1e-9);
}
INSTANTIATE_TEST_SUITE_P(Places, Border, testing::Values(0.05, 0.3, 0.5, 0.8));

}  // namespace
}  // namespace mortise
