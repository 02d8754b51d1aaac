// What the normals of the opposite sides would make of p.
#include "results/other_normals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

#include "app/accuracy.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// Half of a wedge that is pushed into a slot which leans by `apart` more, radians, from their lower end on.
Results wedge(double lean, double apart, const std::string& push, const std::string& side,
              const std::vector<Override>& overrides = {}) {
  const TemporaryFolder folder;
  std::ostringstream geo, toml;
  geo.precision(17);
  geo << "t = " << std::tan(lean) << "; s = " << std::tan(lean + apart) << R"(;
Point(1) = {0, 0, 0}; Point(2) = {3, 0, 0}; Point(3) = {3 + 12 * t, 12, 0}; Point(4) = {0, 12, 0};
Point(11) = {3, 0, 0}; Point(12) = {3, -2, 0}; Point(13) = {20, -2, 0}; Point(14) = {20, 10, 0}; Point(15) = {3 + 10 * s, 10, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 15}; Line(15) = {15, 11};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1}; Curve Loop(2) = {11:15}; Plane Surface(2) = {2};
MeshSize{ : } = 0.7; Mesh.ElementOrder = 2;
Physical Surface("wedge") = {1}; Physical Surface("block") = {2}; Physical Curve("flank") = {2};
Physical Curve("slot") = {15}; Physical Curve("middle") = {4}; Physical Curve("top") = {3}; Physical Curve("far") = {13};
)";
  folder.write("wedge.geo", geo.str());
  toml.precision(17);
  toml << R"(mesh.file = "wedge.geo"
