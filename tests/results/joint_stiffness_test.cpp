// The stiffness that a support meets: bars and joints by hand, Hertz's closed form, and differences.
#include "results/joint_stiffness.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "app/solve_scene.hpp"
#include "support/patches.hpp"

namespace mortise::test {
namespace {

constexpr double young = 200e9, thickness = 0.5;

// Bars along y without lateral strain, in plane stress: what theory has for bars is exact.
Scene bars(const std::vector<std::string>& names) {
  Scene scene;
  scene.path = "bars.toml";
  scene.model = {Plane::stress, thickness};
  scene.materials["steel"] = {young, 0};
  for (const std::string& name : names) scene.bodies.push_back({name, "steel"});
  return scene;
}

BoundarySpec support(std::vector<std::string> on, const BoundaryCondition& what, bool stiffness = false) {
  return {.key = "boundary", .on = std::move(on), .what = what, .stiffness = stiffness};
}

ContactSpec contact(const std::string& a, const std::string& b, double overlap = 0) {
  ContactSpec spec{.key = "contact.0", .between = {a, b}};
  spec.initial_gap = InitialGap::given;
  spec.gap = -overlap;
  return spec;
}

Patch bar(const std::string& name, double x0, double x1, double y0, double y1) {
  return block(
      name, 3, 4, x0, x1, [=](double) { return y0; }, [=](double) { return y1; });
}

Eigen::Matrix3d stiffness_in(const Results& r) { return r.recovery.reactions.stiffnesses.at(0).matrix.value(); }

// |difference| against the size that the entries of both rows have.
void expect_close(const Eigen::Matrix3d& found, const Eigen::Matrix3d& expected, double part) {
  const double largest = expected.cwiseAbs().maxCoeff();
  EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), part * largest) << found << "\n\n" << expected;
}

// Two bars, 0.2 wide, one upon the other, 0.7 high together.
Results two_bars(const BoundaryCondition& top, const std::optional<ContactLaw>& layer = {},
                 Solver solver = Solver::direct) {
  Scene scene = bars({"lower", "upper"});
  scene.boundaries = {support({"lower_south"}, Displacement{0, 0}), support({"upper_north"}, top, true)};
  scene.contacts = {contact("upper_south", "lower_north")};
  scene.contacts[0].stiffness = layer;
  scene.method.solver = solver;
  return solve_scene(scene, mesh_of({bar("lower", 0, 0.2, 0, 0.3), bar("upper", 0, 0.2, 0.3, 0.7)}, CellKind::quad8));
}

// Of a bar: along y, and turned about a place at some distance from its axis.
Eigen::Matrix3d bar_stiffness(double width, double length, double distance) {
  const double along = young * width * thickness / length,
               turned = young * std::pow(width, 3) / 12 * thickness / length;
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  matrix.bottomRightCorner<2, 2>() << along, distance * along, distance * along, turned + distance * distance * along;
  return matrix;
}

TEST(JointStiffness, IsThatOfBarsWhateverIsPrescribed) {
  const Eigen::Matrix3d expected = bar_stiffness(0.2, 0.7, 0);
  const Results held = two_bars(RigidSpec{.x = 0, .y = -1e-5, .rotation = 0});
  ASSERT_EQ(held.status, Status::solved);
  expect_close(stiffness_in(held), expected, 1e-10);
  expect_close(stiffness_in(two_bars(RigidSpec{.x = 0, .force = {0, -1e6}})), expected, 1e-10);
  expect_close(stiffness_in(two_bars(Displacement{0, -1e-5})), expected, 1e-10);
  // Along y alone: what it does not hold it does not feel.
  Eigen::Matrix3d along_y = stiffness_in(two_bars(Displacement{0, -1e-5}));
  EXPECT_GT(along_y(1, 1), 0);
  // About the left end of the top.
  const Results aside = two_bars(RigidSpec{.x = 0, .y = -1e-5, .rotation = 0, .about = Vec2(0, 0.7)});
  expect_close(stiffness_in(aside), bar_stiffness(0.2, 0.7, 0.1), 1e-10);
  EXPECT_EQ(aside.recovery.reactions.stiffnesses[0].about, Vec2(0, 0.7));
}

