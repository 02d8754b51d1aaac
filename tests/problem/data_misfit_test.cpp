#include "problem/data_misfit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "support/two_plates.hpp"

namespace mortise::test {
namespace {

Field field_of(const std::string& text) { return {text, {.key = "boundary.0", .on_curve = true}}; }

DataMisfits on_top(BoundaryCondition what) {
  const Mesh mesh = mesh_of({});
  Entries entries;
  entries.boundaries = boundary_entries({{.key = "boundary.0", .on = {"top"}, .what = std::move(what)}}, mesh,
                                        SideTable(mesh), SceneNames(mesh));
  entries.body_force_of = entries.initial_strain_of = std::vector<int>(mesh.bodies.size(), -1);
  return data_misfits(entries, mesh, {});
}

DataMisfits of_pressure(const std::string& text) { return on_top(Pressure{field_of(text)}); }

TEST(DataMisfits, AreNoneOfWhatTheMeshResolves) {
  EXPECT_TRUE(of_pressure("1 + x - x^2").parts.empty());
  EXPECT_TRUE(of_pressure("1 + x - x^2").entries.empty());
}

// Plates of seven edges, 0.8 / 7 = 0.114 each: the step lies 0.82 along the fourth.
TEST(DataMisfits, NameEntryPlaceAndSizeOfAStep) {
  const DataMisfits found = of_pressure("x < 0.437 ? 1 : 3");
  ASSERT_EQ(found.parts.size(), 1u);
  ASSERT_EQ(found.entries.size(), 1u);
  const EntryMisfit& entry = found.entries[0];
  EXPECT_EQ(entry.key, "boundary.0.pressure");
  EXPECT_NEAR(entry.at.x(), 0.437, 1e-3);
  EXPECT_NEAR(entry.at.y(), 0.6, 1e-12);
  EXPECT_NEAR(entry.size, 0.8 / 7, 1e-12);
  EXPECT_LT(entry.finest, 1e-6);
  // At most the step's 2 on a part of the edge of 0.8 / 7, of a mean of about 2 over 0.8.
  EXPECT_GT(entry.part, 0.005);
  EXPECT_LT(entry.part, 2. / 7 / 2);
}

TEST(DataMisfits, OfADisplacementHaveNoMean) {
  const DataMisfits found = on_top(Displacement{{}, field_of("x < 0.437 ? 1 : 3")});
  ASSERT_EQ(found.parts.size(), 1u);
  EXPECT_LT(found.parts[0].mean.norm(), 1e-8);
  EXPECT_GT(found.parts[0].size, 0.01);
}

// A star of triangles about the origin, with middle nodes that lie `middle` of the way from the chords to the circle.
Mesh fan(const std::vector<Vec2>& rim, CellKind kind, double middle = 0) {
  const int count = int(rim.size());
  Mesh mesh;
  mesh.bodies = {"fan"};
  std::vector<Vec2> nodes{Vec2::Zero()};
  nodes.insert(nodes.end(), rim.begin(), rim.end());
  for (int k = 0; k < count; ++k) {
    Cell cell{kind, 0, {0, 1 + k, 1 + (k + 1) % count}};
    if (kind == CellKind::tri6) {
      const Vec2 half = (rim[k] + rim[(k + 1) % count]) / 2, arc = half.normalized() * rim[k].norm();
      const int first = int(nodes.size());
      nodes.insert(nodes.end(), {rim[k] / 2, half + middle * (arc - half)});
      cell.nodes[3] = first;
      cell.nodes[4] = first + 1;
      cell.nodes[5] = 1 + count + 2 * ((k + 1) % count);
    }
    mesh.cells.push_back(cell);
  }
  mesh.nodes.resize(Eigen::Index(nodes.size()), 2);
  for (std::size_t i = 0; i < nodes.size(); ++i) mesh.nodes.row(Eigen::Index(i)) = nodes[i].transpose();
  return mesh;
}

double sum_of_sizes(const Mesh& mesh) {
  double sum = 0;
  for (const DataMisfit& part : outline_misfits(mesh, {.thickness = 3})) sum += part.size;
  return sum;
}

// What chords of any lengths leave of a circle is known to a fifth.
TEST(OutlineMisfits, AreWhatChordsCutOffACircle) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0.7, 1.3);
  for (int trial = 0; trial < 20; ++trial) {
    const double radius = 7;
    std::vector<double> angles{0};
    while (angles.back() < 2 * std::numbers::pi - 0.4) angles.push_back(angles.back() + 0.25 * part(random));
    std::vector<Vec2> rim;
    for (const double a : angles) rim.push_back(radius * Vec2(std::cos(a), std::sin(a)));
    double polygon = 0;
    for (std::size_t k = 0; k < angles.size(); ++k) {
      const double next = k + 1 < angles.size() ? angles[k + 1] : 2 * std::numbers::pi;
      polygon += radius * radius / 2 * std::sin(next - angles[k]);
    }
    const double cut = 3 * (std::numbers::pi * radius * radius - polygon);
    EXPECT_NEAR(sum_of_sizes(fan(rim, CellKind::tri3)) / cut, 1, 0.2) << trial;
    EXPECT_NEAR(sum_of_sizes(fan(rim, CellKind::tri6)) / cut, 1, 0.2) << trial;
    EXPECT_EQ(sum_of_sizes(fan(rim, CellKind::tri6, 1)), 0) << trial;
  }
}

TEST(OutlineMisfits, AreNoneOfStraightBodies) {
  // Of an octagon, whose corners turn by 45 degrees, and of a square with one corner more, which turns by 11.
  std::vector<Vec2> octagon, square{{1.1, 0}, {1.05, 0.5}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}, {1.05, -0.5}};
  for (int k = 0; k < 8; ++k)
    octagon.emplace_back(std::cos(k * std::numbers::pi / 4), std::sin(k * std::numbers::pi / 4));
  EXPECT_EQ(sum_of_sizes(fan(octagon, CellKind::tri3)), 0);
  EXPECT_EQ(sum_of_sizes(fan(square, CellKind::tri3)), 0);
  EXPECT_EQ(sum_of_sizes(mesh_of({})), 0);
  EXPECT_GT(
      sum_of_sizes(mesh_of({.height = [](double x) { return 0.3 + 0.1 * x * x; }, .kind_upper = CellKind::quad4})), 0);
}

}  // namespace
}  // namespace mortise::test
