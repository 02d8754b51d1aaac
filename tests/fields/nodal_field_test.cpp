#include "fields/nodal_field.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "fields/grid_module.hpp"
#include "output/vtu.hpp"
#include "support/messages.hpp"
#include "support/patches.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

double linear(const Vec2& x) { return 3 - 40 * x.x() + 7 * x.y(); }

// Half a ring, 1 <= r <= 2, with curved cells where they can be.
Mesh half_ring(CellKind kind, int layers) {
  return mesh_of({ring("ring", 4 * layers, layers, Vec2::Zero(), 1, 2, 180, 0)}, kind);
}

std::string write_ring(const TemporaryFolder& folder, CellKind kind, double (*value)(const Vec2&), int layers = 3) {
  const Mesh mesh = half_ring(kind, layers);
  VtuField T{"T", MatX(mesh.nodes.rows(), 1), {}}, u{"u", MatX(mesh.nodes.rows(), 3), {}};
  for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i) {
    T.values(i, 0) = value(mesh.nodes.row(i).transpose());
    u.values.row(i) << 0, T.values(i, 0), 1;
  }
  write_vtu(folder.path("ring.vtu"), {mesh.nodes, mesh.cells, {}, {T, u}, {}});
  return folder.path("ring.vtu");
}

// Places all over the half ring.
std::vector<Vec2> places(double r0, double r1) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(0, 1);
  std::vector<Vec2> found;
  for (int i = 0; i < 200; ++i) {
    const double r = r0 + (r1 - r0) * part(random), a = std::numbers::pi * part(random);
    found.emplace_back(r * std::cos(a), r * std::sin(a));
  }
  return found;
}

TEST(NodalField, ALinearFieldIsExactOnStraightAndCurvedCellsAndBesideThem) {
  for (const CellKind kind : {CellKind::quad4, CellKind::quad8}) {
    const TemporaryFolder folder;
    const std::string file = write_ring(folder, kind, linear);
    const auto T = nodal_field("fields.T", file, "T", {}), u = nodal_field("fields.u", file, "u", 1);
    for (const Vec2& x : places(1, 2)) {  // beside the straight chords of quad4 too
      EXPECT_NEAR(T(x), linear(x), 1e-12);
      EXPECT_EQ(u(x), T(x));
    }
  }
}

TEST(NodalField, AQuadraticFieldConvergesByTheOrderOfTheCells) {
  const auto quadratic = [](const Vec2& x) { return x.x() * x.x() - x.x() * x.y(); };
  const TemporaryFolder folder;
  const auto error = [&](int layers) {
    const auto T = nodal_field("fields.T", write_ring(folder, CellKind::quad8, quadratic, layers), "T", {});
    double largest = 0;
    for (const Vec2& x : places(1, 2)) largest = std::max(largest, std::abs(T(x) - quadratic(x)));
    return largest;
  };
  const double coarse = error(4), fine = error(8);
  EXPECT_GT(coarse / fine, 6.5);  // third order: 8
  EXPECT_LT(fine, 2e-4);          // of 4
}

// The nodes of a grid lie four on a circle each; of a disc on the same circle, out of order, with and without the
// round-off of far places.
TEST(NodalField, TrianglesOfScatteredPointsCoverThem) {
  for (const Vec2& from : {Vec2(0, 0), Vec2(1000, -3000)})
    for (const double size : {1.0, 1e-4}) {
      Points grid(21 * 21, 2), disc(5 * 24, 2);
      for (int i = 0; i < 21 * 21; ++i) grid.row(i) << from.x() + size * (i % 21), from.y() + size * (i / 21);
      for (int i = 0; i < 5 * 24; ++i) {
        const double r = size * (1 + i / 24), a = i % 24 * std::numbers::pi / 12;
        disc.row(i) << from.x() + r * std::cos(a), from.y() + r * std::sin(a);
      }
      const auto area = [](const Points& points) {
        double sum = 0;
        for (const auto& [a, b, c] : grid_module().triangulate(points)) {
          const Eigen::RowVector2d u = points.row(b) - points.row(a), v = points.row(c) - points.row(a);
          sum += std::abs(u.x() * v.y() - u.y() * v.x()) / 2;
        }
        return sum;
      };
      EXPECT_NEAR(area(grid) / (400 * size * size), 1, 1e-6);
      EXPECT_NEAR(area(disc) / (12 * 25 * std::sin(std::numbers::pi / 12) * size * size), 1, 1e-6);
    }
}

