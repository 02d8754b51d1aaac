#include "results/contact_results.hpp"

#include <gtest/gtest.h>

#include <random>

#include "app/solve_scene.hpp"
#include "base/printable.hpp"
#include "contact/coupling.hpp"
#include "fem/quadrature.hpp"
#include "results/extremes.hpp"
#include "support/patches.hpp"
#include "support/temporary_folder.hpp"

namespace mortise {
namespace {

Results solved_with(const std::string& scene, std::vector<Override> settings) {
  return solve_scene(read_scene(MORTISE_SOURCE_DIR "/geo/" + scene, settings));
}

/// The first pair's results with other pressures or displacements.
ContactResults of(const Results& r, const Solution& solution) {
  return contact_results(r.problem, r.problem.pairs[0], r.nodes[0], r.recovery.stress, solution,
                         largest_entry(solution.u));
}

Solution with_any_pressures(const Results& r, int seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(-1, 1);
  Solution solution = r.solution;
  for (double& lambda : solution.lambda) lambda *= part(random);
  return solution;
}

const std::vector<Override> quadratic{
    {"method.multipliers", "quadratic"}, {"mesh.parameters.n_upper", "16"}, {"mesh.parameters.n_lower", "20"}};

TEST(ContactResults, PositionsRunFromZeroToTheLengthOnBothSides) {
  for (const std::string scene : {"patch_inclined.toml", "parabola_1.toml"}) {
    const Results r = solved_with(scene, {});
    const ContactResults& c = r.recovery.contacts[0];
    for (const ContactSide* side : {&c.multiplier, &c.opposite}) {
      EXPECT_NEAR(side->nodes.front().s, 0, 1e-12);
      EXPECT_NEAR(side->nodes.back().s, c.length, 1e-2 * c.length);
      for (std::size_t i = 1; i < side->nodes.size(); ++i)
        EXPECT_NEAR(side->nodes[i].s - side->nodes[i - 1].s,
                    (side->nodes[i].position - side->nodes[i - 1].position).norm(), 1e-3 * c.length);
    }
    EXPECT_LE((c.multiplier.nodes[0].position - c.opposite.nodes[0].position).norm(), 1e-3 * c.length);
  }
}

// A foot whose p has no limit at its ends, on a block with nodes a little within them: as far as rounding, or what a
// file's digits leave.
TEST(ContactResults, NodesAtOnePlaceWithAnEndWithoutLimitHaveItsPressure) {
  for (const double beside : {0., 1e-13, 1e-11, 1e-9, 1e-6, 1e-4, 2e-3}) {
    const test::TemporaryFolder folder;
    folder.write("foot.geo", worded(R"(SetFactory("OpenCASCADE"); Mesh.ElementOrder = 2;
Rectangle(1) = {0, -2, 0, 3, 2}; Rectangle(2) = {1 - )",
                                    beside, ", 0, 0, ", 1 + 2 * beside, R"(, 1};
Transfinite Curve{1, 3} = 19; Transfinite Curve{2, 4} = 13; Transfinite Curve{5, 7} = 9; Transfinite Curve{6, 8} = 9;
Transfinite Surface{1, 2};
Physical Surface("block") = {1}; Physical Surface("punch") = {2}; Physical Curve("ground") = {1};
Physical Curve("top") = {3}; Physical Curve("foot") = {5}; Physical Curve("head") = {7};
)"));
    Results r = solve_scene(read_scene(folder.write("foot.toml", R"(mesh.file = "foot.geo"
materials.m = { young = 1000, poisson = 0.3 }
bodies = { block = "m", punch = "m" }
boundary = [{ on = "ground", displacement = { x = 0, y = 0 } }, { on = "head", displacement = { x = 0, y = -1e-3 } }]
contact = [{ between = ["foot", "top"] }]
)")));
    estimate(r);
    int ends = 0;
    for (const ContactNode& node : r.recovery.contacts[0].opposite.nodes) {
      if (std::abs(std::abs(node.position.x() - 1.5) - 0.5) > 1e-6) continue;
      EXPECT_EQ(node.p, node.p_multiplier) << beside;
      EXPECT_GT(node.p, 0) << beside;
      ++ends;
    }
    EXPECT_EQ(ends, 2) << beside;
  }
}

// The multiplier of an edge of which a part faces the other side goes on to its end.
TEST(ContactResults, NodesThatFaceNothingHaveNoPressure) {
  Results r = solved_with("punch.toml", {{"contact.0.multipliers_on", "block_top"}, {"mesh.parameters.n_block", "83"}});
  estimate(r);
  int left_out = 0;
  for (const ContactNode& node : r.recovery.contacts[0].multiplier.nodes) {
    if (!std::isnan(node.gap)) continue;
    EXPECT_EQ(node.p, 0) << node.s;
    EXPECT_TRUE(std::isnan(node.p_error)) << node.s;
    left_out += node.p_multiplier > 0;
  }
  EXPECT_GT(left_out, 0);
}

// Ends are one place up to a twentieth of the shorter edge, whichever side carries the multipliers.
TEST(ContactResults, NodesBeyondAnEndOfTheMultiplierSideHaveNoPressure) {
  const auto level = [](double y) { return [=](double) { return y; }; };
  for (const double past : {0.02, 0.1, 0.3}) {  // of the block's edges, a tenth of the foot's
    Scene scene;
    scene.path = "foot";
    scene.materials["steel"] = {210e9, 0.3};
    scene.bodies = {{"block", "steel"}, {"foot", "steel"}};
    scene.boundaries = {{.key = "support", .on = {"block_south"}, .what = Displacement{0, 0}},
                        {.key = "side", .on = {"foot_west"}, .what = Displacement{0, {}}},
                        {.key = "load", .on = {"foot_north"}, .what = Pressure{1e6}}};
    scene.contacts = {{.key = "contact.0", .between = {"foot_south", "block_north"}}};
    scene.contacts[0].multipliers_on = "foot_south";
    const Results r =
        solve_scene(scene, test::mesh_of({test::block("block", 30, 10, 0, 3, level(0), level(1)),
                                          test::block("foot", 2, 2, 0, 2 - 0.1 * past, level(1), level(2))},
                                         CellKind::quad8));
    for (const ContactNode& node : r.recovery.contacts[0].opposite.nodes)
      EXPECT_EQ(node.p > 0, node.position.x() < (past < 0.05 ? 2.01 : 1.99)) << past << " " << node.position.x();
  }
}

// A coarse block: edges beside the foot that end at its corner face nothing (6), or a part of it (7).
TEST(ContactResults, MeansOverEdgesCarryTheForceWhereEdgesFaceAPartOfTheOther) {
  for (const std::string side : {"foot", "block_top"})
    for (const std::string edges : {"6", "7", "83", "90"}) {
      const Results r =
          solved_with("punch.toml", {{"contact.0.multipliers_on", side}, {"mesh.parameters.n_block", edges}});
      const ContactResults& c = r.recovery.contacts[0];
      for (const auto* line : {&c.multiplier, &c.opposite}) {
        const auto& nodes = line->nodes;
        double force = 0;
        for (std::size_t e = 0; e < line->centres.size(); ++e) {
          const double p = line->centres[e].p, begin = nodes[2 * e].s, end = nodes[2 * e + 2].s;
          force += p * (end - begin);
          if (line->curve == "block_top" &&
              (nodes[2 * e + 2].position.x() < 0.2 + 1e-9 || nodes[2 * e].position.x() > 0.4 - 1e-9)) {
            EXPECT_EQ(p, 0) << side << edges;
          }
        }
        EXPECT_NEAR(force, 2e6, 0.06 * 2e6) << side << edges << line->curve;
      }
    }
}

// The parabola's own normal leans there, by a slope of 1.
TEST(ContactResults, NormalsAtEndsOnSymmetryPlanesLieInThem) {
  const Results r = solved_with("parabola_1.toml", quadratic);
  for (const ContactSide* side : {&r.recovery.contacts[0].multiplier, &r.recovery.contacts[0].opposite})
    for (const ContactNode* end : {&side->nodes.front(), &side->nodes.back()})
      EXPECT_NEAR(std::abs(end->normal.y()), 1, 1e-12) << side->curve;
}

// Of a polygon of even edges in a polygon: along the radius at each vertex, wherever the curve begins.
TEST(ContactResults, NormalsOfClosedCurvesAreMeansOfBothEdgesAtTheSeamToo) {
  Scene scene;
  scene.path = "rings";
  scene.materials["steel"] = {210e9, 0.3};
  scene.bodies = {{"inner", "steel"}, {"outer", "steel"}};
  scene.boundaries = {{.key = "support", .on = {"inner_south"}, .what = Displacement{0, 0}},
                      {.key = "load", .on = {"outer_north"}, .what = Pressure{1e6}}};
  scene.contacts = {{.key = "contact.0", .between = {"inner_north", "outer_south"}}};
  scene.method.normals = Normals::edges;
  test::Patch inner = test::ring("inner", 12, 2, {0, 0}, 1, 2, 360, 0),
              outer = test::ring("outer", 12, 2, {0, 0}, 2, 3, 360, 0);
  inner.closed = outer.closed = true;
  const Results r = solve_scene(scene, test::mesh_of({inner, outer}, CellKind::quad4));
  const ContactResults& c = r.recovery.contacts[0];
  ASSERT_EQ(c.multiplier.nodes.size(), 12u);
  for (const ContactSide* side : {&c.multiplier, &c.opposite})
    for (const ContactNode& n : side->nodes)
      EXPECT_NEAR(std::abs(n.normal.dot(n.position)), n.position.norm(), 1e-12) << n.position.transpose();
}

// The normals of the lower plate meet the wheel at its foot first; they go on through its top, and the hub's.
TEST(ContactResults, TheBackOfAClosedCurveHasNoPressure) {
  for (const bool along_lines : {false, true}) {
    Scene scene;
    scene.path = "wheel";
    scene.materials["steel"] = {210e3, 0.3};
    scene.bodies = {{"plate", "steel"}, {"wheel", "steel"}};
    scene.boundaries = {{.key = "support", .on = {"plate_south"}, .what = Displacement{0, 0}},
                        {.key = "load", .on = {"wheel_south"}, .what = Displacement{0, -0.05}}};
    scene.contacts = {{.key = "contact.0", .between = {"plate_north", "wheel_north"}, .multipliers_on = "plate_north"}};
    scene.contacts[0].condition = Condition::unilateral;
    scene.contacts[0].initial_gap = InitialGap::curve;
    scene.method.normals = along_lines ? Normals::curve : Normals::edges;
    const auto level = [](double y) { return [y](double) { return y; }; };
    test::Patch wheel = test::ring("wheel", 360, 8, {0, 2}, 1, 2, 450, 90);
    wheel.closed = true;
    const Results r = solve_scene(
        scene, test::mesh_of({wheel, test::block("plate", 60, 8, -1, 1, level(-1), level(0))}, CellKind::quad8));
    const ContactResults& c = r.recovery.contacts[0];
    double force = 0;
    int pressed = 0;
    for (std::size_t i = 0; i < c.opposite.nodes.size(); ++i) {
      const ContactNode &n = c.opposite.nodes[i], &next = c.opposite.nodes[(i + 1) % c.opposite.nodes.size()];
      force += (n.p + next.p) / 2 * (next.position - n.position).norm();
      pressed += n.p > 0;
      if (n.position.y() > 2) {
        EXPECT_TRUE(n.p == 0 && std::isnan(n.gap)) << n.position.transpose();
      }
    }
    EXPECT_GT(pressed, 5);
    EXPECT_NEAR(force, std::abs(c.force.y()), 0.03 * force) << along_lines;
  }
}

TEST(ContactResults, NormalStressesOfCurvedSidesAreThePressures) {
  const Results r = solved_with("shrink_fit.toml", {});
  const ContactResults& c = r.recovery.contacts[0];
  for (const ContactNode& n : c.multiplier.nodes) EXPECT_NEAR(n.sigma_n, -n.p, 0.05 * c.p_max) << n.position;
}

TEST(ContactResults, MeansOverEdgesAreThoseOfTheParabolas) {
  const Results r = solved_with("parabola_1.toml", quadratic);
  const ContactResults c = of(r, with_any_pressures(r));
  const ContactPair& pair = r.problem.pairs[0];
  const LineRule rule = gauss_legendre(3);
  for (int e = 0; e < int(pair.multiplier.edges.size()); ++e) {
    double mean = 0;
    for (int q = 0; q < int(rule.points.size()); ++q)
      mean += rule.weights[q] / 2 * interpolate(pair, c.pressure, {e, rule.points[q]});
    EXPECT_TRUE(std::ranges::any_of(c.multiplier.centres, [&](const ContactCentre& at) {
      return std::abs(at.p - mean) < 1e-9 * c.p_max;
    })) << e;
  }
}

TEST(ContactResults, TheLeastPressureIsFoundBetweenTheNodesToo) {
  const Results r = solved_with("parabola_1.toml", quadratic);
  const ContactPair& pair = r.problem.pairs[0];
  int between = 0;
  for (int run = 0; run < 60; ++run) {
    const ContactResults c = of(r, with_any_pressures(r, run));
    double least = c.p_max;
    for (std::size_t k = 1; k < pair.points.size(); ++k) {
      const ContactPoint &from = pair.points[k - 1], &to = pair.points[k];
      if (from.edge != to.edge) continue;
      for (const double part : {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0})
        least = std::min(least, interpolate(pair, c.pressure, {to.edge, from.xi + part * (to.xi - from.xi)}));
    }
    EXPECT_NEAR(c.p_least, least, 1e-3 * c.p_max);
    between += least < c.pressure.minCoeff() - 1e-2 * c.p_max;
  }
  EXPECT_GT(between, 3);
}

TEST(ContactResults, GapsOpenByHowFarTheBodiesMoveApart) {
  const Results r = solved_with("patch_inclined.toml", {{"contact.initial_gap", "curve"}});
  const ContactPair& pair = r.problem.pairs[0];
  Solution solution = r.solution;
  const Vec2 own(0.3, -0.2), other(-0.1, 0.5);
  for (const Cell& cell : r.problem.mesh.cells)
    for (int i = 0; i < node_count(cell.kind); ++i)
      solution.u.segment<2>(2 * cell.nodes[i]) = cell.body == pair.multiplier.body ? own : other;
  const ContactResults c = of(r, solution);
  for (const ContactSide* side : {&c.multiplier, &c.opposite})
    for (const ContactNode& n : side->nodes)
      if (!std::isnan(n.gap)) EXPECT_NEAR(n.gap, (other - own).dot(n.normal), 1e-9) << n.position;
}

// Without lateral contraction nothing presses the joints of a course: p there is round-off of p in the beds.
TEST(ContactResults, APressureOfRoundOffIsNoContact) {
  const Results r = solved_with("wall.toml", {{"materials.brick.poisson", "0"}});
  for (const ContactResults& c : r.recovery.contacts) {
    const bool joint = c.multiplier.curve.ends_with("left") || c.multiplier.curve.ends_with("right");
    EXPECT_EQ(c.length_in_contact > 0, !joint) << c.multiplier.curve << " " << c.p_max;
  }
}

TEST(ContactResults, TheMeanPressureOfRingsIsTheForceOverTheArea) {
  const Results r = solved_with("patch_flat.toml", {{"model.plane", "axisymmetric"}});
  const ContactResults c = of(r, with_any_pressures(r));
  double area = 0;
  for (const ContactPoint& point : r.problem.pairs[0].points) area += point.dA;
  EXPECT_NEAR(std::abs(c.p_mean) * area, std::abs(c.force.y()), 1e-9 * c.p_max * area);
}

// A hard punch tilts on a base that goes on beyond it and has the multipliers: p of the layer, which is linear, is
// largest at the punch's edge, between two nodes of the base.
TEST(ContactResults, TheLargestPressureOfALayerMayBeWhereTheOtherSideEnds) {
  const test::TemporaryFolder folder;
  folder.write("punch.geo", R"(SetFactory("OpenCASCADE"); Mesh.MeshSizeMax = 1.5; Mesh.ElementOrder = 2;
Rectangle(1) = {-10, -6, 0, 20, 6}; Rectangle(2) = {-4, 0, 0, 8, 4}; a() = Boundary{ Surface{1}; }; b() = Boundary{ Surface{2}; };
Physical Surface("base") = {1}; Physical Surface("punch") = {2}; Physical Curve("ground") = {a(0)};
Physical Curve("top") = {a(2)}; Physical Curve("foot") = {b(0)}; Physical Curve("head") = {b(2)};)");
  const Results r = solve_scene(read_scene(folder.write("scene.toml", R"(mesh.file = "punch.geo"
materials.hard = { young = 1e9, poisson = 0.3 }
bodies = { base = "hard", punch = "hard" }
boundary = [{ on = "ground", displacement = { x = 0, y = 0 } },
  { on = "head", rigid = { x = 0, force = [0, -80], moment = -30, about = [0, 0] } }]
contact = [{ between = ["foot", "top"], stiffness = 10, multipliers_on = "top" }]
)")));
  const ContactResults& c = r.recovery.contacts[0];
  const double exact = 80. / 8 + 6. * 30 / (8 * 8);
  EXPECT_NEAR(c.p_max, exact, 1e-3 * exact);
  EXPECT_NEAR(largest_pressure(r.recovery.contacts)->place.x(), 4, 1e-9);
}

}  // namespace
}  // namespace mortise
