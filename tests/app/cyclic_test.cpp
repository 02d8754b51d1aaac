// Sectors of bodies with rotational symmetry, tied to themselves turned about the origin.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

#include "app/solve_scene.hpp"
#include "contact/multiplier_rows.hpp"
#include "results/error_report.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// A ring of radii 1 and 3 cut into `sectors` along waves, with meshes that do not match on both cuts.
struct Ring {
  int sectors = 6, low = 12, high = 17, order = 2;
  double wave = 0.15, twist = 0.1, size = 0.15;  // radians, the cut's outer end before its inner one; length
  std::string follows = "low";
};

std::string geo_of(const Ring& ring) {
  std::ostringstream geo;
  geo << "a = 2 * Pi / " << ring.sectors << "; w = " << ring.wave << "; s = " << ring.twist << "; h = " << ring.size
      << R"(;
Point(1) = {0, 0, 0};
For k In {0 : 1}
  Point(10 + k) = {Cos(k * a), Sin(k * a), 0, h};
  Point(20 + k) = {1.6 * Cos(k * a + w), 1.6 * Sin(k * a + w), 0, h};
  Point(30 + k) = {2.3 * Cos(k * a - w), 2.3 * Sin(k * a - w), 0, h};
  Point(40 + k) = {3 * Cos(k * a + s), 3 * Sin(k * a + s), 0, h};
  Spline(10 + k) = {10 + k, 20 + k, 30 + k, 40 + k};
EndFor
Point(50) = {Cos(a / 2), Sin(a / 2), 0, h}; Point(51) = {3 * Cos(a / 2 + s), 3 * Sin(a / 2 + s), 0, h};
Circle(1) = {10, 1, 50}; Circle(2) = {50, 1, 11}; Circle(3) = {40, 1, 51}; Circle(4) = {51, 1, 41};
Curve Loop(1) = {10, 3, 4, -11, -2, -1}; Plane Surface(1) = {1};
Transfinite Curve{10} = )"
      << ring.low << "; Transfinite Curve{11} = " << ring.high << R"(;
Physical Surface("ring") = {1}; Physical Curve("low") = {10}; Physical Curve("high") = {11};
Physical Curve("bore") = {1, 2}; Physical Curve("rim") = {3, 4};
Mesh.SecondOrderIncomplete = 1; Mesh.ElementOrder = )"
      << ring.order << ";\n";
  return geo.str();
}

Results solved(const Ring& ring, const std::string& entries) {
  const TemporaryFolder folder;
  folder.write("ring.geo", geo_of(ring));
  return solve_scene(read_scene(folder.write("ring.toml", R"(mesh.file = "ring.geo"
materials.one = { young = 1000, poisson = 0.3 }
bodies.ring = "one"
contact = [{ between = ["low", "high"], condition = "cyclic", multipliers_on = ")" +
                                                              ring.follows + "\" }]\n" + entries)));
}

// Radial and tangential stress of the ring that turns, in plane strain, its bore under pressure 2.
Vec2 exact_stress(double r) {
  const double nu = 0.3 / 0.7, c = (3 + nu) / 8, lame = 2.0 / 8;
  return {c * (10 - 9 / (r * r) - r * r) + lame * (1 - 9 / (r * r)),
          c * (10 + 9 / (r * r) - (1 + 3 * nu) / (3 + nu) * r * r) + lame * (1 + 9 / (r * r))};
}

TEST(CyclicSymmetry, ARingThatTurnsIsStressedAsIfItWereWhole) {
  std::mt19937 random(23);
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int i = 0; i < 16; ++i) {
    const Ring ring{.sectors = int(draw(2, 16)),
                    .low = int(draw(14, 30)),
                    .high = int(draw(14, 30)),
                    .order = 1 + i % 2,
                    .wave = draw(-0.2, 0.2),
                    .twist = draw(-0.1, 0.1),
                    .size = draw(0.08, 0.16),
                    .follows = random() % 2 ? "low" : "high"};
    SCOPED_TRACE(std::to_string(ring.sectors) + " sectors, " + std::to_string(ring.low) + ":" +
                 std::to_string(ring.high));
    const Results r = solved(ring, R"(boundary = [{ on = "bore", pressure = 2 }]
body_force = [{ body = "ring", force = ["x", "y"] }]
)");
    EXPECT_EQ(r.status, Status::solved);
    const double whole = std::numbers::pi * 2 / ring.sectors;
    const Eigen::Rotation2Dd turn((r.problem.mesh.ties[0].curves[0] == "low" ? -1 : 1) * whole);
    EXPECT_LE((r.problem.mesh.ties[0].turn - turn.toRotationMatrix()).norm(), 1e-12);
    double off = 0, size = 0;
    for (std::size_t e = 0; e < r.problem.mesh.cells.size(); ++e) {
      const Vec2 x = centre_of(r.problem.mesh.nodes, r.problem.mesh.cells[e]), n = x.normalized(), t(-n.y(), n.x());
      const auto s = r.recovery.stress.centres.row(Eigen::Index(e));
      const auto along = [&](const Vec2& a) {
        return s(0) * a.x() * a.x() + s(1) * a.y() * a.y() + 2 * s(3) * a.x() * a.y();
      };
      off += (Vec2(along(n), along(t)) - exact_stress(x.norm())).squaredNorm();
      size += exact_stress(x.norm()).squaredNorm();
    }
    EXPECT_LE(std::sqrt(off / size), ring.order == 1 ? 0.08 : 0.01);
  }
}

// A disc that turns, by a sector of `degrees` with its centre, which is held or not.
Results solid(double degrees, bool held) {
  const TemporaryFolder folder;
  std::ostringstream geo;
  geo << "a = Pi / 180 * " << degrees << ";"
      << R"(
Point(1) = {0, 0, 0, 0.1}; Point(2) = {1, 0, 0, 0.1}; Point(3) = {Cos(a), Sin(a), 0, 0.1};
Line(1) = {1, 2}; Circle(2) = {2, 1, 3}; Line(3) = {3, 1}; Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};
Physical Surface("disc") = {1}; Physical Curve("low") = {1}; Physical Curve("high") = {3}; Physical Point("centre") = {1};
Mesh.ElementOrder = 2;
)";
  folder.write("disc.geo", geo.str());
  return solve_scene(read_scene(folder.write("disc.toml", R"(mesh.file = "disc.geo"
materials.one = { young = 1000, poisson = 0.3 }
bodies.disc = "one"
contact = [{ between = ["low", "high"], condition = "cyclic" }]
body_force = [{ body = "disc", force = ["x", "y"] }]
)" + std::string(held ? "boundary = [{ on = \"centre\", displacement = { x = 0, y = 0 } }]\n" : ""))));
}