TEST(JointStiffness, OfASupportOnTheContactCurveIsThatOfTheOtherSide) {
  Scene scene = bars({"lower", "upper"});
  scene.boundaries = {support({"lower_south"}, Displacement{0, 0}),
                      support({"upper_south"}, Displacement{0, -1e-5}, true)};
  scene.contacts = {contact("upper_south", "lower_north")};
  for (const char* side : {"upper_south", "lower_north"}) {
    scene.contacts[0].multipliers_on = side;
    const Results r =
        solve_scene(scene, mesh_of({bar("lower", 0, 0.2, 0, 0.3), bar("upper", 0, 0.2, 0.3, 0.7)}, CellKind::quad8));
    ASSERT_EQ(r.status, Status::solved) << side;
    expect_close(stiffness_in(r), bar_stiffness(0.2, 0.3, 0), 1e-10);
  }
}

// A bolt, and beside it a sleeve with a cap that the bolt's head presses on it: both as long as each other.
Results bolted(double overlap, double load) {
  Scene scene = bars({"bolt", "sleeve", "cap"});
  scene.boundaries = {support({"bolt_south"}, Displacement{{}, 0}), support({"sleeve_south"}, Displacement{0, 0}),
                      support({"bolt_north", "cap_north"},
                              RigidSpec{.x = 0, .rotation = 0, .force = {0, load}, .about = Vec2(0.05, 0.5)}, true)};
  scene.contacts = {contact("cap_south", "sleeve_north", overlap)};
  return solve_scene(
      scene, mesh_of({bar("bolt", 0, 0.1, 0, 0.5), bar("sleeve", 0.2, 0.5, 0, 0.4), bar("cap", 0.2, 0.5, 0.4, 0.5)},
                     CellKind::quad8));
}

TEST(JointStiffness, OfABoltedJointIsThatOfBoltAndPlatesUntilItOpens) {
  const Eigen::Matrix3d bolt = bar_stiffness(0.1, 0.5, 0), plates = bar_stiffness(0.3, 0.5, 0.3);
  const double preload = 1e-5 / (1 / bolt(1, 1) + 1 / plates(1, 1)), opens = preload * (1 + bolt(1, 1) / plates(1, 1));
  expect_close(stiffness_in(bolted(1e-5, 0)), bolt + plates, 1e-10);
  expect_close(stiffness_in(bolted(1e-5, 0.99 * opens)), bolt + plates, 1e-10);
  expect_close(stiffness_in(bolted(1e-5, 1.01 * opens)), bolt, 1e-10);
}

TEST(JointStiffness, IsThatOfDifferences) {
  // A stamp, tilted a little, on a block on a foundation that gives way.
  Scene scene = bars({"block", "stamp"});
  scene.materials["steel"].poisson = 0.3;
  RigidSpec motion{.x = 1e-5, .y = -1e-3, .rotation = 2e-4};
  const auto solved = [&](const RigidSpec& moved) {
    scene.boundaries = {support({"block_south"}, AxesFoundation{Vec2(1e11, 1e12)}),
                        support({"stamp_north"}, moved, true)};
    scene.contacts = {contact("stamp_south", "block_north")};
    const auto tip = [](double x) { return 1 + 0.01 * x * x; };
    return solve_scene(
        scene, mesh_of({bar("block", -2, 2, 0, 1), block("stamp", 8, 3, -0.5, 0.5, tip, [](double) { return 2; })},
                       CellKind::quad8));
  };
  const Results r = solved(motion);
  Eigen::Matrix3d differences;
  for (int k = 0; k < 3; ++k) {
    constexpr double step = 1e-8;
    const auto force = [&](double by) -> Eigen::Vector3d {
      RigidSpec moved = motion;
      std::optional<double>& value = k == 0 ? moved.x : k == 1 ? moved.y : moved.rotation;
      *value += by;
      const Results at = solved(moved);
      EXPECT_EQ(at.solution.active, r.solution.active);
      const Resultant& sum = at.recovery.reactions.entries[1];
      return {sum.force.x(), sum.force.y(), sum.moment_about(r.recovery.reactions.stiffnesses[0].about)};
    };
    differences.col(k) = (force(step) - force(-step)) / (2 * step);
  }
  expect_close(stiffness_in(r), differences, 1e-6);
}

