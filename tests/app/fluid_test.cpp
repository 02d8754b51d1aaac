// Fluid that gets into gaps, from scene to results, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "app/accuracy.hpp"
#include "app/gradients.hpp"
#include "app/solve_scene.hpp"
#include "results/report.hpp"
#include "results/report_text.hpp"
#include "scene/loads.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// Two blocks, one on the other, whose meshes do not match; `half` of the width, `high` each.
std::string blocks(double half, double high, double edge, double finer) {
  std::ostringstream geo;
  geo << "w = " << half << "; h = " << high << "; e = " << edge << "; f = " << finer << R"(;
Point(1) = {0, 0, 0, e}; Point(2) = {w, 0, 0, e}; Point(3) = {w, h, 0, 9*e}; Point(4) = {0, h, 0, 9*e};
Point(5) = {0, 0, 0, f}; Point(6) = {w, 0, 0, f}; Point(7) = {w, -h, 0, 9*e}; Point(8) = {0, -h, 0, 9*e};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1}; Curve Loop(2) = {5 : 8}; Plane Surface(2) = {2};
Mesh.ElementOrder = 2;
Physical Surface("upper") = {1}; Physical Surface("lower") = {2};
Physical Curve("face") = {1}; Physical Curve("seat") = {5}; Physical Curve("top") = {3}; Physical Curve("bottom") = {7};
Physical Curve("left") = {4, 8}; Physical Curve("right") = {2, 6};
)";
  return geo.str();
}

// ---- A wavy surface (Westergaard 1939; Johnson 1985, section 13.2), with fluid in its troughs (Kuznetsov 1985) ----

constexpr double young = 1000, poisson = 0.3, amplitude = 0.01;
const double stiffness = young / (1 - poisson * poisson) / 2, flat = std::numbers::pi * stiffness * amplitude;

struct Wave {
  double edge = 0.02, mean = 10, fluid = 4;
  std::string from = "[0.5, 0]", more = {};
};

Scene scene_of(const TemporaryFolder& folder, const Wave& wave) {
  folder.write("blocks.geo", blocks(0.5, 1.5, wave.edge, 0.7 * wave.edge));
  std::ostringstream text;
  text << "mesh.file = \"blocks.geo\"\nmaterials.m = { young = 1000, poisson = 0.3 }\nbodies = { \"*\" = \"m\" }\n"
       << "[[contact]]\nbetween = [\"face\", \"seat\"]\ninitial_gap = \"0.01 * (1 - cos(2 * pi * x))\"\n";
  if (!wave.from.empty()) text << "fluid = { pressure = " << wave.fluid << ", from = " << wave.from << " }\n";
  text << "[[boundary]]\non = [\"left\", \"right\"]\ndisplacement = { x = 0 }\n"
       << "[[boundary]]\non = \"bottom\"\ndisplacement = { y = 0 }\n"
       << "[[boundary]]\non = \"top\"\npressure = " << wave.mean << "\n"
       << wave.more;
  return read_scene(folder.write("scene.toml", text.str()));
}

// The faces' own pressure under a mean pressure, at x from a crest; wavelength 1.
double westergaard(double mean, double x) {
  const double inside = mean / flat - std::pow(std::sin(std::numbers::pi * x), 2);
  return inside > 0 ? 2 * flat * std::cos(std::numbers::pi * x) * std::sqrt(inside) : 0;
}

double half_width(double mean) { return std::asin(std::sqrt(mean / flat)) / std::numbers::pi; }

double worst_over_bar(const Results& r, double fluid, double mean) {
  double worst = 0;
  for (const ContactNode& n : r.recovery.contacts[0].multiplier.nodes)
    worst = std::max(worst, std::abs(n.p - fluid - westergaard(mean - fluid, n.position.x())) / n.p_error);
  return worst;
}

