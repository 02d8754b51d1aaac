// Contact between the nodes of a coarse mesh: its pressures are in the bars.
#include "error/missed_contact.hpp"

#include <gtest/gtest.h>

#include <array>
#include <charconv>
#include <cmath>
#include <random>

#include "app/solve_scene.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

std::string text(double value) {
  std::array<char, 32> digits;
  return {digits.data(), std::to_chars(digits.begin(), digits.end(), value).ptr};
}

// A disc of radius 1 over a block, on edges of length `edge` but for `fine` at the lowest point, the first of four
// arcs' ends turned by `turn` from it; its upper half is moved down by `down`.
Results disc(double edge, double fine, double turn, double gap, double down) {
  const TemporaryFolder folder;
  folder.write("a.geo",
               "h = " + text(edge) + "; f = " + text(fine) + "; t = " + text(turn) + "; g = " + text(gap) + R"(;
Mesh.ElementOrder = 2;
Point(1) = {-2, -2, 0, h}; Point(2) = {2, -2, 0, h}; Point(3) = {2, 0, 0, h}; Point(4) = {0.1 * t, 0, 0, f}; Point(5) = {-2, 0, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 1};
Curve Loop(1) = {1 : 5}; Plane Surface(1) = {1};
Point(10) = {0, 1 + g, 0, h};
Point(11) = {Sin(t), 1 + g - Cos(t), 0, f}; Point(12) = {1, 1 + g, 0, h}; Point(13) = {0, 2 + g, 0, h}; Point(14) = {-1, 1 + g, 0, h};
Circle(11) = {11, 10, 12}; Circle(12) = {12, 10, 13}; Circle(13) = {13, 10, 14}; Circle(14) = {14, 10, 11};
Curve Loop(2) = {11 : 14}; Plane Surface(2) = {2};
Physical Surface("block") = {1}; Physical Surface("disc") = {2};
Physical Curve("below") = {14, 11}; Physical Curve("seat") = {3, 4}; Physical Curve("top") = {12, 13}; Physical Curve("foot") = {1};
)");
  Results r = solve_scene(read_scene(folder.write("a.toml", R"(
mesh.file = "a.geo"
materials.one = { young = 1, poisson = 0.3 }
bodies = { block = "one", disc = "one" }
boundary = [ { on = "foot", displacement = { x = 0, y = 0 } }, { on = "top", displacement = { x = 0, y = -)" +
                                                                text(down) + R"( } } ]
contact = [{ between = ["below", "seat"], multipliers_on = "below" }]
)")));
  estimate(r);
  return r;
}

double largest_pressure(const Results& r) { return largest_entry(r.estimate->pressures[0].line.p); }
double norm_of_error(const Results& r) {
  const PressureEstimate& e = r.estimate->pressures[0];
  return std::sqrt(e.local2) + std::sqrt(e.far2);
}
double widest_bar(const Results& r) { return largest_entry(r.estimate->pressures[0].bar); }

TEST(MissedContact, IsInTheBars) {
  std::mt19937 random(4);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  int missed = 0;
  for (int run = 0; run < 16; ++run) {
    SCOPED_TRACE(run);
    const double edge = between(0.5, 0.9), turn = between(-0.25, 0.25), gap = between(0, 0.01),
                 overlap = std::pow(10, between(-7, -2.2)), down = gap + overlap;
    const Results coarse = disc(edge, edge, turn, gap, down);
    const Results fine = disc(0.3, std::sqrt(overlap) / 4, 0, gap, down);
    const double p = largest_pressure(fine);
    ASSERT_GT(p, 0);
    EXPECT_GE(widest_bar(coarse), p - largest_pressure(coarse)) << "gap " << gap << ", down " << down;
    if (largest_pressure(coarse) > 0) continue;
    ++missed;
    EXPECT_GE(norm_of_error(coarse), std::sqrt(fine.estimate->pressures[0].p2)) << "gap " << gap << ", down " << down;
  }
  EXPECT_GE(missed, 3);
}

TEST(MissedContact, IsNoneWhereCurvesStayApart) {
  const Results open = disc(0.7, 0.7, 0.1, 0.01, 0.009);
  EXPECT_EQ(largest_pressure(open), 0);
  EXPECT_EQ(widest_bar(open), 0);
}

// Of bodies that overlaps elsewhere hold a millimetre apart.
TEST(MissedContact, IsWhereOverlapsOfOtherPairsKeepCurvesApart) {
  const Results open = disc(0.7, 0.7, 0.1, 0.01, 0.009);
  const Mesh& mesh = open.problem.mesh;
  VecX of_overlaps = VecX::Zero(open.solution.u.size());
  for (const Cell& cell : mesh.cells)
    if (mesh.bodies[cell.body] == "disc")
      for (int a = 0; a < node_count(cell.kind); ++a) of_overlaps(2 * cell.nodes[a] + 1) = -0.002;
  for (const double part : {0, 1}) {
    std::vector<PressureEstimate> list = open.estimate->pressures;
    add_missed_contact(open.problem, open.solution.u, part * of_overlaps, list);
    const std::vector<LineError::Narrow>& missed = list[0].local.missed_at;
    ASSERT_EQ(missed.size(), part);
    if (part == 1) EXPECT_LE(missed[0].place.norm(), 0.1);
  }
}

// A disc that nothing holds, drawn `below` over a floor and `above` under a ceiling, on edges of 0.7; the floor's foot
// is moved, so that displacements have a size.
Results loose_disc(double below, double above) {
  const TemporaryFolder folder;
  folder.write("a.geo", "b = " + text(below) + "; a = " + text(above) + R"(;
Mesh.ElementOrder = 2; Mesh.MeshSizeMin = 0.7; Mesh.MeshSizeMax = 0.7;
Macro Slab
  p = newp; c = newl;
  Point(p) = {-2, y, 0}; Point(p + 1) = {2, y, 0}; Point(p + 2) = {2, y + 2, 0}; Point(p + 3) = {-2, y + 2, 0};
  Line(c) = {p, p + 1}; Line(c + 1) = {p + 1, p + 2}; Line(c + 2) = {p + 2, p + 3}; Line(c + 3) = {p + 3, p};
  s = news; Curve Loop(s) = {c : c + 3}; Plane Surface(s) = {s};
Return
y = -2;
Call Slab;
Physical Surface("floor") = {s}; Physical Curve("seat") = {c + 2}; Physical Curve("foot") = {c};
y = 2 + a + b;
Call Slab;
Physical Surface("roof") = {s}; Physical Curve("ceiling") = {c}; Physical Curve("top") = {c + 2};
p = newp; c = newl; t = 0.1; m = 1 + b;
Point(p) = {0, m, 0}; Point(p + 1) = {Sin(t), m - Cos(t), 0}; Point(p + 2) = {Cos(t), m + Sin(t), 0};
Point(p + 3) = {-Sin(t), m + Cos(t), 0}; Point(p + 4) = {-Cos(t), m - Sin(t), 0};
Circle(c) = {p + 1, p, p + 2}; Circle(c + 1) = {p + 2, p, p + 3}; Circle(c + 2) = {p + 3, p, p + 4}; Circle(c + 3) = {p + 4, p, p + 1};
s = news; Curve Loop(s) = {c : c + 3}; Plane Surface(s) = {s};
Physical Surface("disc") = {s}; Physical Curve("below") = {c + 3, c}; Physical Curve("above") = {c + 1, c + 2};
)");
  Results r = solve_scene(read_scene(folder.write("a.toml", R"(
mesh.file = "a.geo"
materials.one = { young = 1, poisson = 0.3 }
bodies = { floor = "one", disc = "one", roof = "one" }
boundary = [ { on = "foot", displacement = { x = 0.01, y = 0 } }, { on = "top", displacement = { x = 0, y = 0 } } ]
contact = [
  { between = ["below", "seat"], multipliers_on = "below" },
  { between = ["above", "ceiling"], multipliers_on = "above" } ]
)")));
  estimate(r);
  return r;
}

double bars_of_both(const Results& r) {
  return largest(largest_entry(r.estimate->pressures[0].bar), largest_entry(r.estimate->pressures[1].bar));
}

TEST(MissedContact, IsNoneOfABodyThatHasRoom) {
  const double overlap = 0.001;
  for (const double below : {-0.003, 0.002}) {
    const double squeezed = bars_of_both(loose_disc(below, -overlap - below));
    EXPECT_GT(squeezed, overlap / 10);  // E* d / a
    EXPECT_LE(bars_of_both(loose_disc(below, overlap - below)), 1e-4 * squeezed);
  }
  EXPECT_LE(bars_of_both(loose_disc(0.005, -0.003)), 1e-4 * overlap);
}

}  // namespace
}  // namespace mortise::test
