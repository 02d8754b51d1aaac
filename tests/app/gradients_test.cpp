// Derivatives of figures: exact ones, the values at which rows change, and what is refused.
#include "app/gradients.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/solve_scene.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

using Overrides = std::vector<Override>;

std::string path_of(const std::string& name) { return std::string(MORTISE_SOURCE_DIR) + "/geo/" + name + ".toml"; }

Gradients gradients_in(const std::string& name, const Overrides& overrides, const std::vector<Figure>& of,
                       const std::vector<Parameter>& by) {
  const std::string path = path_of(name);
  return gradients(solve_scene(parametrised(path, overrides, by)), path, overrides, of, by);
}

// ---- Two blocks in uniaxial strain: springs in a row ----

class OfSprings : public testing::TestWithParam<std::tuple<bool, const char*>> {};

TEST_P(OfSprings, AreExact) {
  const auto [gives_way, solver] = GetParam();
  const double d = 3e-4, c = 1e-5, young = 70e9, area = 0.8, k = 2e12;
  Overrides overrides{{"method.solver", solver}};
  if (gives_way) overrides.push_back({"contact.0.stiffness", "2e12"});
  const auto of_block = [](double E) { return 0.3 * 1.3 * 0.4 / (0.7 * E); };
  const double lower = of_block(young), bodies = lower + of_block(210e9), all = bodies + (gives_way ? 1 / k : 0),
               p = (d - 1e-4 - c) / all, dp = p * lower / young / all, energy = p * p / 2 * area * bodies;
  const Gradients found = gradients_in(
      "gap_close", overrides, {{"contact.0.pressure.mean", {}}, {"energy", {}}, {"contact.0.force.y", {}}},
      {{"boundary.2.displacement.y", -d}, {"contact.0.clearance", c}, {"materials.aluminium.young", young}});
  const Eigen::Vector3d values(p, energy, -p * area);
  Eigen::Matrix3d derivatives;
  derivatives.row(0) << -1 / all, -1 / all, dp;
  derivatives.row(1) = 2 * energy / p * derivatives.row(0);
  derivatives(1, 2) -= p * p / 2 * area * lower / young;
  derivatives.row(2) = -area * derivatives.row(0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(found.values(i), values(i), 1e-9 * std::abs(values(i)));
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(found.derivatives(i, j), derivatives(i, j), 1e-8 * std::abs(derivatives(i, j))) << i << " by " << j;
  }
  constexpr double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(found.between(0, 0), -infinite);
  EXPECT_NEAR(found.between(0, 1), -1e-4 - c, 1e-10);
  EXPECT_EQ(found.between(1, 0), -infinite);
  EXPECT_NEAR(found.between(1, 1), d - 1e-4, 1e-10);
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutALayer, OfSprings,
                         testing::Combine(testing::Bool(), testing::Values("direct", "feti")));

TEST(Gradients, OfAnOpenPairAreZeroUntilItCloses) {
  const Gradients found =
      gradients_in("gap_close", {}, {{"contact.0.pressure.mean", {}}}, {{"boundary.2.displacement.y", -5e-5}});
  EXPECT_EQ(found.values(0), 0);
  EXPECT_EQ(found.derivatives(0, 0), 0);
  EXPECT_NEAR(found.between(0, 0), -1e-4, 1e-12);
  EXPECT_EQ(found.between(0, 1), std::numeric_limits<double>::infinity());
}

// As of a layer with the slope that the law has there.
TEST(Gradients, OfALawThatIsNotLinear) {
  const double of_bodies = 0.3 * 1.3 * 0.4 / 0.7 * (1 / 70e9 + 1 / 210e9);
  for (const char* solver : {"direct", "feti"}) {
    const Gradients found = gradients_in(
        "gap_close", {{"contact.0.stiffness", "{pressure=2e7, overlap=1e-5, exponent=2.5}"}, {"method.solver", solver}},
        {{"contact.0.pressure.mean", {}}}, {{"boundary.2.displacement.y", -3e-4}});
    const double p = found.values(0), overlap = 1e-5 * std::pow(p / 2e7, 0.4), slope = 2.5 * p / overlap;
    EXPECT_NEAR(2e-4 - overlap, p * of_bodies, 1e-9 * 2e-4);
    EXPECT_NEAR(found.derivatives(0, 0) * (of_bodies + 1 / slope), -1, 1e-8);
  }
}

// What a block of rubber carries is its load, whatever its Poisson's ratio: stiffnesses that are nearly infinite, and
// their differences, are known to fewer digits.
TEST(Gradients, OfNearlyIncompressibleBodies) {
  const TemporaryFolder folder;
  folder.write("nu.geo", R"(SetFactory("OpenCASCADE");
Rectangle(1) = {-5, 0, 0, 10, 4}; Rectangle(2) = {-2, 4, 0, 4, 3}; Mesh.ElementOrder = 2;
Transfinite Curve{1, 3} = 21; Transfinite Curve{2, 4} = 9; Transfinite Curve{5, 7} = 12; Transfinite Curve{6, 8} = 9;
Transfinite Surface{1, 2};
Physical Surface("low") = {1}; Physical Surface("up") = {2};
Physical Curve("ground") = {1}; Physical Curve("top") = {3}; Physical Curve("foot") = {5}; Physical Curve("head") = {7};
)");
  const std::string path = folder.write("nu.toml", R"(
mesh.file = "nu.geo"
materials = { s = { young = 1000, poisson = 0.3 }, r = { young = 100, poisson = 0.3 } }
bodies = { low = "s", up = "r" }
boundary = [{ on = "ground", displacement = { x = 0, y = 0 } }, { on = "head", displacement = { x = 0 } },
            { on = "head", pressure = 1 }]
contact = [{ between = ["top", "foot"] }]
)");
  const auto at = [&](double poisson) {
    const std::vector<Parameter> by{{"materials.r.poisson", poisson}};
    return gradients(solve_scene(parametrised(path, {}, by)), path, {},
                     {{"contact.0.force.y", {}}, {"contact.0.pressure.norm", {6}}}, by);
  };
  for (const double compressible : {1e-2, 1e-3, 1e-4}) {
    const double poisson = 0.5 - compressible, step = compressible / 30;
    const VecX found = at(poisson).derivatives,
               slope = (at(poisson + step).values - at(poisson - step).values) / (2 * step);
    EXPECT_NEAR(found(0), 0, 1e-3) << compressible;
    EXPECT_NEAR(found(1), slope(1), 1e-3 * std::abs(slope(1))) << compressible;
  }
}