materials.soft = { young = 1000, poisson = 0.3 }
bodies."*" = "soft"
boundary = [{ on = "middle", displacement = { x = 0 } }, { on = "far", displacement = { x = 0, y = 0 } }, { on = "top", )"
       << push << R"( }]
contact = [{ between = ["flank", "slot"], multipliers_on = ")"
       << side << "\" }]\n";
  return solve_scene(read_scene(folder.write("wedge.toml", toml.str()), overrides));
}

double force(const Results& r) { return r.recovery.contacts[0].force.norm(); }

TEST(OtherNormals, MakeOfPWhatMultipliersOnTheOtherSideDo) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> degrees(5, 20), apart(1e-3, 4e-3);
  for (int i = 0; i < 4; ++i) {
    const double lean = std::numbers::pi / 180 * degrees(random), by = apart(random);
    SCOPED_TRACE(lean);
    for (const std::string push : {"pressure = 20", "displacement = { y = -1 }"}) {
      SCOPED_TRACE(push);
      const Results flank = wedge(lean, by, push, "flank"), slot = wedge(lean, by, push, "slot");
      const double change = std::abs(force(slot) / force(flank) - 1);
      EXPECT_GT(change, by);
      for (const Results* r : {&flank, &slot}) {
        const auto other = other_normals(*r, 0)[0];
        ASSERT_TRUE(other);
        EXPECT_NEAR(other->angle, by, 0.01 * by);
        EXPECT_GT(other->part, 0.9 * change);                                    // of which the square is a twentieth
        if (push.starts_with("pressure")) EXPECT_LT(other->part, 1.1 * change);  // else p moves along the flank, too
      }
    }
  }
}

TEST(OtherNormals, OfFacetsAndOfFacesThatGiveWayAreNone) {
  for (const Override& change : {Override{"method.normals", "edges"}, Override{"contact.0.stiffness", "1e4"}})
    EXPECT_FALSE(other_normals(wedge(0.2, 3e-3, "pressure = 20", "flank", {change}), 0)[0]) << change.key;
}

TEST(OtherNormals, OfLinesThatAreOneChangeNothing) {
  EXPECT_EQ(other_normals(wedge(0.2, 0, "pressure = 20", "flank"), 1e-9)[0]->part, 0);
}

// A body whose profile is rise |x|^power, from -1 to 1, pressed on a flat block of another modulus.
Results profile_on_block(const TemporaryFolder& folder, double rise, int power, double modulus, double press,
                         const std::string& side) {
  constexpr int points = 33;
  std::ostringstream geo, toml;
  geo.precision(17);
  for (int i = 0; i < points; ++i) {
    const double x = -1 + 2. * i / (points - 1);
    geo << "Point(" << i + 1 << ") = {" << x << ", " << rise * std::pow(std::abs(x), power) << ", 0};\n";
  }
  geo << R"(Spline(1) = {1:33}; Point(40) = {1, 1.5, 0}; Point(41) = {-1, 1.5, 0};
Line(2) = {33, 40}; Line(3) = {40, 41}; Line(4) = {41, 1}; Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Point(51) = {-2, -2, 0}; Point(52) = {2, -2, 0}; Point(53) = {2, 0, 0}; Point(54) = {-2, 0, 0};
Line(51) = {51, 52}; Line(52) = {52, 53}; Line(53) = {53, 54}; Line(54) = {54, 51};
Curve Loop(2) = {51:54}; Plane Surface(2) = {2};
Physical Surface("body") = {1}; Physical Surface("block") = {2}; Physical Curve("profile") = {1};
Physical Curve("head") = {3}; Physical Curve("bottom") = {51}; Physical Curve("top") = {53};
)";
  folder.write("profile.geo", geo.str());
  toml << R"(mesh.file = "profile.geo"
materials = { one = { young = 1, poisson = 0.3 }, other = { young = )"
       << modulus << R"(, poisson = 0.3 } }
bodies = { block = "one", body = "other" }
boundary = [{ on = "bottom", displacement = { x = 0, y = 0 } }, { on = "head", displacement = { x = 0, y = )"
       << -press << R"( } }]
accuracy.value = 0.001
contact = [{ between = ["profile", "top"], multipliers_on = ")"
       << side << "\" }]\n";
  auto r = solve_to_accuracy(read_scene(folder.write("profile.toml", toml.str())));
  EXPECT_TRUE(r && r->accuracy->reached());
  return *std::move(r);
}

// p along the profile, in places of its own.
std::vector<double> pressures(const ContactResults& contact, bool is_multiplier) {
  const std::vector<ContactNode>& nodes = is_multiplier ? contact.multiplier.nodes : contact.opposite.nodes;
  std::vector<double> p;
  for (int i = 1; i < 4000; ++i) {
    const double s = nodes.back().s * i / 4000;
    const auto next = std::ranges::upper_bound(nodes, s, {}, &ContactNode::s);
    const ContactNode &a = *std::prev(next), &b = *next;
    p.push_back(a.p + (s - a.s) / (b.s - a.s) * (b.p - a.p));
  }
  return p;
}

TEST(OtherNormals, OfProfilesMakeOfPWhatMultipliersOnTheOtherSideDo) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const int power : {3, 10}) {
    const TemporaryFolder folder;
    const double press = std::pow(10, -2.3 + 0.5 * unit(random)), rise = press * (0.5 + unit(random)),
                 modulus = 0.2 + 0.3 * unit(random);
    const Results profile = profile_on_block(folder, rise, power, modulus, press, "profile"),
                  top = profile_on_block(folder, rise, power, modulus, press, "top");
    const auto one = pressures(profile.recovery.contacts[0], true), other = pressures(top.recovery.contacts[0], false);
    double off = 0, whole = 0;
    for (std::size_t i = 0; i < one.size(); ++i) {
      off += std::pow(one[i] - other[i], 2);
      whole += std::pow(one[i], 2);
    }
    const double differs = std::sqrt(off / whole);
    EXPECT_GT(differs, 0.0015) << power;
    for (const Results* r : {&profile, &top}) {
      EXPECT_TRUE(std::ranges::any_of(r->warnings, [](const std::string& line) {
        return line.starts_with("large displacements");  // of less than 1 %, but more than is asked for
      })) << power;
      const auto found = other_normals(*r, 0)[0];
      ASSERT_TRUE(found);
      EXPECT_GT(other_normals(*r, 0.99 * found->part)[0]->part, 0) << power;  // the bound is one
      EXPECT_GT(found->part, 0.6 * differs) << power;
      EXPECT_LT(found->part, 2 * differs) << power;
    }
  }
}

}  // namespace
}  // namespace mortise::test
