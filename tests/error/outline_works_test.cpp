// What straight sides of a curved body leave of the loads on them.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "app/solve_scene.hpp"
#include "base/printable.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// A quarter of a disc on a block, or of a ball, its rim of straight sides.
void write_quarter(const TemporaryFolder& folder, double radius, double edge, const std::string& elements) {
  folder.write("q.geo", worded("R = ", radius, "; h = ", edge, R"(;
Point(1) = {0, 0, 0}; Point(2) = {R, 0, 0}; Point(3) = {0, R, 0};
Line(1) = {1, 2}; Circle(2) = {2, 1, 3}; Line(3) = {3, 1}; Curve Loop(1) = {1:3}; Plane Surface(1) = {1};
Point(11) = {0, -R, 0}; Point(12) = {2 * R, -R, 0}; Point(13) = {2 * R, 0, 0}; Point(14) = {0, 0, 0};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(2) = {11:14}; Plane Surface(2) = {2};
Physical Surface("dome") = {1}; Physical Surface("block") = {2};
Physical Curve("foot") = {1}; Physical Curve("rim") = {2}; Physical Curve("base") = {11}; Physical Curve("top") = {13};
Physical Curve("middle") = {3, 14}; MeshSize{:} = h; )",
                               elements));
}

// A load's part along y on an arc of the radius, by the midpoint rule.
template <typename Along>
double on_arc(double radius, bool ball, const Along& traction) {
  constexpr int count = 20000;
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const double angle = std::numbers::pi / 2 * (i + 0.5) / count;
    const Vec2 n(std::cos(angle), std::sin(angle)), x = radius * n;
    sum += traction(x, n) * (ball ? 2 * std::numbers::pi * x.x() : 1);
  }
  return sum * std::numbers::pi / 2 / count * radius;
}

// Force by statics, of loads that vary with the place: its bar is three halves of what the sides leave.
TEST(OutlineWorks, OfDrawnLoadsAreInTheForce) {
  std::mt19937 random(11);
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  const TemporaryFolder folder;
  for (int k = 0; k < 16; ++k) {
    const bool ball = k % 4 == 3, pressed = k / 2 % 2 == 0;
    const double R = draw(0.5, 3), a = draw(1, 10), b = draw(-0.5, 0.5), c = draw(-0.3, 0.3), turns = draw(1, 4);
    write_quarter(folder, R, R * draw(0.1, 0.25),
                  k % 2 ? "Mesh.ElementOrder = 2; Mesh.SecondOrderLinear = 1;" : "Mesh.ElementOrder = 1;");
    const std::string varies = worded(" * (1 + ", b, " * cos(", turns, " * theta) + ", c, " * y)");
    const std::string load = pressed ? worded("pressure = \"", a, varies, "\"")
                                     : worded("traction = [\"", c, " * y\", \"-", a, varies, "\"]");
    const std::string scene = worded("mesh.file = \"q.geo\"\nmaterials.m = { young = 1e5, poisson = 0.3 }\n",
                                     "bodies = { dome = \"m\", block = \"m\" }\nmodel.plane = \"",
                                     ball ? "axisymmetric" : "strain", "\"\n", R"(
boundary = [{ on = "base", displacement = { y = 0 } }, { on = "middle", displacement = { x = 0 } },
            { on = "rim", )",
                                     load, " }]\ncontact = [{ between = [\"foot\", \"top\"] }]\n");
    SCOPED_TRACE(scene);
    Results r = solve_scene(read_scene(folder.write("q.toml", scene)));
    estimate(r);
    const double exact = on_arc(R, ball, [&](const Vec2& x, const Vec2& n) {
      return a * (1 + b * std::cos(turns * std::atan2(x.y(), x.x())) + c * x.y()) * (pressed ? n.y() : 1);
    });
    const double off = std::abs(std::abs(r.recovery.contacts[0].force.y()) - exact);
    const double bar = (*r.recovery.contacts[0].force_error)(1);
    EXPECT_LE(off, bar);
    EXPECT_LE(bar, 3 * off + 1e-4 * exact);
  }
}

}  // namespace
}  // namespace mortise::test
