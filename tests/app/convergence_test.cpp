// Rates of convergence against an exact field: docs/theory.md says which to expect.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "support/manufactured.hpp"

namespace mortise::test {
namespace {

struct Line {
  const char* name;
  std::function<double(double)> height;
  int coarsest;  // elements of the upper plate
};

const Line lines[] = {
    {"parabola_1", [](double x) { return -1.25 * x * x + x + 0.2; }, 12},
    {"circle", [](double x) { return 0.1 * (std::sqrt(9 + 80 * x - 100 * x * x) - 1); }, 12},
    {"cosine", [](double x) { return 0.1 * std::cos(std::numbers::pi * (x + 0.4) / 0.2) + 0.3; }, 32},
};

// Solves on four meshes n : 5/4 n, halving each time, and prints and returns the errors.
std::array<Errors, 4> study(const Line& line, CellKind kind, Multipliers multipliers, bool on_lower) {
  std::array<Errors, 4> errors{};
  for (int level = 0; level < 4; ++level) {
    ManufacturedCase c;
    c.plates.height = line.height;
    c.plates.n_upper = line.coarsest << level;
    c.plates.n_lower = c.plates.n_upper * 5 / 4;
    c.plates.kind_upper = c.plates.kind_lower = kind;
    c.multipliers = multipliers;
    c.multipliers_on_lower = on_lower;
    errors[level] = manufactured_errors(c);
    const Errors& e = errors[level];
    std::printf("%-11s n %4d  u %.3e  energy %.3e  p %.3e\n", line.name, c.plates.n_upper, e.displacement, e.energy,
                e.pressure);
  }
  return errors;
}

double rate(double coarse, double fine) { return std::log2(coarse / fine); }

// Largest errors allowed on the finest mesh of each line (frozen: 1.2 times the worst of all multiplier spaces and
// sides when the rates were first measured).
const std::map<CellKind, std::array<Errors, 3>> bounds{
    {CellKind::quad8, {{{1.8e-7, 1.1e-4, 2.4e-4}, {2.0e-7, 1.3e-4, 4.8e-4}, {4.3e-8, 9.0e-5, 1.1e-3}}}},
    {CellKind::tri6, {{{4.1e-7, 3.2e-4, 6.8e-4}, {4.3e-7, 3.4e-4, 8.0e-4}, {7.3e-8, 1.9e-4, 1.2e-3}}}},
    {CellKind::quad4, {{{1.3e-4, 2.9e-2, 6.0e-3}, {1.5e-4, 2.9e-2, 5.3e-3}, {1.3e-4, 1.5e-2, 1.6e-2}}}},
    {CellKind::tri3, {{{3.4e-4, 4.6e-2, 1.3e-2}, {3.8e-4, 4.6e-2, 1.7e-2}, {2.8e-4, 3.2e-2, 1.6e-2}}}}};

class Convergence : public testing::TestWithParam<std::tuple<CellKind, Multipliers, bool>> {};

TEST_P(Convergence, RatesAndErrorsOnAllLines) {
  const auto [kind, multipliers, on_lower] = GetParam();
  const int degree = is_quadratic(kind) ? 2 : 1;
  // The cosine's finest mesh takes as long as all others: on one side.
  for (std::size_t l = 0; l < (degree == 1 || on_lower ? 3 : 2); ++l) {
    SCOPED_TRACE(lines[l].name);
    const auto e = study(lines[l], kind, multipliers, on_lower);
    EXPECT_NEAR(rate(e[2].displacement, e[3].displacement), degree + 1, 0.15);
    EXPECT_NEAR(rate(e[2].energy, e[3].energy), degree, 0.15);
    EXPECT_GE(rate(e[2].pressure, e[3].pressure), degree == 2 ? 1.9 : 1);
    const Errors& bound = bounds.at(kind)[l];
    EXPECT_LE(e[3].displacement, bound.displacement);
    EXPECT_LE(e[3].energy, bound.energy);
    EXPECT_LE(e[3].pressure, bound.pressure);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Quadratic, Convergence,
    testing::Combine(testing::Values(CellKind::quad8, CellKind::tri6),
                     testing::Values(Multipliers::quadratic, Multipliers::linear, Multipliers::dual), testing::Bool()));
INSTANTIATE_TEST_SUITE_P(Linear, Convergence,
                         testing::Combine(testing::Values(CellKind::quad4, CellKind::tri3),
                                          testing::Values(Multipliers::linear, Multipliers::dual), testing::Bool()));

// ---- Bodies that slide on a line of varying curvature: two fields, equal normal displacements ----

struct SlidingLine {
  const char* name;
  std::function<double(double)> height;
  std::function<std::array<double, 3>(double)> derivatives;
};

const SlidingLine sliding_lines[] = {
    {"wave", [](double x) { return 0.3 + 0.08 * std::sin(5 * x) + 0.03 * x * x; },
     [](double x) {
       return std::array{0.4 * std::cos(5 * x) + 0.06 * x, -2 * std::sin(5 * x) + 0.06, -10 * std::cos(5 * x)};
     }},
    {"cubic", [](double x) { return 0.2 + x * (0.7 + x * (-1.6 + x)); },
     [](double x) {
       return std::array{0.7 + x * (-3.2 + 3 * x), -3.2 + 6 * x, 6.0};
     }},
};

std::array<Errors, 4> sliding_study(const SlidingLine& line, CellKind kind, Multipliers multipliers, bool on_lower,
                                    Normals normals) {
  std::array<Errors, 4> errors{};
  for (int level = 0; level < 4; ++level) {
    ManufacturedCase c;
    c.plates.height = line.height;
    c.plates.n_upper = (is_quadratic(kind) ? 6 : 12) << level;
    c.plates.n_lower = c.plates.n_upper * 4 / 3;
    c.plates.kind_upper = c.plates.kind_lower = kind;
    c.multipliers = multipliers;
    c.multipliers_on_lower = on_lower;
    c.normals = normals;
    c.slip = Slip{0.2, 0.3, line.derivatives};
    errors[level] = manufactured_errors(c);
  }
  std::printf("%-6s u %.1e (%.2f)  p %.1e (%.2f)\n", line.name, errors[3].displacement,
              rate(errors[2].displacement, errors[3].displacement), errors[3].pressure,
              rate(errors[2].pressure, errors[3].pressure));
  return errors;
}

class Sliding : public testing::TestWithParam<std::tuple<CellKind, Multipliers, bool>> {};

TEST_P(Sliding, KeepsTheRatesAlongTheNormalsOfTheCurve) {
  const auto [kind, multipliers, on_lower] = GetParam();
  for (const SlidingLine& line : sliding_lines) {
    SCOPED_TRACE(line.name);
    const auto e = sliding_study(line, kind, multipliers, on_lower, Normals::curve);
    EXPECT_GE(rate(e[2].displacement, e[3].displacement), is_quadratic(kind) ? 2.85 : 1.95);
    EXPECT_GE(rate(e[2].pressure, e[3].pressure), is_quadratic(kind) ? 1.9 : 1);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Quadratic, Sliding,
    testing::Combine(testing::Values(CellKind::quad8, CellKind::quad9, CellKind::tri6),
                     testing::Values(Multipliers::quadratic, Multipliers::linear, Multipliers::dual), testing::Bool()));
INSTANTIATE_TEST_SUITE_P(Linear, Sliding,
                         testing::Combine(testing::Values(CellKind::quad4, CellKind::tri3),
                                          testing::Values(Multipliers::linear, Multipliers::dual), testing::Bool()));

TEST(Sliding, LosesAnOrderAlongTheNormalsOfTheEdges) {
  for (const Multipliers multipliers : {Multipliers::quadratic, Multipliers::dual}) {
    const auto e = sliding_study(sliding_lines[0], CellKind::quad8, multipliers, true, Normals::edges);
    EXPECT_LE(rate(e[2].pressure, e[3].pressure), 1.2);
  }
}

}  // namespace
}  // namespace mortise::test