TEST(Fluid, PressesTheTroughsOfAWaveApart) {
  for (const double edge : {0.04, 0.02, 0.01, 0.005}) {
    const TemporaryFolder folder;
    Results r = solve_scene(scene_of(folder, {.edge = edge}));
    estimate(r);
    const ContactResults& c = r.recovery.contacts[0];
    EXPECT_EQ(r.status, Status::solved);
    EXPECT_LT(worst_over_bar(r, 4, 10), 1) << edge;
    EXPECT_NEAR(c.length_in_contact, half_width(6), 0.3 * edge);
    EXPECT_NEAR(c.fluid->wet_length, 0.5 - half_width(6), edge);
    EXPECT_NEAR(std::abs(c.force.y()), 5, 1e-9);
    EXPECT_NEAR(std::abs(c.fluid->force.y()), 4 * c.fluid->wet_length, 1e-9);
  }
}

TEST(Fluid, LeavesTheBetterReadingOfThePressure) {
  const TemporaryFolder folder;
  Results r = solve_scene(scene_of(folder, {.edge = 0.015}));
  estimate(r);
  double of_p = 0, of_multiplier = 0;
  for (const ContactNode& n : r.recovery.contacts[0].multiplier.nodes) {
    const double exact = 4 + westergaard(6, n.position.x());
    of_p = std::max(of_p, std::abs(n.p - exact));
    of_multiplier = std::max(of_multiplier, std::abs(n.p_multiplier - exact));
  }
  EXPECT_LT(of_p, 0.5 * of_multiplier);
}

TEST(Fluid, IsFoundToAnAccuracy) {
  for (const double pressure : {0.5, 4.0, 8.0}) {
    const TemporaryFolder folder;
    Scene scene = scene_of(folder, {.fluid = pressure});
    scene.accuracy = AccuracySpec{.value = 0.003};
    const Results r = solve_to_accuracy(scene).value();
    EXPECT_EQ(r.status, Status::solved);
    EXPECT_LT(worst_over_bar(r, pressure, 10), 1) << pressure;
    EXPECT_LT(r.problem.mesh.nodes.rows(), 20000) << pressure;
  }
}

TEST(Fluid, AnswersAlikeByEitherSideAndSolver) {
  const TemporaryFolder folder;
  Results one = solve_scene(scene_of(folder, {}));
  estimate(one);
  for (const char* more :
       {"[method]\nsolver = \"feti\"\n", "[method]\nsolver = \"ddm\"\n", "[method]\nmultipliers = \"dual\"\n"}) {
    Results r = solve_scene(scene_of(folder, {.more = more}));
    estimate(r);
    EXPECT_EQ(r.status, Status::solved) << more;
    EXPECT_LT(worst_over_bar(r, 4, 10), 1) << more;
  }
  Scene other = scene_of(folder, {});
  for (const char* side : {"face", "seat"}) {
    other.contacts[0].multipliers_on = side;
    Results r = solve_scene(other);
    estimate(r);
    EXPECT_LT(worst_over_bar(r, 4, 10), 1) << side;
  }
}

// ---- Where it gets and where not ----

TEST(Fluid, GetsNowhereAgainstMorePressure) {
  const TemporaryFolder folder;
  const Results dry = solve_scene(scene_of(folder, {.from = ""}));
  for (const Wave& wave : {Wave{.fluid = 4, .from = "[0, 0]"}, Wave{.fluid = 0}}) {
    const Results r = solve_scene(scene_of(folder, wave));
    EXPECT_EQ(r.solution.u, dry.solution.u) << wave.from;
    EXPECT_EQ(r.solution.lambda, dry.solution.lambda) << wave.from;
    EXPECT_EQ(r.recovery.contacts[0].fluid->wet_length, 0);
  }
}

TEST(Fluid, GetsInFromAllItsPlaces) {
  const TemporaryFolder folder;
  const Results end = solve_scene(scene_of(folder, {})),
                both = solve_scene(scene_of(folder, {.from = "[[0, 0], [0.5, 0]]"})),
                middle = solve_scene(scene_of(folder, {.from = "[0.4, 0.001]"}));
  EXPECT_EQ(both.solution.u, end.solution.u);
  EXPECT_LT((middle.solution.u - end.solution.u).cwiseAbs().maxCoeff(), 1e-9 * end.solution.u.cwiseAbs().maxCoeff());
}

