// What a run says beside its checks: one line for each pair and cause, with the place.
#include "results/warnings.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "app/solve_scene.hpp"
#include "support/plate_scenes.hpp"

namespace mortise::test {
namespace {

Results solved(const std::string& path, std::vector<Override> overrides) {
  return solve_scene(read_scene(std::string(MORTISE_SOURCE_DIR) + "/" + path, overrides));
}

int notes_with(const Results& r, const std::string& part) {
  int count = 0;
  for (const std::string& note : r.warnings) count += note.find(part) != std::string::npos;
  return count;
}

std::string all(const Results& r) {
  std::string text;
  for (const std::string& note : r.warnings) text += note + "\n";
  return text;
}

TEST(Notes, MultipliersThatFaceNothingAreOneLine) {
  const Results r = solved("geo/punch.toml", {{"contact.multipliers_on", "block_top"}});
  EXPECT_EQ(notes_with(r, "facing nothing"), 1) << all(r);
  EXPECT_EQ(notes_with(r, " multipliers of 'block_top' (x = "), 1) << all(r);
}

// ---- Closed and measured gaps ----

TEST(Notes, ClosedSaysWhatItLeavesOut) {
  // A press fit whose interference is drawn: closed drops it, and nothing is pressed.
  const std::string rings = "tests/parts/drawn_interference.toml";
  const Results measured = solved(rings, {});
  EXPECT_GT(measured.contacts[0].p_max, 1e6);
  EXPECT_EQ(notes_with(measured, "closed"), 0) << all(measured);
  const Results closed = solved(rings, {{"contact.initial_gap", "closed"}});
  EXPECT_EQ(notes_with(closed, "leaves out gaps"), 1) << all(closed);
}

TEST(Notes, ClosedIsNotAdvisedForAClearance) {
  const Results r = solved("tests/parts/pin_in_hole.toml", {});
  EXPECT_EQ(notes_with(r, "closed"), 0) << all(r);
}

TEST(Notes, ClosedIsAdvisedWhereTheMeshesMakeTheGap) {
  const Results r = solved("geo/parabola_1.toml", {{"contact.initial_gap", "measured"},
                                                   {"mesh.parameters.order", "1"},
                                                   {"mesh.parameters.n_upper", "20"},
                                                   {"mesh.parameters.n_lower", "25"}});
  EXPECT_EQ(notes_with(r, "set initial_gap = \"closed\""), 1) << all(r);
}

// ---- Shape ----

TEST(Notes, StraightSidesOfACurvedLineAreNamed) {
  const std::string pin = "tests/parts/pin_in_hole.toml";
  const Results straight = solved(pin, {{"mesh.parameters.straight", "1"}});
  EXPECT_EQ(notes_with(straight, "between straight 3-node edges"), 2) << all(straight);  // of either curve
  const Results curved = solved(pin, {});
  EXPECT_EQ(notes_with(curved, "between straight 3-node edges"), 0) << all(curved);
  EXPECT_GT(straight.contacts[0].p_max, 1.05 * curved.contacts[0].p_max);
}

// ---- Displacements ----

TEST(Notes, AClearanceOfThreePercentOfTheRadiusIsALargeDisplacement) {
  const Results r =
      solved("tests/parts/pin_in_hole.toml", {{"mesh.parameters.clearance", "0.03"}, {"mesh.parameters.drop", "0"}});
  EXPECT_EQ(notes_with(r, "of the contact line's radius"), 1) << all(r);
  const Results small = solved("tests/parts/pin_in_hole.toml", {{"mesh.parameters.clearance", "0.0003"}});
  EXPECT_EQ(notes_with(small, "large displacements"), 0) << all(small);
}

TEST(Notes, ATurnOfTheWholeIsALargeDisplacement) {
  Scene s = uniaxial_scene();
  EXPECT_EQ(notes_with(solve_scene(s, mesh_of({})), "large displacements"), 0);
  // Every node moved as a turn by 9 degrees moves it.
  s.boundaries.clear();
  const Results r = solve_scene(s, mesh_of({}), {}, nullptr, [](const Mesh& mesh, Discretisation& d) {
    for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i) {
      if (mesh.nodes(i, 1) > 0 && mesh.nodes(i, 1) < 0.6) continue;  // the bottom and the top
      d.system.constraints.fixed[2 * i] = d.system.constraints.fixed[2 * i + 1] = 1;
      d.system.constraints.value.segment<2>(2 * i) = 0.15 * Vec2(-mesh.nodes(i, 1), mesh.nodes(i, 0));
    }
    for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i)  // and pressed
      if (mesh.nodes(i, 1) >= 0.6) d.system.constraints.value(2 * i + 1) -= 1e-4;
  });
  EXPECT_EQ(notes_with(r, "a side turns by"), 1) << all(r);
}

}  // namespace
}  // namespace mortise::test