// Places from 0 to 200 a at t from 0 to 1: a hundredth of them each apart by 1e-3 a about the end of contact at a.
double graded(double t, double a) {
  if (t < 0.2) return a * (0.95 - 0.95 * std::pow(1 - t / 0.2, 2));
  if (t < 0.7) return a * (0.95 + 0.1 * (t - 0.2) / 0.5);
  return a * (1.05 + 198.95 * std::expm1(11 * (t - 0.7) / 0.3) / std::expm1(11));
}

TEST(JointStiffness, OfASphereIsHertzs) {
  // F = 4/3 E* sqrt(R) d^1.5, so dF/dd = 1.5 F/d = 2 E* a; what the bodies farther away give besides grows as F.
  constexpr double a = 0.01, radius = 1, E_star = young / 2, d = a * a / radius, force = 4.0 / 3 * E_star * a * d;
  Scene scene = bars({"block", "ball"});
  scene.model = {Plane::axisymmetric};
  scene.boundaries = {support({"block_south"}, Displacement{{}, 0}),
                      support({"ball_north"}, RigidSpec{.force = {0, -force}}, true)};
  scene.contacts = {contact("ball_south", "block_north")};
  scene.contacts[0].gap = Field("x^2 / 2", {});
  const auto half = [&](const std::string& name, double sign) -> Patch {
    return {
        name, 200, 40, [=](double s, double t) -> Vec2 {
          const double before = std::floor(200 * s + 1e-9) / 200, after = std::ceil(200 * s - 1e-9) / 200;
          const double away = sign > 0 ? t : 1 - t;
          return {(graded(before, a) + graded(after, a)) / 2, sign * 200 * a * std::expm1(10 * away) / std::expm1(10)};
        }};
  };
  const Results r = solve_scene(scene, mesh_of({half("block", -1), half("ball", 1)}, CellKind::quad8));
  ASSERT_EQ(r.status, Status::solved);
  const double moved = -r.recovery.reactions.rigid_motions[0].y(), exact = force / (d / 1.5 + (moved - d));
  EXPECT_LT(moved - d, 0.03 * d);
  const Eigen::Matrix3d found = stiffness_in(r);
  EXPECT_NEAR(found(1, 1), exact, 1e-3 * exact);
  EXPECT_EQ(found.cwiseAbs().sum(), found(1, 1)) << "rings move along the axis alone";
}

TEST(JointStiffness, IsNoneWhereAMotionIsHeldThatNothingHolds) {
  const Results r = two_bars(RigidSpec{.rotation = 0, .force = {0, -1e6}});
  ASSERT_FALSE(r.unheld.empty());
  EXPECT_FALSE(r.recovery.reactions.stiffnesses.at(0).matrix);
}

TEST(JointStiffness, WithContactThatGivesWayIsThatOfSpringsInARow) {
  // The layer gives way as 1 more of a bar does, but for the 1e-9 that hold compressions where nothing faces.
  const ContactLaw law{.points = {{1, young}}};
  for (const Solver solver : {Solver::direct, Solver::feti})
    expect_close(stiffness_in(two_bars(Displacement{0, -1e-5}, law, solver)), bar_stiffness(0.2, 1.7, 0), 1e-9);
}

TEST(JointStiffness, WithALawThatIsNotLinearIsThatOfItsSlope) {
  // Both bars are shortened by 0.7e-5, the layer by 0.5e-5: with p = c d^2 its slope is 2 p / d, that of 0.25 of a bar.
  const ContactLaw law{.points = {{0.5e-5, 1e-5 * young}}, .exponent = 2};
  for (const Solver solver : {Solver::direct, Solver::feti})
    expect_close(stiffness_in(two_bars(Displacement{0, -1.2e-5}, law, solver)), bar_stiffness(0.2, 0.95, 0), 1e-7);
}

}  // namespace
}  // namespace mortise::test
