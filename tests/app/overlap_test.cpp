// Bodies drawn into one another: contact however deep the overlap lies below the edges, and no far side of a body.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "app/solve_scene.hpp"
#include "support/patches.hpp"

namespace mortise::test {
namespace {

constexpr double young = 210e9, poisson = 0.3;

// A pair of two bodies of steel, unilateral, with the gap that the mesh has.
Scene pressed_scene(const std::string& first, const std::string& second, const std::string& multipliers_on) {
  Scene s;
  s.path = "test scene";
  s.materials["steel"] = {young, poisson, 0};
  ContactSpec contact;
  contact.key = "contact.0";
  contact.between = {first, second};
  contact.multipliers_on = multipliers_on;
  s.contacts = {contact};
  return s;
}

void hold(Scene& s, std::vector<std::string> on, std::optional<double> x, std::optional<double> y) {
  BoundarySpec b;
  b.key = "boundary";
  b.on = std::move(on);
  b.what = Displacement{x, y};
  s.boundaries.push_back(b);
}

Results solved_on(Scene s, const Mesh& mesh) {
  for (const std::string& body : mesh.bodies) s.bodies.push_back({body, "steel"});
  return solve_scene(s, mesh);
}

class Overlap : public testing::TestWithParam<std::tuple<CellKind, bool>> {
 protected:
  CellKind kind() const { return std::get<0>(GetParam()); }
  std::string side(const char* first, const char* second) const { return std::get<1>(GetParam()) ? second : first; }
};

INSTANTIATE_TEST_SUITE_P(ElementsAndSides, Overlap,
                         testing::Combine(testing::Values(CellKind::quad4, CellKind::quad8), testing::Bool()));

// ---- A taper: two blocks held at their sides, overlapping by 0 to `deep` ----

double taper_force(int n, double deep, CellKind kind, const std::string& side) {
  const auto line = [=](double x) { return 0.5 - deep * x; };
  const Mesh mesh = mesh_of({block(
                                 "lower", n, 6, 0, 1, [](double) { return 0; }, [](double) { return 0.5; }),
                             block("upper", n * 5 / 4, 6, 0, 1, line, [](double) { return 1; })},
                            kind);
  Scene s = pressed_scene("lower_north", "upper_south", side);
  hold(s, {"lower_south", "upper_north"}, {}, 0);
  hold(s, {"lower_west", "lower_east", "upper_west", "upper_east"}, 0, {});
  const Results r = solved_on(s, mesh);
  EXPECT_NEAR(r.recovery.contacts[0].length_in_contact, 1, 0.1) << n;
  return std::abs(r.recovery.contacts[0].force.y());
}

// The problem is linear in the overlap but for the change of the shape, which is 4 % of the height at most.
TEST_P(Overlap, OfATaperTakesTheForceOfAShallowOneOnEveryMesh) {
  const std::string on = side("lower_north", "upper_south");
  const double shallow = 1000 * taper_force(20, 0.00002, kind(), on);
  for (const int n : {20, 80, 200}) EXPECT_NEAR(taper_force(n, 0.02, kind(), on), shallow, 0.03 * shallow) << n;
}

// ---- A press fit: a quarter of two rings, the inner one 2 % too large ----

// Plane strain, ring a < r < b under pressure p inside and q outside (Lame): u(r).
double lame_between(double a, double b, double r, double p, double q) {
  const double d = b * b - a * a, A = (p * a * a - q * b * b) / d, B = (p - q) * a * a * b * b / d;
  return (1 + poisson) / young * ((1 - 2 * poisson) * A * r + B / r);
}

// The force on a radian: the outer ring takes it at r = 1, the inner one at r = 1.02, and both displacements fill the
// overlap.
TEST_P(Overlap, OfAPressFitTakesLamesForceOnEveryMesh) {
  const double opening = lame_between(1, 1.5, 1, 1, 0) - lame_between(0.5, 1.02, 1.02, 0, 1 / 1.02),
               exact = 0.02 / opening;
  for (const int n : {24, 48, 160}) {
    const Mesh mesh = mesh_of(
        {ring("inner", n, 4, {0, 0}, 0.5, 1.02, 90, 0), ring("outer", n * 4 / 3, 4, {0, 0}, 1, 1.5, 90, 0)}, kind());
    Scene s = pressed_scene("inner_north", "outer_south", side("inner_north", "outer_south"));
    hold(s, {"inner_east", "outer_east"}, {}, 0);
    hold(s, {"inner_west", "outer_west"}, 0, {});
    const Vec2 force = solved_on(s, mesh).recovery.contacts[0].force;
    for (const int c : {0, 1}) EXPECT_NEAR(std::abs(force(c)), exact, 0.01 * exact) << n;
  }
}

// ---- Two cylinders on rigid cores, drawn 2 % of a radius into one another ----

TEST_P(Overlap, OfTwoCylindersTakesTheSameForceOnEveryMesh) {
  std::vector<double> forces;
  for (const int n : {40, 80, 320}) {
    const Mesh mesh = mesh_of(
        {ring("lower", n, 8, {0, 0}, 0.5, 1, 115, 65), ring("upper", n * 5 / 4, 8, {0, 1.98}, 0.5, 1, 295, 245)},
        kind());
    Scene s = pressed_scene("lower_north", "upper_north", side("lower_north", "upper_north"));
    hold(s, {"lower_south", "upper_south"}, 0, 0);
    forces.push_back(std::abs(solved_on(s, mesh).recovery.contacts[0].force.y()));
  }
  EXPECT_NEAR(forces[0], forces[2], 0.03 * forces[2]);
  EXPECT_NEAR(forces[1], forces[2], 0.02 * forces[2]);
}

// ---- Far sides ----

struct Facing {
  Mesh mesh;
  std::vector<ContactPair> pairs;
};

Facing facing(const Mesh& mesh, const std::string& first, const std::string& second, const std::string& on) {
  Scene s = pressed_scene(first, second, on);
  for (const std::string& body : mesh.bodies) s.bodies.push_back({body, "steel"});
  return {mesh, couple_pairs(s.method, mesh, discretise(resolve(s, mesh), mesh), contact_curves(s, mesh))};
}

// Their whole outlines are the contact curves, and their edges are longer than both together are thick.
TEST(Overlap, FarSidesOfThinPlatesAreNoContact) {
  for (const double overlap : {0.0, 0.002, 0.004})
    for (const int n : {4, 400})
      for (const char* on : {"lower_all", "upper_all"}) {
        const Mesh mesh =
            mesh_of({block(
                         "lower", n, 1, 0, 1, [](double) { return 0; }, [](double) { return 0.05; }),
                     block(
                         "upper", n, 1, 0, 1, [=](double) { return 0.05 - overlap; }, [](double) { return 0.1; })},
                    CellKind::quad4);
        const Facing f = facing(mesh, "lower_all", "upper_all", on);
        for (const ContactPoint& p : f.pairs[0].points) EXPECT_NEAR(p.gap, -overlap, 1e-12) << n << " " << on;
        EXPECT_NEAR(f.pairs[0].coupling.covered_length, 1, 1e-9);
      }
}

TEST(Overlap, NoneIsSeenThroughABodysOwnSides) {
  // Keys in keyways that clear them. Beside a keyway the shaft's round side has the key's bottom behind it.
  std::mt19937 random(1);
  const auto between = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  for (int draw = 0; draw < 24; ++draw) {
    std::vector<Override> drawn{{"contact.0.multipliers_on", "shaft_side"}};
    const double height = between(6, 14);
    for (const auto& [name, value] : {std::pair("b", between(6, 20)),
                                      {"h", height},
                                      {"depth", between(0.4, 0.7) * height},
                                      {"c", between(0.01, 0.1)},
                                      {"fillet", draw % 3 * between(0.3, 0.5)},
                                      {"size", between(2, 12)}})
      drawn.emplace_back(std::string("mesh.parameters.") + name, std::to_string(value));
    const Problem key = check_scene(read_scene(std::string(MORTISE_SOURCE_DIR) + "/tests/parts/key.toml", drawn));
    for (const ContactPair& pair : key.pairs)
      for (const ContactPoint& point : pair.points)
        ASSERT_GE(point.gap, -1e-9) << "draw " << draw;  // of a shaft of 60: round-off of places is 1e-14
  }
}

TEST(Overlap, OfAPinInAHoleReachesTheNearSideOfTheHole) {
  for (const int n : {16, 200})
    for (const char* on : {"pin_north", "plate_south"}) {
      const Mesh mesh =
          mesh_of({ring("pin", n, 2, {0, 0}, 0.3, 1.02, 360, 0), ring("plate", n * 5 / 4, 2, {0, 0}, 1, 2, 360, 0)},
                  CellKind::quad8);
      const Facing f = facing(mesh, "pin_north", "plate_south", on);
      for (const ContactPoint& p : f.pairs[0].points) EXPECT_NEAR(p.gap, -0.02, 2e-3);
      EXPECT_NEAR(f.pairs[0].coupling.covered_length, 2 * 3.14159 * (on[1] == 'i' ? 1.02 : 1), 1e-3);
    }
}

// ---- Which side carries the multipliers ----

// The lower part of a cylinder in a V, moved down; the V reaches far beyond it and has the shorter edges.
Results in_v_block(const std::string& side) {
  const Mesh mesh =
      mesh_of({ring("cylinder", 128, 6, {0, std::sqrt(2.0)}, 0.5, 1, 330, 210),
               block(
                   "vee", 320, 8, -1.5, 1.5, [](double) { return -1; }, [](double x) { return std::abs(x); })},
              CellKind::quad8);
  Scene s = pressed_scene("cylinder_north", "vee_north", side);
  hold(s, {"vee_south"}, 0, 0);
  hold(s, {"cylinder_south"}, 0, -5e-3);
  return solved_on(s, mesh);
}

TEST(Default, TheCoveredSideCarriesTheMultipliers) {
  const Results r = in_v_block(""), finer = in_v_block("vee_north");
  EXPECT_EQ(r.problem.pairs[0].spec.multipliers_on, "cylinder_north");
  EXPECT_TRUE(r.problem.pairs[0].coupling.dropped.empty());
  EXPECT_FALSE(finer.problem.pairs[0].coupling.dropped.empty());
  const double force = std::abs(finer.recovery.contacts[0].force.y());
  EXPECT_NEAR(std::abs(r.recovery.contacts[0].force.y()), force, 0.02 * force);  // normals of one side or the other
}

// A punch on a block whose edges are shorter: those at the punch's corners would face it with a part of their length.
Results under_a_punch(const std::string& side) {
  const Mesh mesh = mesh_of({block(
                                 "punch", 40, 20, 0, 0.2, [](double) { return 0.2; }, [](double) { return 0.4; }),
                             block(
                                 "block", 230, 30, -0.3, 0.5, [](double) { return -0.2; }, [](double) { return 0.2; })},
                            CellKind::quad8);
  Scene s = pressed_scene("block_north", "punch_south", side);
  hold(s, {"block_south"}, 0, 0);
  hold(s, {"punch_north"}, 0, -1e-5);
  return solved_on(s, mesh);
}

TEST(Default, APunchCarriesTheMultipliers) {
  const Results r = under_a_punch(""), finer = under_a_punch("block_north");
  EXPECT_EQ(r.problem.pairs[0].spec.multipliers_on, "punch_south");
  EXPECT_TRUE(r.problem.pairs[0].coupling.dropped.empty());
  EXPECT_FALSE(finer.problem.pairs[0].coupling.dropped.empty());
}

}  // namespace
}  // namespace mortise::test