// Of the blocks one above the other each is a bar, without Poisson's ratio.
Scene flange(const TemporaryFolder& folder, double fluid, const std::string& held) {
  folder.write("blocks.geo", blocks(1, 1, 0.1, 0.07));
  return read_scene(folder.write("scene.toml", R"(
mesh.file = "blocks.geo"
materials.m = { young = 1000, poisson = 0 }
bodies = { "*" = "m" }
[[contact]]
between = ["face", "seat"]
initial_gap = "closed"
fluid = { from = [0, 0], pressure = )" + std::to_string(fluid) +
                                                   R"( }
[[boundary]]
on = "left"
displacement = { x = 0 }
[[boundary]]
on = "bottom"
displacement = { y = 0 }
[[body_force]]
body = "upper"
force = [0, -2]
)" + held));
}

// ---- Curves that part: a ring between a floor and a lid, and a groove ----

struct SealRing {
  double radius = 3, x = 0, pressure = 0.004;
  bool from_right = false;
  std::string side = "skin";
};

// The floor and the lid reach 20 radii to each side.
Results solved_ring(const SealRing& ring) {
  const TemporaryFolder folder;
  std::ostringstream geo, text;
  geo << "r = " << ring.radius << "; x = " << ring.x << R"(; W = 20*r; e = 0.01*r; f = 0.12*r;
Point(1) = {x, r, 0}; Point(2) = {x, 0, 0, e}; Point(3) = {x + r, r, 0, f}; Point(4) = {x, 2*r, 0, e}; Point(5) = {x - r, r, 0, f};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 4}; Circle(3) = {4, 1, 5}; Circle(4) = {5, 1, 2};
q = 0.6*r; Point(6) = {x, r - q, 0, f}; Point(7) = {x + q, r, 0, f}; Point(8) = {x, r + q, 0, f}; Point(9) = {x - q, r, 0, f};
Circle(5) = {6, 1, 7}; Circle(6) = {7, 1, 8}; Circle(7) = {8, 1, 9}; Circle(8) = {9, 1, 6};
Curve Loop(1) = {1 : 4}; Curve Loop(2) = {5 : 8}; Plane Surface(1) = {1, 2};
Point(11) = {-W, -r, 0, r}; Point(12) = {W, -r, 0, r}; Point(13) = {W, 0, 0, r}; Point(14) = {x, 0, 0, e}; Point(15) = {-W, 0, 0, r};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 15}; Line(15) = {15, 11};
Curve Loop(3) = {11 : 15}; Plane Surface(2) = {3};
Point(21) = {-W, 2*r, 0, r}; Point(22) = {x, 2*r, 0, e}; Point(23) = {W, 2*r, 0, r}; Point(24) = {W, 3*r, 0, r}; Point(25) = {-W, 3*r, 0, r};
Line(21) = {21, 22}; Line(22) = {22, 23}; Line(23) = {23, 24}; Line(24) = {24, 25}; Line(25) = {25, 21};
Curve Loop(4) = {21 : 25}; Plane Surface(3) = {4};
Mesh.ElementOrder = 2;
Physical Surface("ring") = {1}; Physical Surface("floor") = {2}; Physical Surface("lid") = {3};
Physical Curve("skin") = {1 : 4}; Physical Curve("bore") = {5 : 8}; Physical Curve("seat") = {13, 14};
Physical Curve("bottom") = {11}; Physical Curve("under") = {21, 22}; Physical Curve("top") = {24};
)";
  folder.write("ring.geo", geo.str());
  const double from = ring.x + (ring.from_right ? 0.7 : -0.7) * ring.radius;
  text << R"(mesh.file = "ring.geo"
