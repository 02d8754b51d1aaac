// Faces of a crack: two contact curves of one body that share its tips.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

#include "app/accuracy.hpp"
#include "app/solve_scene.hpp"
#include "base/printable.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

struct Crack {
  double half_width = 2, angle = 0, x = 0, y = 0;  // of the plate; of the crack of half length 1, degrees, its centre
  bool edge = false;                               // its first end lies on the plate's left side
  bool two = false;                                // bodies, which are bonded where there is no crack
  double open = 0;                                 // how far its upper face, a parabola, is drawn from the lower one
  int order = 2;
  double size = 0.1;  // of the edges along it
};

// A square plate cut in two along the crack's line, the crack drawn twice between the same tips.
std::string geo_of(const Crack& c) {
  std::ostringstream geo;
  geo << "W = " << c.half_width << "; a = Pi / 180 * " << c.angle << "; x = " << c.x << "; y = " << c.y
      << "; h = " << c.size << "; edge = " << c.edge << "; two = " << c.two << "; open = " << c.open << ";\n"
      << R"(Point(1) = {-W, -W, 0, W / 5}; Point(2) = {W, -W, 0, W / 5}; Point(3) = {W, y + (W - x) * Tan(a), 0, W / 5};
Point(4) = {W, W, 0, W / 5}; Point(5) = {-W, W, 0, W / 5}; Point(6) = {-W, y - (W + x) * Tan(a), 0, edge ? h : W / 5};
Point(8) = {x + Cos(a), y + Sin(a), 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(8) = {8, 3};
If (edge)
  Point(7) = {-W, y - (W + x) * Tan(a), 0, h};
  Line(5) = {5, 6}; Line(6) = {7, 1}; Line(9) = {7, 8}; Line(10) = {6, 8};
  Curve Loop(1) = {1, 2, -8, -9, 6}; Curve Loop(2) = {3, 4, 5, 10, 8};
Else
  Point(7) = {x - Cos(a), y - Sin(a), 0, h};
  Line(5) = {5, 6}; Line(6) = {6, 1}; Line(7) = {6, 7}; Line(9) = {7, 8}; Point(9) = {x - 2 * open * Sin(a), y + 2 * open * Cos(a), 0};
  If (open > 0)
    BSpline(10) = {7, 9, 8};
  Else
    Line(10) = {7, 8};
  EndIf
  Curve Loop(1) = {1, 2, -8, -9, -7, 6}; Curve Loop(2) = {3, 4, 5, 7, 10, 8};
EndIf
Plane Surface(1) = {1}; Plane Surface(2) = {2};
MeshSize{ 8 } = h;
If (two)
  Physical Surface("half_0") = {1}; Physical Surface("half_1") = {2};
Else
  Physical Surface("half_0") = {1, 2};
EndIf
Physical Curve("lower") = {9}; Physical Curve("upper") = {10};
Physical Curve("bottom") = {1}; Physical Curve("right") = {2, 3}; Physical Curve("top") = {4}; Physical Curve("left") = {5, 6};
Physical Point("one") = {1}; Physical Point("other") = {2};
Mesh.SecondOrderIncomplete = 1; Mesh.ElementOrder = )"
      << c.order << ";\n";
  return geo.str();
}

Results solved(const Crack& crack, const std::string& loads, const std::vector<Override>& overrides = {}) {
  const TemporaryFolder folder;
  folder.write("crack.geo", geo_of(crack));
  const std::string scene = folder.write("crack.toml", R"(mesh.file = "crack.geo"
materials.one = { young = 1000, poisson = 0.3 }
bodies."half_*" = "one"
contact = [{ between = ["upper", "lower"] }]
boundary = [{ on = "one", displacement = { x = 0, y = 0 } }, { on = "other", displacement = { y = 0 } }, )" +
                                                           loads + "]\n");
  const Scene read = read_scene(scene, overrides);
  return read.accuracy ? *solve_to_accuracy(read, {}, {}) : solve_scene(read);
}

TEST(Cracks, UnderEqualPressureAllRoundPressAsIfThereWereNone) {
  std::mt19937 random(17);
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const std::array spaces{"linear", "quadratic", "dual"};
  for (int i = 0; i < 24; ++i) {
    const Crack crack{.angle = draw(-35, 35),
                      .x = draw(-0.5, 0.5),
                      .y = draw(-0.5, 0.5),
                      .edge = i % 3 == 0,
                      .two = i % 4 > 1,
                      .order = 1 + i % 2,
                      .size = draw(0.05, 0.4)};
    const std::string space = spaces[crack.order == 1 ? 2 * (random() % 2) : random() % 3],
                      side = random() % 2 ? "upper" : "lower";
    SCOPED_TRACE(std::to_string(i) + ", " + space + " on " + side);
    const Results r =
        solved(crack, R"({ on = ["bottom", "right", "top", "left"], pressure = 2 })",
               {{"method.multipliers", '"' + space + '"'}, {"contact.0.multipliers_on", '"' + side + '"'}});
    EXPECT_EQ(r.status, Status::solved);
    EXPECT_EQ(r.warnings.size(), space == "linear" && crack.order == 2 ? 0 : 1);
    const ContactResults& c = r.recovery.contacts[0];
    EXPECT_LE((c.pressure.array() - 2).abs().maxCoeff(), 1e-8);
    EXPECT_NEAR(c.force.norm(), 2 * c.length, 1e-8);
  }
}

