// What the audit says of loads, and of bodies that loads drive into one another.
#include <gtest/gtest.h>

#include "problem/audit.hpp"
#include "scene/loads.hpp"
#include "support/audited_scenes.hpp"
#include "support/messages.hpp"

namespace mortise::test {
namespace {

TEST(Audit, RefusesAnEdgeThatTwoNamesLoad) {
  const TemporaryFolder folder;
  const std::string geo =
      "Rectangle(1) = {0, 0, 0, 2, 1}; b() = Boundary{ Surface{1}; }; Physical Surface(\"p\") = {1};"
      "Physical Curve(\"down\") = {b(0)}; Physical Curve(\"left\") = {b(3)}; Physical Curve(\"sides\") = {b(1), b(3)};";
  const std::string load = boundary("left", "pressure = 5");
  const std::string message = message_of(
      [&] { check_scene(drawn(folder, geo, {"p"}, held("down") + load + boundary("sides", "traction = [1, 0]"))); });
  for (const char* part : {"boundary.1", "'left'", "boundary.2", "'sides'", "near (0, ", "over a length of 1 "})
    expect_contains(message, part);
  const Scene moved = drawn(folder, geo, {"p"}, held("down") + load + boundary("sides", "displacement = { x = 0 }"));
  EXPECT_EQ(before(moved), "");
}

TEST(Audit, FindsWhichOfManyLoadsDriveBodiesIntoOneAnother) {
  const TemporaryFolder folder;
  const Scene scene = drawn(folder, rectangles({"0, 0, 0, 4, 1", "1, 1.1, 0, 2, 1"}), {"b1", "b2"},
                            held("down1") + boundary("up2", "displacement = { x = 0, y = -0.001 }"));
  CaseSolver solver;
  for (const double times : {1., 2., 50., 300., 250., 1.}) {
    const std::string lines = joined(audit_solution(solver.solve(scaled_loads(scene, times))));
    EXPECT_EQ(lines.find("pass through one another") != std::string::npos, times > 100) << times << "\n" << lines;
  }
  EXPECT_EQ(solver.shared(), 5);
}

TEST(Audit, FindsBodiesThatTheLoadDrivesThroughOneAnother) {
  const std::string geo = rectangles({"0, 0, 0, 2, 1", "0, 1.05, 0, 2, 1"});
  const auto pushed = [&](const std::string& y, const std::string& contact) {
    const TemporaryFolder folder;
    return after(drawn(folder, geo, {"b1", "b2"},
                       held("down1") + boundary("up2", "displacement = { x = 0, y = " + y + " }") + contact));
  };
  EXPECT_EQ(pushed("-0.04", ""), "");
  EXPECT_EQ(pushed("-0.06", pair("up1", "down2")), "");
  const std::string lines = pushed("-0.06", "");
  EXPECT_EQ(lines_of(lines), 1) << lines;
  expect_contains(lines, "by 0.01 (17 % of the largest displacement)");
  expect_contains(lines, "[\"up1\", \"down2\"]");
}

}  // namespace
}  // namespace mortise::test