materials = { steel = { young = 210000, poisson = 0.3 }, rubber = { young = 9, poisson = 0.4 } }
bodies = { ring = "rubber", floor = "steel", lid = "steel" }
boundary = [{ on = "bottom", displacement = { x = 0, y = 0 } }, { on = "bore", displacement = { x = 0 } },
            { on = "top", displacement = { x = 0, y = )"
       << -0.01 * ring.radius << R"( } }]
contact = [{ between = ["skin", "seat"], multipliers_on = ")"
       << ring.side << "\", fluid = { pressure = " << ring.pressure << ", from = [" << from << ", " << 0.2 * ring.radius
       << "] } }, { between = [\"skin\", \"under\"] }]\n";
  return solve_scene(read_scene(folder.write("ring.toml", text.str())));
}

// Of a floor that is long it meets the ring's normals nearly to where these are level.
TEST(Fluid, StopsAtContactOfARingWhicheverSideHasTheMultipliers) {
  std::mt19937 random(3);
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int i = 0; i < 4; ++i) {
    SealRing ring{.radius = draw(1, 5), .pressure = draw(0.001, 0.006), .from_right = i % 2 == 1};
    ring.x = draw(-2, 2) * ring.radius;
    SCOPED_TRACE(std::to_string(i) + ", radius " + std::to_string(ring.radius) + ", " + std::to_string(ring.pressure));
    const Results of_ring = solved_ring(ring);
    ring.side = "seat";
    const Results of_seat = solved_ring(ring);
    for (const Results* r : {&of_ring, &of_seat}) {
      EXPECT_EQ(r->status, Status::solved);
      for (const ContactNode& n : r->recovery.contacts[0].multiplier.nodes)
        if (n.p_fluid > 0) EXPECT_EQ(n.position.x() > ring.x, ring.from_right);
    }
    const ContactResults &a = of_ring.recovery.contacts[0], &b = of_seat.recovery.contacts[0];
    const double pushed = ring.pressure * ring.radius;  // by the fluid, either way
    EXPECT_NEAR(a.fluid->force.y(), -b.fluid->force.y(), 0.01 * pushed);
    EXPECT_NEAR(a.fluid->force.y(), pushed, 0.05 * pushed);
    EXPECT_NEAR(a.fluid->force.x() * (ring.from_right ? -1 : 1), pushed, 0.1 * pushed);
    // On either body, whichever side tells it.
    EXPECT_LT((a.fluid->force - (b.fluid->besides.force - b.fluid->force)).norm(), 0.05 * pushed);
    EXPECT_LT((b.fluid->force - (a.fluid->besides.force - a.fluid->force)).norm(), 0.05 * pushed);
    const double far = 20 * ring.radius + (ring.from_right ? -ring.x : ring.x),
                 front = std::atan(far / ring.radius) - a.fluid->wet_length / ring.radius;  // angle
    EXPECT_NEAR(std::sin(front), 1 - b.fluid->wet_length / ring.radius, 0.02);
    EXPECT_NEAR(a.p_max, b.p_max, 0.03 * a.p_max);  // whose normals count, on the undeformed ring
    EXPECT_NEAR(a.length_in_contact, b.length_in_contact, 0.05 * a.length_in_contact);
    for (const std::size_t support : {0, 1, 2})
      EXPECT_LT((of_ring.recovery.reactions.entries[support].force - of_seat.recovery.reactions.entries[support].force)
                    .norm(),
                0.03 * pushed);
  }
}

const std::string springs = "[[boundary]]\non = \"top\"\nfoundation = 10\n";

TEST(Fluid, LiftsAFlangeOffItsSeat) {
  const double p = 3, load = 2, k = 10;
  const TemporaryFolder folder;
  const Results r = solve_scene(flange(folder, p, springs));
  const ContactResults& c = r.recovery.contacts[0];
  EXPECT_EQ(r.status, Status::solved);
  EXPECT_NEAR(c.fluid->wet_length, 1, 1e-12);
  EXPECT_NEAR(std::abs(c.force.y()), p, 1e-9);
  EXPECT_NEAR(std::abs(c.fluid->force.y()), p, 1e-9);
  EXPECT_EQ(c.length_in_contact, 0);
  for (const ContactNode& n : c.multiplier.nodes) {
    EXPECT_NEAR(n.p, p, 1e-9);
    EXPECT_NEAR(n.p_fluid, p, 1e-9);
    EXPECT_NEAR(n.gap, (p - load) / k + (p - load / 2) / young + p / young, 1e-9);
  }
  expect_contains(report_text(report_of(r), {}), "gap closed, fluid at 3, ");
  expect_contains(report_text(report_of(r), {}), "fluid at 3 has wet 1; of the force it makes (0, ");
}

// Its walls face nothing; the seat leads on under it.
TEST(Fluid, GetsAcrossAGroove) {
  const TemporaryFolder folder;
  folder.write("groove.geo", R"(e = 0.05;
Point(1) = {0, 0, 0, e}; Point(2) = {0.4, 0, 0, e}; Point(3) = {0.4, 0.3, 0, e}; Point(4) = {0.6, 0.3, 0, e};
Point(5) = {0.6, 0, 0, e}; Point(6) = {1, 0, 0, e}; Point(7) = {1, 1, 0, e}; Point(8) = {0, 1, 0, e};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 7};
Line(7) = {7, 8}; Line(8) = {8, 1}; Curve Loop(1) = {1 : 8}; Plane Surface(1) = {1};
Point(11) = {0, 0, 0, e}; Point(12) = {1, 0, 0, e}; Point(13) = {1, -1, 0, e}; Point(14) = {0, -1, 0, e};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(2) = {11 : 14}; Plane Surface(2) = {2}; Mesh.ElementOrder = 2;
Physical Surface("upper") = {1}; Physical Surface("lower") = {2};
Physical Curve("face") = {1 : 5}; Physical Curve("seat") = {11}; Physical Curve("top") = {7};
Physical Curve("bottom") = {13}; Physical Curve("left") = {8, 14};
)");
  for (const char* side : {"face", "seat"}) {
    SCOPED_TRACE(side);
    const Results r = solve_scene(read_scene(folder.write("scene.toml", R"(mesh.file = "groove.geo"
materials.m = { young = 1000, poisson = 0 }
bodies = { "*" = "m" }
contact = [{ between = ["face", "seat"], fluid = { from = [0, 0], pressure = 3 }, multipliers_on = ")" +
                                                                            std::string(side) + R"(" }]
boundary = [{ on = "left", displacement = { x = 0 } }, { on = "bottom", displacement = { y = 0 } },
            { on = "top", foundation = 10 }, { on = "top", pressure = 2 }]
)")));
    EXPECT_EQ(r.status, Status::solved);
    EXPECT_NEAR(r.recovery.contacts[0].fluid->wet_length, 1, 1e-9);
    EXPECT_NEAR(std::abs(r.recovery.contacts[0].fluid->force.y()), 3, 1e-9);
    EXPECT_NEAR(r.recovery.contacts[0].length_in_contact, 0, 1e-9);
    EXPECT_NEAR(r.recovery.reactions.entries[1].force.y(), 3, 1e-9);  // of the seat, which is wet all along
  }
}

TEST(Fluid, SaysWhatItBlowsAway) {
  const TemporaryFolder folder;
  EXPECT_EQ(solve_scene(flange(folder, 1.99, "")).status, Status::solved);
  expect_contains(message_of([&] { solve_scene(flange(folder, 2.01, "")); }), "nothing holds body 'upper'");
}

// ---- Loads, and what is refused ----

// A block that nothing holds sideways, on a floor that carries the multipliers; one half of its foot rises by h. Drawn
// at an angle, that motion is along no axis.
TEST(Fluid, PushesABodyThatNothingHolds) {
  for (const double angle : {0., 0.5, 1.1, 2.3})
    for (const double height : {0.02, 0.3}) {
      std::ostringstream geo;
      geo << "a = " << angle << "; h = " << height << R"(;
Point(1) = {-2, 0, 0}; Point(2) = {0, 0, 0}; Point(3) = {2, h, 0}; Point(4) = {2, 3, 0}; Point(5) = {-2, 3, 0};
Point(11) = {-6, -4, 0}; Point(12) = {6, -4, 0}; Point(13) = {6, 0, 0}; Point(14) = {-6, 0, 0};
Rotate{{0, 0, 1}, {0, 0, 0}, a}{ Point{1:5, 11:14}; }
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 1};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(1) = {1:5}; Plane Surface(1) = {1}; Curve Loop(2) = {11:14}; Plane Surface(2) = {2};
MeshSize{:} = 0.5; Mesh.ElementOrder = 2; Physical Surface("block") = {1}; Physical Surface("floor") = {2};
Physical Curve("foot") = {1, 2}; Physical Curve("head") = {4}; Physical Curve("top") = {13}; Physical Curve("base") = {11};
)";
      const TemporaryFolder folder;
      folder.write("a.geo", geo.str());
      std::ostringstream text;
      text << "mesh.file = \"a.geo\"\nmaterials.m = { young = 1000, poisson = 0.3 }\n"
           << "bodies = { block = \"m\", floor = \"m\" }\n"
           << "boundary = [{ on = \"base\", displacement = { x = 0, y = 0 } },\n{ on = \"head\", rigid = { rotation = "
              "0, "
           << "force = [" << 4 * std::sin(angle) << ", " << -4 * std::cos(angle) << "] } }]\n[[contact]]\nbetween = "
           << "[\"foot\", \"top\"]\nmultipliers_on = \"top\"\nfluid = { pressure = 0.3, from = [" << 2 * std::cos(angle)
           << ", " << 2 * std::sin(angle) << "] }\n";
      const std::string scene = folder.write("a.toml", text.str());
      expect_contains(message_of([&] { solve_scene(read_scene(scene)); }), "nothing holds body 'block'");
    }
}

TEST(Fluid, IsALoadAmongCases) {
  const TemporaryFolder folder;
  const Scene scene = scene_of(folder, {});
  CaseSolver solver;
  for (const double factor : {1.0, 0.5, 0.0, 1.2}) {
    Scene scaled = scaled_loads(scene, factor);
    EXPECT_DOUBLE_EQ(scaled.contacts[0].fluid->pressure, 4 * factor);
    scaled.contacts[0].fluid->pressure *= 1.1;
    const Results& shared = solver.solve(scaled);
    const Results alone = solve_scene(scaled);
    const double size = std::max(alone.solution.u.cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((shared.solution.u - alone.solution.u).cwiseAbs().maxCoeff(), 1e-12 * size) << factor;
    EXPECT_EQ(shared.recovery.contacts[0].fluid->wet_length, alone.recovery.contacts[0].fluid->wet_length) << factor;
  }
  EXPECT_EQ(solver.shared(), 3);
}

std::string refused(const std::string& pair) {
  const TemporaryFolder folder;
  folder.write("blocks.geo", blocks(1, 1, 0.5, 0.5));
  return message_of([&] {
    solve_scene(read_scene(folder.write("scene.toml",
                                        "mesh.file = \"blocks.geo\"\nmaterials.m = { young = 1, poisson = 0 "
                                        "}\nbodies = { \"*\" = \"m\" }\n[[contact]]\nbetween = [\"face\", "
                                        "\"seat\"]\n" +
                                            pair + "\n" + springs +
                                            "[[boundary]]\non = \"bottom\"\ndisplacement = { x = 0, y = 0 }\n")));
  });
}

TEST(Fluid, RefusesWhatHasNoGap) {
  expect_contains(refused("condition = \"tied\"\nfluid = { pressure = 1, from = [0, 0] }"),
                  "fluid: has no meaning with");
  expect_contains(refused("condition = \"bilateral\"\nfluid = { pressure = 1, from = [0, 0] }"),
                  "fluid: goes with condition = \"unilateral\"");
  expect_contains(refused("fluid = { pressure = -1, from = [0, 0] }"), "pressure: expected a number >= 0, found -1");
  expect_contains(refused("fluid = { pressure = 1 }"), "from");
  expect_contains(refused("fluid = { pressure = 1, from = \"left\" }"), "from: expected a list of two numbers [x, y]");
  expect_contains(refused("fluid = { pressure = 1, from = [0, 0], to = 1 }"), "to");
  expect_contains(refused("fluid = { pressure = 1, from = [0, 7] }"),
                  "fluid.from: (0, 7) lies 7 from 'face', more than that is long, 1; expected a place on the curve");
}

TEST(Fluid, RefusesGradientsAndPatterns) {
  const TemporaryFolder folder;
  const Scene scene = scene_of(folder, {});
  const Results r = solve_scene(scene);
  expect_contains(message_of([&] {
                    gradients(r, scene.path, {}, {{"contact.0.p_max"}}, {{"boundary.2.pressure", 10}});
                  }),
                  "gradients where a fluid gets into a gap are not known");
  Scene found = scene;
  expect_contains(message_of([&] {
                    read_scene(scene.path, {{"contact.0.between", "[\"fac*\", \"seat\"]"}});
                  }),
                  "fluid: goes with between = two curves");
}

}  // namespace
}  // namespace mortise::test