// A crack that lies aslant in a plate slides, pressed as if it were not there: by sigma = -(1 + c x) across the plate,
// pulled by q along it. However short the edges are at its tips, p_h swings there, and is zero at some of their
// vertices.
TEST(Cracks, ThatSlidePressUpToTheirTipsAsIfThereWereNone) {
  std::mt19937 random(39);
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const std::array asked{"0.05", "0.02", "0.01", "0.005"};
  int nodes = 0, outside = 0, solves = 0, smoother = 0;
  for (int k = 0; k < 20; ++k) {
    const bool steep = k % 2;
    const Crack crack{.half_width = 60, .angle = draw(steep ? 36 : 10, 42), .x = draw(-3, 3), .y = draw(-3, 3)};
    const double angle = std::numbers::pi / 180 * crack.angle, c = draw(-0.1, 0.1),
                 q = draw(steep ? 0.5 : 0, std::min(1.0, 0.5 * std::pow(std::tan(angle), -2)));
    SCOPED_TRACE(worded(k, ": ", crack.angle, ", ", c, ", ", q));
    const std::string loads = worded(R"({ on = ["bottom", "top"], pressure = "1 + )", c, R"( * x" },
                                       { on = ["left", "right"], pressure = )",
                                     -q, " }");
    const Results r =
        solved(crack, loads,
               {{"accuracy.value", asked[k % 4]}, {"accuracy.first_edges", std::to_string(5 * (1 + random() % 8))}});
    EXPECT_EQ(r.status, Status::solved) << r.accuracy->reason;
    solves += int(r.accuracy->solves.size());
    double off = 0, swing = 0;
    for (const ContactNode& node : r.recovery.contacts[0].multiplier.nodes) {
      const double exact =
          std::pow(std::cos(angle), 2) * (1 + c * node.position.x()) - q * std::pow(std::sin(angle), 2);
      ++nodes;
      outside += std::abs(node.p - exact) > std::max(node.p_error, 1e-3);  // the plate is 60 cracks wide
      off = std::max(off, std::abs(node.p - exact));
      swing = std::max(swing, std::abs(node.p_multiplier - exact));
    }
    smoother += off <= 0.1 * swing;
    const auto& singular = r.estimate->pressures[0].singular;
    ASSERT_EQ(singular.size(), 2u);
    for (const SingularPoint& tip : singular) {
      EXPECT_EQ(tip.exponent, 0.5);
      EXPECT_FALSE(tip.is_unbounded());
    }
  }
  EXPECT_LE(outside, 0.05 * nodes);
  EXPECT_GE(smoother, 16);
  EXPECT_LE(solves, 75);
}

// A crack that is a parabola apart and closed by sigma: p = sigma - E' d / 2 pi (2 - x ln((1 + x) / (1 - x))) in a
// plate without end, the stress of edge dislocations of density 2 d x. p has no limit at its tips.
TEST(Cracks, ThatWereApartPressAsAWedgeAtTheirTips) {
  const double d = 1.5e-3, modulus = 1000 / (1 - 0.3 * 0.3);
  for (const bool drawn : {true, false}) {
    SCOPED_TRACE(drawn);
    std::vector<Override> overrides{{"accuracy.value", "0.005"}};
    if (!drawn) overrides.push_back({"contact.0.clearance", '"' + std::to_string(d) + " * (1 - x^2)\""});
    const Results r =
        solved({.half_width = 60, .open = drawn ? d : 0}, R"({ on = ["bottom", "top"], pressure = 1 })", overrides);
    EXPECT_EQ(r.status, Status::solved) << r.accuracy->reason;
    const PressureEstimate& estimate = r.estimate->pressures[0];
    ASSERT_EQ(estimate.singular.size(), 2u);
    for (const SingularPoint& tip : estimate.singular) EXPECT_TRUE(tip.is_unbounded());
    for (Eigen::Index i = 0; i < estimate.line.p.size(); ++i) {
      if (!estimate.counts(i)) continue;
      const double x = estimate.line.position[i].x(),
                   exact = 1 - modulus * d / (2 * std::numbers::pi) * (2 - x * std::log((1 + x) / (1 - x)));
      EXPECT_NEAR(estimate.line.whole(i), exact, estimate.bar(i) + 1e-3) << x;
    }
  }
}

