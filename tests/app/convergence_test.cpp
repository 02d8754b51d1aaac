// Rates of convergence against an exact field: docs/theory.md says which to expect.
#include <gtest/gtest.h>

#include <cmath>
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

struct Expected {
  double displacement, energy, pressure;  // rates; the pressure's is a lower bound
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
    errors[std::size_t(level)] = manufactured_errors(c);
    const Errors& e = errors[std::size_t(level)];
    std::printf("%-11s n %4d  u %.3e  energy %.3e  p %.3e\n", line.name, c.plates.n_upper, e.displacement, e.energy,
                e.pressure);
  }
  return errors;
}

double rate(double coarse, double fine) { return std::log2(coarse / fine); }

void expect_rates(const std::array<Errors, 4>& e, const Expected& expected) {
  EXPECT_NEAR(rate(e[2].displacement, e[3].displacement), expected.displacement, 0.15);
  EXPECT_NEAR(rate(e[2].energy, e[3].energy), expected.energy, 0.15);
  EXPECT_GE(rate(e[2].pressure, e[3].pressure), expected.pressure);
}

class Convergence : public testing::TestWithParam<std::tuple<CellKind, Multipliers, bool>> {};

TEST_P(Convergence, RatesAndErrorsOnAllLines) {
  const auto [kind, multipliers, on_lower] = GetParam();
  for (const Line& line : lines) {
    SCOPED_TRACE(line.name);
    const auto errors = study(line, kind, multipliers, on_lower);
    if (is_quadratic(kind)) {
      expect_rates(errors, {3, 2, 1.9});
    } else {
      expect_rates(errors, {2, 1, 1});
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Quadratic, Convergence,
                         testing::Combine(testing::Values(CellKind::quad8, CellKind::tri6),
                                          testing::Values(Multipliers::quadratic, Multipliers::linear,
                                                          Multipliers::dual),
                                          testing::Bool()));
INSTANTIATE_TEST_SUITE_P(Linear, Convergence,
                         testing::Combine(testing::Values(CellKind::quad4, CellKind::tri3),
                                          testing::Values(Multipliers::linear, Multipliers::dual), testing::Bool()));

}  // namespace
}  // namespace mortise::test
