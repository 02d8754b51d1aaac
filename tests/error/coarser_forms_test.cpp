// What p* is off by, as coarser meshes tell it, against pressures that are known.
#include "error/coarser_forms.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <random>

#include "fem/quadrature.hpp"

namespace mortise::test {
namespace {

using Pressure = std::function<double(double)>;

VecX vertices(int edges, std::mt19937& draw) {
  const double growth = std::uniform_real_distribution(0.9, 1.1)(draw);
  VecX s = VecX::Zero(edges + 1);
  for (int i = 1; i <= edges; ++i)
    s(i) = s(i - 1) + std::pow(growth, i) * std::uniform_real_distribution(0.8, 1.2)(draw);
  return s / s(edges);
}

// The piecewise linear function with the moments of p.
VecX projected(const VecX& s, const Pressure& p) {
  static const LineRule rule = gauss_legendre(20);
  const Eigen::Index count = s.size();
  MatX mass = MatX::Zero(count, count);
  VecX moments = VecX::Zero(count);
  for (Eigen::Index e = 0; e + 1 < count; ++e)
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const double h = s(e + 1) - s(e), t = (1 + rule.points[q]) / 2, weight = rule.weights[q] / 2 * h;
      const Eigen::Vector2d hats(1 - t, t);
      moments.segment<2>(e) += weight * p(s(e) + h * t) * hats;
      mass.block<2, 2>(e, e) += weight * hats * hats.transpose();
    }
  return mass.partialPivLu().solve(moments);
}

struct Fitted {
  PressureForm form;
  std::vector<double> squares;  // of what each form differs by from the next coarser one
};

double square_between(const VecX& s, const Pressure& one, const Pressure& other) {
  double sum = 0;
  for (Eigen::Index i = 0; i < s.size(); ++i) {
    const Eigen::Index before = std::max<Eigen::Index>(i - 1, 0), after = std::min(i + 1, s.size() - 1);
    sum += std::pow(one(s(i)) - other(s(i)), 2) * (s(after) - s(before)) / 2;
  }
  return sum;
}

Fitted fitted(const VecX& s, const VecX& p) {
  const LoadedPiece piece{.s = s, .p = p, .width = VecX::Ones(s.size()), .end = {}};
  Fitted found{*fit_pressure(piece, {s(0), s(s.size() - 1)}), {}};
  PressureForm last = found.form;
  for (const PressureForm& coarse : coarser_forms(piece)) {
    found.squares.push_back(square_between(s, last, coarse));
    last = coarse;
  }
  return found;
}

TEST(PartLeft, IsTheRestOfAGeometricSeries) {
  for (const double ratio : {0.1, 0.2, 0.4}) {
    const double r2 = ratio * ratio;
    EXPECT_NEAR(part_left({r2 * r2, r2, 1}), ratio / (1 - ratio), 1e-12);
  }
  EXPECT_NEAR(part_left({1e-8, 1e-4, 1}), 1. / 15, 1e-12);  // faster than cubics converge: by chance
  EXPECT_EQ(part_left({0.3, 0.5, 1}), 1);                   // slower than by halves
  EXPECT_EQ(part_left({1e-4, 1}), 1);                       // two say nothing of a series
  EXPECT_EQ(part_left({0, 0, 0}), 1);
}

// Of the worse of two ratios; what the last has too much stays.
TEST(PartLeft, IsThatOfTheWorseRatioAndOfWhatDoesNotFall) {
  EXPECT_NEAR(part_left({1e-4 * 0.09, 0.09, 1}), 0.3 / 0.7, 1e-12);
  EXPECT_NEAR(part_left({0.04 * 0.01, 0.01, 1}), std::hypot(0.2 / 0.8, std::sqrt(0.75)), 1e-12);
}

TEST(CoarserForms, AreThreeWhereThereAreVerticesForThem) {
  std::mt19937 draw(62);
  for (const auto& [edges, forms] : {std::pair{5, 0U}, {6, 1U}, {12, 2U}, {24, 3U}, {200, 3U}}) {
    const VecX s = vertices(edges, draw);
    const LoadedPiece piece{.s = s, .p = VecX::Ones(s.size()), .width = VecX::Ones(s.size()), .end = {}};
    EXPECT_EQ(coarser_forms(piece).size(), forms) << edges;
  }
}

// Smooth pressures and pressures with a kink, whose moments the multiplier has.
TEST(PartLeft, LeavesWhatTheFittedPressureIsOffBy) {
  std::mt19937 draw(63);
  const auto any = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(draw); };
  int within = 0, lowered = 0;
  constexpr int draws = 400;
  for (int k = 0; k < draws; ++k) {
    const VecX s = vertices(std::uniform_int_distribution(24, 80)(draw), draw);
    const double wave = any(2, 12), phase = any(0, 6), size = any(0.1, 0.5), kink = any(0, 1), turn = k % 2 * any(0, 1);
    const Pressure p = [&](double x) { return 1 + size * std::sin(wave * x + phase) + turn * std::abs(x - kink); };
    const Fitted found = fitted(s, projected(s, p));
    const double part = part_left(found.squares);
    lowered += part < 0.5;
    within += std::sqrt(square_between(s, found.form, p)) <= 1.5 * part * std::sqrt(found.squares[0]);
  }
  EXPECT_GE(within, 0.95 * draws);
  EXPECT_GT(lowered, draws / 4);
}

// On the finest mesh alone p_h has noise: coarser ones fall, and what is left is all of it.
TEST(PartLeft, LeavesNoiseOfTheFinestMesh) {
  std::mt19937 draw(64);
  int smooth_ones = 0;
  for (int k = 0; k < 100; ++k) {
    const VecX s = vertices(48, draw);
    const double wave = std::uniform_real_distribution(3., 12.)(draw);
    const Pressure p = [&](double x) { return 1 + 0.5 * std::sin(wave * x); };
    const VecX exact = projected(s, p);
    const Fitted smooth = fitted(s, exact);
    // Noise no larger than what the series would leave anyway is not told from it.
    if (!(smooth.squares[1] < 0.01 * smooth.squares[2])) continue;
    ++smooth_ones;
    const double noise = 0.3 * std::sqrt(smooth.squares[1]);
    const VecX noisy = exact + VecX::NullaryExpr(s.size(), [&] { return noise * std::normal_distribution()(draw); });
    EXPECT_GT(part_left(fitted(s, noisy).squares), 0.8) << k;
  }
  EXPECT_GT(smooth_ones, 20);
}

}  // namespace
}  // namespace mortise::test
