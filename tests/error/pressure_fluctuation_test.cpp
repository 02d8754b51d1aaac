// Waves of the pressure that are shorter than windows.
#include "error/pressure_fluctuation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/solve_scene.hpp"
#include "support/pressure_at.hpp"
#include "support/two_blocks.hpp"

namespace mortise::test {
namespace {

// Two blocks 1 wide of triangles of some order, pressed together over a clearance of four waves.
Results waved_blocks(int order, int edges) {
  const std::string count = std::to_string(edges + 1), across = std::to_string(edges / 5 + 1);
  return pressed_blocks("Mesh.ElementOrder = " + std::to_string(order) + ";\n" +
                            "Rectangle(1) = {0, 0, 0, 1, 0.4}; Rectangle(2) = {0, 0.4, 0, 1, 0.4};\n"
                            "Transfinite Curve{1, 3, 5, 7} = " +
                            count + "; Transfinite Curve{2, 4, 6, 8} = " + across + ";",
                        "clearance = \"2e-5 * cos(8 * pi * x) + 0\"");
}

// Linear triangles are too stiff for the waves by a tenth to a half, all of the line's means are right, and p is
// smooth.
TEST(PressureFluctuation, OfBodiesThatAreTooStiffForItIsInTheBars) {
  const Results fine = waved_blocks(2, 200);
  for (const int edges : {40, 60, 80}) {
    const Results coarse = waved_blocks(1, edges);
    const PressureEstimate& e = coarse.estimate->pressures[0];
    ASSERT_TRUE(e.fluctuation);
    double off2 = 0, exact2 = 0;
    for (const ContactNode& node : coarse.recovery.contacts[0].multiplier.nodes) {
      const double exact = pressure_at(fine.recovery.contacts[0].multiplier.nodes, node.position.x());
      EXPECT_LE(std::abs(node.p - exact), node.p_error) << edges << " edges, x = " << node.position.x();
      off2 += std::pow(node.p - exact, 2);
      exact2 += exact * exact;
    }
    EXPECT_GE(coarse.estimate->pressure(), std::sqrt(off2 / exact2)) << edges;
    EXPECT_LE(coarse.estimate->pressure(), 3 * std::sqrt(off2 / exact2)) << edges;
  }
}

// A line of even edges that faces the other side all along, a multiplier a vertex.
struct Made {
  ContactPair pair;
  PressureLine line;
};

Made made(const VecX& s, const VecX& p) {
  const int count = int(s.size());
  Made m;
  m.line = {.s = s,
            .p = p,
            .h = VecX::Constant(count, s(1) - s(0)),
            .faced = std::vector<char>(count - 1, 1),
            .loaded = std::vector<char>(count, 1)};
  m.pair.coupling.B.resize(count, 1);
  for (int i = 0; i < count; ++i) {
    m.pair.coupling.row.push_back(i);
    if (i + 1 == count) break;
    m.pair.coupling.on_edge.push_back({i, i + 1, -1});
    for (const double xi : {-1 / std::sqrt(3.0), 1 / std::sqrt(3.0)})
      m.pair.points.push_back({.edge = i, .xi = xi, .ds = (s(1) - s(0)) / 2, .dA = (s(1) - s(0)) / 2});
  }
  return m;
}

TEST(PressureFluctuation, IsWhatAPolynomialOfFiveCoefficientsLeaves) {
  const VecX s = VecX::LinSpaced(41, 0, 1);
  const VecX smooth = 3 + s.array() - 2 * s.array().square() + s.array().pow(4);
  const Made none = made(s, smooth);
  EXPECT_FALSE(pressure_fluctuation(none.pair, none.line, std::vector<char>(41, 0), 0.2));
  const VecX wave = 0.1 * (16 * std::numbers::pi * s).array().sin();
  const Made m = made(s, smooth + wave);
  const auto found = pressure_fluctuation(m.pair, m.line, std::vector<char>(41, 0), 0.2);
  ASSERT_TRUE(found);
  EXPECT_LE((found->p - wave).cwiseAbs().maxCoeff(), 0.03);
  EXPECT_NEAR(found->rms, 0.1 / std::sqrt(2.0), 0.01);
  EXPECT_NEAR(found->length, 1, 1e-12);
  EXPECT_GE(found->amplitude.minCoeff(), 0.09);
  EXPECT_LE(found->amplitude.maxCoeff(), 0.12);
  EXPECT_NEAR(found->weights.dot(m.line.p), found->rms, 1e-3);  // its own mean, and none of the polynomial
}

TEST(PressureFluctuation, DoesNotLookAcrossWhatIsLeftOut) {
  const VecX s = VecX::LinSpaced(41, 0, 1);
  const VecX p = (s.array() > 0.51).select(VecX(5 + s.array()), VecX(1 + 2 * s.array()));
  const Made m = made(s, p);
  std::vector<char> excluded(41, 0);
  EXPECT_TRUE(pressure_fluctuation(m.pair, m.line, excluded, 0.2));
  excluded[20] = 1;
  EXPECT_FALSE(pressure_fluctuation(m.pair, m.line, excluded, 0.2));
}

// Around a ring that is loaded all round: the mean and two waves are told by windows, and any vertex may be the first.
TEST(PressureFluctuation, GoesAroundAClosedLine) {
  const int count = 40;
  const VecX s = VecX::LinSpaced(count + 1, 0, 1), angle = 2 * std::numbers::pi * s;
  const auto around = [&](const VecX& p) {
    Made m = made(s, p);
    m.line.closed = true;
    return pressure_fluctuation(m.pair, m.line, std::vector<char>(count + 1, 0), 0.2);
  };
  const VecX low = 3 + angle.array().cos() + (2 * angle.array() + 1).sin();
  EXPECT_FALSE(around(low));
  const auto with_wave = [&](double turn) -> VecX {
    return 3 + (angle.array() + turn).cos() + 0.1 * (8 * (angle.array() + turn)).cos();
  };
  const auto found = around(with_wave(0)), turned = around(with_wave(2 * std::numbers::pi * 7 / count));
  ASSERT_TRUE(found && turned);
  EXPECT_NEAR(found->rms, turned->rms, 1e-12);
  for (int i = 0; i < count; ++i) EXPECT_NEAR(turned->p(i), found->p((i + 7) % count), 1e-12) << i;
}

}  // namespace
}  // namespace mortise::test