TEST(CyclicSymmetry, TheCentreOfADiscIsHeld) {
  const Results r = solid(60, true);
  EXPECT_EQ(r.status, Status::solved);
  const double nu = 0.3 / 0.7;  // of plane strain: sigma_r = (3 + nu) / 8 (1 - r^2)
  for (std::size_t e = 0; e < r.problem.mesh.cells.size(); ++e) {
    const Vec2 x = centre_of(r.problem.mesh.nodes, r.problem.mesh.cells[e]), n = x.normalized();
    const auto s = r.recovery.stress.centres.row(Eigen::Index(e));
    EXPECT_NEAR(s(0) * n.x() * n.x() + s(1) * n.y() * n.y() + 2 * s(3) * n.x() * n.y(),
                (3 + nu) / 8 * (1 - x.squaredNorm()), 5e-3);
  }
  expect_contains(message_of([&] { solid(60, false); }),
                  "is on both curves; expected displacement = { x = 0, y = 0 } at the centre");
  expect_contains(message_of([&] { solid(50, true); }),
                  "there are 50 degrees about the origin; expected a whole part of 360");
}

// A lobed ring on a shaft, pressed on by its overlap; both may slide round. `whole`: all sectors, with common nodes.
// `apart`: the cuts of the ring beside those of the shaft, radians. `follows`: the cut, "low" or "high"; with one given
// the low cuts have twice the edges of the high ones.
Results pressed_on(int sectors, bool whole, int order, double apart = 0, const std::string& follows = "") {
  const TemporaryFolder folder;
  std::ostringstream geo;
  geo << "n = " << sectors << "; whole = " << whole << "; apart = " << apart << "; a = 2 * Pi / n; h = 0.12;"
      << R"(
Point(1) = {0, 0, 0};
For k In {0 : n}
  For i In {0 : 3}
    t = k * a + 0.3 + i * a / 4;
    If ((k < n || (!whole && i == 0)) && (whole || k == 0 || (k == 1 && i == 0)))
      For j In {0 : 2}
        Point(100 + 100 * k + 10 * i + j) = {(0.5 + 0.5 * j) * Cos(t), (0.5 + 0.5 * j) * Sin(t), 0, h};
      EndFor
      t = t + apart;
      Point(100 + 100 * k + 10 * i + 3) = {Cos(t), Sin(t), 0, 0.7 * h};
      rim = 1.8 + 0.3 * Cos(n * (t - 0.3) + 1);
      Point(100 + 100 * k + 10 * i + 4) = {rim * Cos(t), rim * Sin(t), 0, h};
    EndIf
  EndFor
EndFor
shaft[] = {}; ring[] = {}; seat[] = {}; bore[] = {};
For k In {0 : whole ? n - 1 : 0}
  p = 100 + 100 * k; q = whole && k == n - 1 ? 100 : p + 100;
  c = 10000 + 100 * k; d = whole && k == n - 1 ? 10000 : c + 100;
  If (k == 0)
    Line(c) = {p, p + 1}; Line(c + 1) = {p + 3, p + 4};
  EndIf
  If (!(whole && k == n - 1))
    Line(d) = {q, q + 1}; Line(d + 1) = {q + 3, q + 4};
  EndIf
  For i In {0 : 3}
    to = i == 3 ? q : p + 10 * (i + 1);
    Circle(c + 10 + i) = {p + 10 * i, 1, to}; Circle(c + 20 + i) = {p + 10 * i + 1, 1, to + 1};
    Circle(c + 30 + i) = {p + 10 * i + 3, 1, to + 3};
  EndFor
  Spline(c + 40) = {p + 4, p + 14, p + 24, p + 34, q + 4};
  Curve Loop(c) = {c + 10, c + 11, c + 12, c + 13, d, -(c + 23), -(c + 22), -(c + 21), -(c + 20), -c}; Plane Surface(c) = {c};
  Curve Loop(c + 1) = {c + 30, c + 31, c + 32, c + 33, d + 1, -(c + 40), -(c + 1)}; Plane Surface(c + 1) = {c + 1};
  shaft[] += {c}; ring[] += {c + 1};
  seat[] += {c + 20 : c + 23}; bore[] += {c + 30 : c + 33};
EndFor
Physical Surface("shaft") = {shaft[]}; Physical Surface("ring") = {ring[]};
Physical Curve("seat") = {seat[]}; Physical Curve("bore") = {bore[]};
If (!whole)
  Physical Curve("shaft_low") = {10000}; Physical Curve("ring_low") = {10001};
  Physical Curve("shaft_high") = {10100}; Physical Curve("ring_high") = {10101};
EndIf
Mesh.SecondOrderIncomplete = 1; Mesh.ElementOrder = )"
      << order << ";\n";
  if (!follows.empty()) geo << "Transfinite Curve{10000, 10001} = 9; Transfinite Curve{10100, 10101} = 5;\n";
  folder.write("fit.geo", geo.str());
  std::string cuts;
  for (const std::string body : {"shaft", "ring"})
    cuts += ", { between = [\"" + body + "_low\", \"" + body + "_high\"], condition = \"cyclic\"" +
            (follows.empty() ? "" : ", multipliers_on = \"" + body + "_" + follows + "\"") + " }";
  Results r = solve_scene(read_scene(folder.write("fit.toml", R"(mesh.file = "fit.geo"
materials.one = { young = 1000, poisson = 0.3 }
bodies = { shaft = "one", ring = "one" }
contact = [{ between = ["seat", "bore"], clearance = -0.01 })" + (whole ? "" : cuts) +
                                                                  "]\n")));
  estimate(r);
  return r;
}