TEST(Gradients, ByTheMotionOfAContactCurve) {
  const double stiffness = 70e9 * 0.7 / (1.3 * 0.4 * 0.3);
  const Gradients found = gradients_in("gap_close", {{"boundary.2.on", "upper_contact"}},
                                       {{"contact.0.pressure.mean", {}}}, {{"boundary.2.displacement.y", -3e-4}});
  EXPECT_NEAR(found.values(0), 2e-4 * stiffness, 1e-9 * 2e-4 * stiffness);
  EXPECT_NEAR(found.derivatives(0, 0), -stiffness, 1e-8 * stiffness);
}

// ---- Where rows change ----

TEST(Gradients, TellWhereRowsChange) {
  for (const bool gives_way : {false, true}) {
    Overrides overrides{{"mesh.parameters", "{n_plate = 24, n_block = 30}"}};
    if (gives_way) overrides.push_back({"contact.0.stiffness", "1e12"});
    const auto closed = [&](double pressure) {
      const std::vector<Parameter> by{{"boundary.2.pressure", pressure}};
      return solve_scene(parametrised(path_of("lift_off"), overrides, by)).solution.active;
    };
    const auto between =
        gradients_in("lift_off", overrides, {{"energy", {}}}, {{"boundary.2.pressure", 1e6}}).between.row(0).eval();
    const std::vector<char> here = closed(1e6);
    ASSERT_TRUE(0 < between(0) && between(0) < 1e6 && 1e6 < between(1)) << between << gives_way;
    EXPECT_EQ(closed(between(0) * (1 + 1e-6)), here) << gives_way;
    EXPECT_NE(closed(between(0) * (1 - 1e-6)), here) << gives_way;
    EXPECT_EQ(closed(between(1) * (1 - 1e-6)), here) << gives_way;
    EXPECT_NE(closed(between(1) * (1 + 1e-6)), here) << gives_way;
  }
}

// ---- What is refused ----

TEST(Gradients, AreNoneOfAMeanOverNoPartOfTheLine) {
  for (const auto& window : {std::vector<double>{5, 6}, {0.3, 0.1}, {-2, 0}})
    EXPECT_NE(
        message_of([&] {
          gradients_in("gap_close", {}, {{"contact.0.pressure.mean", window}}, {{"boundary.2.displacement.y", -3e-4}});
        }).find("figure 'contact.0.pressure.mean': expected a window [from, to] with from < to on the contact line"),
        std::string::npos);
}

TEST(Gradients, AreNoneWhereTheRowsThemselvesChange) {
  // Both sides' corners on the left are held, so that no row is theirs: with their gap closed the next one's p is.
  const Overrides held{{"boundary",
                        "[{on = [\"upper_left\", \"lower_left\", \"bottom\"], displacement = {x = 0, y = 0}}, "
                        "{on = \"top\", pressure = 1e6}]"},
                       {"contact.0.initial_gap", "10 * (c - 1)"}};
  EXPECT_EQ(message_of([&] {
              gradients_in("gap_close", held, {{"energy", {}}}, {{"constants.c", 1}});
            }),
            path_of("gap_close") +
                ": constants.c: changes which rows contact has, so that nothing is known of its gradients");
}

TEST(Gradients, AreNoneOfWhatHasNotConverged) {
  const Overrides stopped{{"method.solver", "mssor"}, {"method.max_iterations", "2"}};
  EXPECT_EQ(message_of([&] {
              gradients_in("gap_close", stopped, {{"energy", {}}}, {{"boundary.2.displacement.y", -3e-4}});
            }),
            path_of("gap_close") + ": the solution has not converged, so that nothing is known of its gradients");
}

// Of rings a mean is over an area, of a part of the line as of all of it.
TEST(Gradients, MeansOfRingsAreOverTheAreaOfTheirWindow) {
  const Results r = solve_scene(read_scene(MORTISE_SOURCE_DIR "/geo/hertz_sphere.toml"));
  const std::vector<ContactNode>& nodes = r.recovery.contacts[0].multiplier.nodes;
  std::vector<const ContactNode*> vertices;
  for (const ContactNode& node : nodes)
    if (std::abs(node.on_multiplier.xi) == 1) vertices.push_back(&node);
  double force = 0, area = 0;
  for (std::size_t i = 1; i < vertices.size() / 2; ++i) {
    const ContactNode &a = *vertices[i - 1], &b = *vertices[i];
    const double ra = a.position.x(), rb = b.position.x(), h = b.s - a.s;
    force += h * (a.p_multiplier * (2 * ra + rb) + b.p_multiplier * (ra + 2 * rb)) / 6;
    area += h * (ra + rb) / 2;
    const double mean = linearised(r, {"contact.0.pressure.mean", {vertices[0]->s, b.s}}).value;
    EXPECT_NEAR(mean, force / area, 1e-6 * mean) << b.s;
  }
}

}  // namespace
}  // namespace mortise::test