TEST(NodalField, ATableOfScatteredPointsIsExactForALinearField) {
  const TemporaryFolder folder;
  std::ostringstream table;
  table.precision(17);
  table << "\xef\xbb\xbf\"note\";x; y ;\"T\"\r\n";
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; j <= 8; ++j)
      for (int twice = 0; twice < 1 + (i == 0); ++twice) {
        const Vec2 x(-2 + 0.5 * i, 0.3 * j);
        table << "\"a;b\";" << x.x() << ";" << x.y() << ";" << linear(x) << "\n";
      }
  const auto T = nodal_field("fields.T", folder.write("points.csv", table.str()), "T", {});
  for (const Vec2& x : places(0, 2)) EXPECT_NEAR(T(x), linear(x), 1e-12);
}

TEST(NodalField, ATableMayBeginWithAByteOrderMark) {
  const TemporaryFolder folder;
  const std::string file = folder.write("points.csv", "\xef\xbb\xbfx,y,T\n0,0,1\n1,0,2\n0,1,3\n");
  EXPECT_NEAR(nodal_field("fields.T", file, "T", {})(Vec2(0.5, 0.25)), 2, 1e-14);
}

TEST(NodalField, APlaceOutsideIsToldWithItsDistance) {
  const TemporaryFolder folder;
  const std::string file = write_ring(folder, CellKind::quad8, linear);
  const auto T = nodal_field("fields.T (line 3)", file, "T", {});
  EXPECT_EQ(message_of<SceneError>([&] { T(Vec2(0, 0.5)); }),
            "fields.T (line 3): (0, 0.5) is outside of " + file +
                ", whose nearest point, (6.12323e-17, 1), is 0.5 away; expected values all over the bodies and curves "
                "that take them");
  expect_contains(message_of<SceneError>([&] { T(Vec2(2.1, 0)); }), ", is 0.1 away");
}

TEST(NodalField, WhatCannotBeReadIsNamed) {
  const TemporaryFolder folder;
  const std::string ring = write_ring(folder, CellKind::quad4, linear);
  const auto message = [](const std::string& file, const std::string& values, std::optional<int> component = {}) {
    return message_of([&] { nodal_field("fields.T", file, values, component); });
  };
  EXPECT_EQ(message(ring, "t"), ring + ": unknown array of its points 't'; known: T, u");
  EXPECT_EQ(message(ring, "u"), ring + ": 'u' has 3 components; expected component = 0 to 2");
  EXPECT_EQ(message(ring, "T", 1), ring + ": 'T' has 1 components; expected component = 0");
  const auto table = [&](const std::string& text) { return folder.write("points.csv", text); };
  const std::string csv = folder.path("points.csv");
  EXPECT_EQ(message(table("x,y,T\n0,0,1\n\n1,0,?\n"), "T"), csv + ":4: expected a finite number, found '?'");
  for (const std::string value : {"nan", "inf"})
    EXPECT_EQ(message(table("x,y,T\n0,0,1\n1,0," + value + "\n"), "T"),
              csv + ":3: expected a finite number, found '" + value + "'");
  EXPECT_EQ(message(table("x,y,T\n0,0\n"), "T"), csv + ":2: 2 fields; expected 3 or more");
  EXPECT_EQ(message(table("x,y,T\n0,0,1\n1,0,2\n0,0,3\n"), "T"),
            csv +
                ":4: another value at the place of line 2; expected one a place (a .vtu may have one on either side of "
                "a line)");
  EXPECT_EQ(message(table("x,y,T\n0,0,1\n1,1,2\n2,2,3\n"), "T"),
            csv + ": expected three points or more that are not on one line");
  EXPECT_EQ(message(table("x,z,T\n0,0,1\n"), "T"), csv + ":1: unknown column 'y'; known: x, z, T");
  EXPECT_EQ(message(table(""), "T"), csv + ": cannot be read, or is empty");
}

TEST(NodalField, DamagedVtuFilesAreRefused) {
  const TemporaryFolder folder;
  const std::string whole = text_of(write_ring(folder, CellKind::quad4, linear));
  const std::string file = folder.path("damaged.vtu");
  const auto message = [&](const std::string& text) {
    folder.write("damaged.vtu", text);
    return message_of([&] { nodal_field("fields.T", file, "T", {}); });
  };
  for (const double part : {0.0, 0.1, 0.5, 0.9})
    expect_contains(message(whole.substr(0, std::size_t(part * double(whole.size())))), file + ": ");
  expect_contains(message("x,y,T\n0,0,1\n"), file + ": ");
}

TEST(NodalField, AVtuWithMorePointsThanMemoryIsRefusedByName) {
  const TemporaryFolder folder;
  std::string text = text_of(write_ring(folder, CellKind::quad4, linear));
  const std::string mark = "NumberOfPoints=\"";
  const std::size_t start = text.find(mark) + mark.size(), end = text.find('"', start);
  text.replace(start, end - start, "99999999999");
  const std::string file = folder.write("huge.vtu", text);
  EXPECT_EQ(message_of([&] { nodal_field("fields.T", file, "T", {}); }),
            file + ": its points and cells need more memory than there is; are their numbers right?");
}

}  // namespace
}  // namespace mortise::test