TEST(CyclicSymmetry, CutsThatDoNotMeetAtTheContactAreAnError) {
  for (const double apart : {-0.2, 0.05})
    expect_contains(message_of([&] { pressed_on(5, false, 2, apart); }),
                    "both go on in the next sector, but face each other on");
}

TEST(CyclicSymmetry, ContactGoesOnInTheNextSectorWhicheverCutFollows) {
  for (const char* follows : {"low", "high"})
    for (const int order : {1, 2}) {
      const Results r = pressed_on(5, false, order, 0, follows);
      const Coupling& coupling = r.problem.pairs[0].coupling;
      const std::vector<int> line = multipliers_along(coupling);
      EXPECT_EQ(coupling.row[line.front()], coupling.row[line.back()]) << follows << order;
    }
}

TEST(CyclicSymmetry, ASectorIsPressedAsTheWholeIs) {
  for (const int sectors : {3, 5})
    for (const int order : {1, 2}) {
      SCOPED_TRACE(std::to_string(sectors) + ", " + std::to_string(order));
      const Results sector = pressed_on(sectors, false, order), whole = pressed_on(sectors, true, order);
      EXPECT_EQ(sector.status, Status::solved);
      EXPECT_EQ(whole.status, Status::solved);
      EXPECT_TRUE(sector.estimate->pressures[0].singular.empty());  // the line goes on across the cuts
      const auto turn = [&](const ContactNode& node) {
        return std::fmod(std::atan2(node.position.y(), node.position.x()) - 0.3 + 4 * std::numbers::pi,
                         2 * std::numbers::pi / sectors);
      };
      double most = 0;
      for (const ContactNode& node : sector.recovery.contacts[0].multiplier.nodes) {
        const auto& others = whole.recovery.contacts[0].multiplier.nodes;
        const auto near = std::ranges::min_element(
            others, {}, [&](const ContactNode& other) { return std::abs(turn(other) - turn(node)); });
        EXPECT_NEAR(node.p, near->p, node.p_error + near->p_error + (order == 1 ? 0.02 : 0.002) * node.p) << turn(node);
        most = std::max(most, node.p);
      }
      EXPECT_GT(most, 1.1 * sector.recovery.contacts[0].p_mean);
    }
}

}  // namespace
}  // namespace mortise::test