// Of two blocks that are tied beside the crack: each tie ends at a tip, which is a node of either block.
TEST(Cracks, BetweenTiedSeamsPressAsIfThereWereNone) {
  std::mt19937 random(29);
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int i = 0; i < 16; ++i) {
    const TemporaryFolder folder;
    std::ostringstream geo;
    geo << "a = " << draw(-0.6, -0.2) << "; b = " << draw(0.1, 0.7) << "; e = " << draw(0.05, 0.3)
        << "; f = " << (i % 3 == 0 ? "e" : "0.7 * e") << "; Mesh.RecombineAll = " << i / 2 % 2
        << "; Mesh.ElementOrder = " << 1 + i % 2 << R"(; Mesh.SecondOrderIncomplete = 1;
Point(1) = {-1, 0, 0, e}; Point(2) = {a, 0, 0, e}; Point(3) = {b, 0, 0, e}; Point(4) = {1, 0, 0, e}; Point(5) = {1, 1, 0, e}; Point(6) = {-1, 1, 0, e};
Point(11) = {-1, 0, 0, f}; Point(12) = {a, 0, 0, f}; Point(13) = {b, 0, 0, f}; Point(14) = {1, 0, 0, f}; Point(15) = {1, -1, 0, f}; Point(16) = {-1, -1, 0, f};
For k In {1 : 5}
  Line(k) = {k, k + 1}; Line(10 + k) = {10 + k, 11 + k};
EndFor
Line(6) = {6, 1}; Line(16) = {16, 11}; Curve Loop(1) = {1 : 6}; Curve Loop(2) = {11 : 16}; Plane Surface(1) = {1}; Plane Surface(2) = {2};
Physical Surface("one") = {1}; Physical Surface("other") = {2};
Physical Curve("upper_left") = {1}; Physical Curve("upper") = {2}; Physical Curve("upper_right") = {3};
Physical Curve("lower_left") = {11}; Physical Curve("lower") = {12}; Physical Curve("lower_right") = {13};
Physical Curve("top") = {5}; Physical Curve("bottom") = {15}; Physical Curve("side") = {6, 16};
)";
    folder.write("seams.geo", geo.str());
    const std::string side = i / 4 % 2 ? "upper" : "lower", space = i % 4 == 3   ? "dual"
                                                                    : i % 4 == 1 ? "quadratic"
                                                                                 : "linear";
    SCOPED_TRACE(std::to_string(i) + ", " + space + " on " + side);
    const Results r = solve_scene(read_scene(folder.write("seams.toml", R"(mesh.file = "seams.geo"
materials.m = { young = 1000, poisson = 0.3 }
bodies."*" = "m"
boundary = [{ on = "bottom", displacement = { y = 0 } }, { on = "side", displacement = { x = 0 } },
            { on = "top", pressure = 2 }]
contact = [{ between = ["upper", "lower"], multipliers_on = ")" + side + R"(" },
           { between = ["upper_left", "lower_left"], condition = "tied" },
           { between = ["upper_right", "lower_right"], condition = "tied" }]
method.multipliers = ")" + space + "\"\n")));
    EXPECT_EQ(r.status, Status::solved);
    EXPECT_LE((r.recovery.contacts[0].pressure.array() - 2).abs().maxCoeff(), 1e-8);
  }
}

// Inner crack of half length 1 in a plate that is large under stress s (x0 - x) across it: by Westergaard's function it
// is open up to b, where the stress intensity of the open part vanishes, and pressed by p beyond.
TEST(Cracks, ThatCloseInPartEndWhereTheyOpenWithoutStressIntensity) {
  for (const int order : {1, 2})
    for (const double x0 : {-0.2, 0.1, 0.4}) {
      SCOPED_TRACE(std::to_string(order) + ", " + std::to_string(x0));
      const std::string place = std::to_string(x0) + " - x";
      const Results r = solved({.half_width = 120, .order = order},
                               "{ on = \"top\", traction = [0, \"" + place +
                                   "\"] }, { on = \"bottom\", traction = [0, \"-(" + place + ")\"] }",
                               {{"accuracy.value", order == 1 ? "0.02" : "0.003"}});
      EXPECT_EQ(r.status, Status::solved);
      const double b = (1 + 4 * x0) / 3, half = (1 + b) / 2, centre = (b - 1) / 2;
      const auto exact = [&](double x) {
        const double t = (x - centre) / half;
        return t > 1 ? half * (t + 0.5) * std::sqrt((t - 1) / (t + 1)) : 0;
      };
      const ContactResults& c = r.recovery.contacts[0];
      double off = 0, size = 0;
      for (std::size_t i = 1; i < c.multiplier.nodes.size(); ++i) {
        const ContactNode& node = c.multiplier.nodes[i];
        const double length = node.s - c.multiplier.nodes[i - 1].s;
        off += length * std::pow(node.p - exact(node.position.x()), 2);
        size += length * std::pow(exact(node.position.x()), 2);
      }
      EXPECT_LE(std::sqrt(off / size), order == 1 ? 0.022 : 0.005);
      EXPECT_NEAR(c.length_in_contact, 1 - b, order == 1 ? 0.05 : 0.003);
    }
}

}  // namespace
}  // namespace mortise::test
