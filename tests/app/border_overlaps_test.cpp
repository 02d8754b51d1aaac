// Forces, displacements and pressures where a mesh hardly sees contact: a ring on a plate touches by far less than an
// edge, and so do the corner of a foot and discs that press one another a little.
#include "error/border_overlaps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

#include "app/accuracy.hpp"
#include "results/error_report.hpp"
#include "support/pressure_at.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// A quarter of a ring of radius 10, its foot moved down by `push`.
std::string ring(double thickness) {
  std::ostringstream geo;
  const double inner = 10 - thickness;
  geo << "Point(1) = {0, -10, 0}; Point(2) = {10, 0, 0}; Point(3) = {0, 0, 0}; Point(4) = {" << inner << ", 0, 0};\n"
      << "Point(5) = {0, " << -inner
      << ", 0}; Point(6) = {0, -15, 0}; Point(7) = {8, -15, 0}; Point(8) = {8, -10, 0};\n"
      << "Point(9) = {0, -10, 0}; Circle(1) = {1, 3, 2}; Line(2) = {2, 4}; Circle(3) = {4, 3, 5}; Line(4) = {5, 1};\n"
      << "Line(5) = {6, 7}; Line(6) = {7, 8}; Line(7) = {8, 9}; Line(8) = {9, 6};\n"
      << "Curve Loop(1) = {1 ... 4}; Plane Surface(1) = {1}; Curve Loop(2) = {5 ... 8}; Plane Surface(2) = {2};\n"
      << "Physical Surface(\"ring\") = {1}; Physical Surface(\"plate\") = {2}; Physical Curve(\"out\") = {1};\n"
      << "Physical Curve(\"foot\") = {2}; Physical Curve(\"middle\") = {4, 8}; Physical Curve(\"ground\") = {5};\n"
      << "Physical Curve(\"top\") = {7};\n";
  return geo.str();
}

Scene scene_of(const TemporaryFolder& folder, double thickness, double push, const std::string& asked) {
  folder.write("ring.geo", ring(thickness));
  std::ostringstream toml;
  toml << "mesh.file = \"ring.geo\"\nmaterials.steel = { young = 210e3, poisson = 0.3 }\n"
       << "bodies = { ring = \"steel\", plate = \"steel\" }\ncontact = [{ between = [\"out\", \"top\"] }]\n"
       << "boundary = [{ on = \"middle\", displacement = { x = 0 } }, { on = \"ground\", displacement = { y = 0 } },\n"
       << "  { on = \"foot\", rigid = { y = " << -push << ", rotation = 0 } }]\n[accuracy]\n"
       << asked << "\n";
  return read_scene(folder.write("ring.toml", toml.str()));
}

// The thinner the ring, the more of the answer is how far it moves before it touches.
TEST(BorderOverlaps, ForcesAndDisplacementsAreRightWhereContactIsLessThanAnEdge) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> power(-0.7, 0.5);
  for (int k = 0; k < 4; ++k) {
    const double thickness = std::pow(10, power(random)), push = 2e-3 * std::pow(10, power(random));
    const TemporaryFolder folder;
    const auto exact = solve_to_accuracy(scene_of(folder, thickness, push, "value = 0.001"));
    ASSERT_TRUE(exact) << k;
    const double force = exact->recovery.contacts[0].force.y();
    for (const char* value : {"0.05", "0.01"}) {
      const auto r =
          solve_to_accuracy(scene_of(folder, thickness, push, std::string("of = \"force\"\nvalue = ") + value));
      ASSERT_TRUE(r) << k;
      EXPECT_NEAR(r->recovery.contacts[0].force.y(), force, std::stod(value) * std::abs(force)) << k << " " << value;
      EXPECT_LE(std::abs(r->recovery.contacts[0].force.y() - force), r->recovery.contacts[0].force_error->y()) << k;
    }
  }
}

// Half of a punch with a chamfer behind the corner of its foot, on a block; `angle`, radians, is the chamfer's with the
// block's top, the foot's curve goes on along it.
std::string chamfered_punch(double width, double height, double chamfer, double angle) {
  std::ostringstream geo;
  geo << "Point(1) = {0, -11, 0}; Point(2) = {34, -11, 0}; Point(3) = {34, 0, 0}; Point(4) = {0, 0, 0};\n"
      << "Point(5) = {0, 0, 0}; Point(6) = {" << width << ", 0, 0}; Point(7) = {" << width + chamfer << ", "
      << chamfer * std::tan(angle) << ", 0};\n"
      << "Point(8) = {" << width + chamfer << ", " << height << ", 0}; Point(9) = {0, " << height << ", 0};\n"
      << "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Line(5) = {5, 6}; Line(6) = {6, 7};\n"
      << "Line(7) = {7, 8}; Line(8) = {8, 9}; Line(9) = {9, 5}; Curve Loop(1) = {1 ... 4}; Plane Surface(1) = {1};\n"
      << "Curve Loop(2) = {5 ... 9}; Plane Surface(2) = {2}; Physical Surface(\"base\") = {1};\n"
      << "Physical Surface(\"punch\") = {2}; Physical Curve(\"ground\") = {1}; Physical Curve(\"top\") = {3};\n"
      << "Physical Curve(\"foot\") = {5, 6}; Physical Curve(\"head\") = {8}; Physical Curve(\"middle\") = {4, 9};\n";
  return geo.str();
}

// Heated, it curls up and stands on the corner of its foot, by far less than an edge.
Scene curled(const TemporaryFolder& folder, std::mt19937& random, const std::string& asked) {
  std::uniform_real_distribution<double> any(0, 1);
  const double width = 15 + 5 * any(random), height = 10 + 15 * any(random), chamfer = 1 + 2 * any(random),
               angle = 0.03 + 0.7 * any(random), heat = 30 + 70 * any(random);
  std::ostringstream toml;
  folder.write("curled.geo", chamfered_punch(width, height, chamfer, angle));
  toml << "mesh.file = \"curled.geo\"\nmodel.plane = \"" << (any(random) < 0.5 ? "strain" : "axisymmetric") << "\"\n"
       << "materials.b = { young = 14120, poisson = 0.45 }\n"
       << "materials.p = { young = 5138, poisson = 0.45, thermal_expansion = 1e-5 }\n"
       << "bodies = { base = \"b\", punch = \"p\" }\ncontact = [{ between = [\"foot\", \"top\"] }]\n"
       << "boundary = [{ on = \"ground\", displacement = { y = 0 } }, { on = \"head\", pressure = 0.323 },\n"
       << "  { on = \"middle\", displacement = { x = 0 } }]\n"
       << "initial_strain = [{ body = \"punch\", temperature_change = " << heat << " }]\n"
       << "accuracy.value = " << asked << "\n";
  return read_scene(folder.write("curled.toml", toml.str()));
}

// Where the foot's middle presses p is as good as was asked.
TEST(BorderOverlaps, PressureIsRightWhereAnotherContactIsLessThanAnEdge) {
  for (int seed = 1; seed <= 4; ++seed) {
    const TemporaryFolder folder;
    std::mt19937 random(seed), again(seed);
    const auto exact = solve_to_accuracy(curled(folder, random, "0.001"));
    const auto found = solve_to_accuracy(curled(folder, again, "0.01"));
    ASSERT_TRUE(exact && found) << seed;
    for (const double x : {0.5, 3.0, 6.0}) {
      const double p = pressure_at(exact->recovery.contacts[0].multiplier.nodes, x);
      ASSERT_GT(p, 0) << seed;
      EXPECT_NEAR(pressure_at(found->recovery.contacts[0].multiplier.nodes, x), p, 0.01 * p) << seed << " " << x;
    }
  }
}

// Pressed on the block, with the multipliers on the foot.
Scene chamfered(const TemporaryFolder& folder, std::mt19937& random) {
  std::uniform_real_distribution<double> any(0, 1);
  const double width = 15 + 5 * any(random), height = 5 + 15 * any(random), chamfer = 1 + 2 * any(random),
               angle = 0.2 + 0.6 * any(random), young = 1000 * std::pow(7, any(random));
  std::ostringstream toml;
  folder.write("chamfered.geo", chamfered_punch(width, height, chamfer, angle));
  toml << "mesh.file = \"chamfered.geo\"\nmaterials.b = { young = 1000, poisson = 0.3 }\n"
       << "materials.p = { young = " << young << ", poisson = 0.3 }\n"
       << "bodies = { base = \"b\", punch = \"p\" }\n"
       << "contact = [{ between = [\"foot\", \"top\"], multipliers_on = \"foot\" }]\n"
       << "boundary = [{ on = \"ground\", displacement = { y = 0 } }, { on = \"head\", pressure = 0.3 },\n"
       << "  { on = \"middle\", displacement = { x = 0 } }]\naccuracy.value = 0.01\n";
  return read_scene(folder.write("chamfered.toml", toml.str()));
}

// The row at the corner, half of which is the chamfer's gap, is open, and p is zero there however short the edges.
TEST(BorderOverlaps, APunchStandsOnTheCornerBeforeItsChamfer) {
  for (int seed = 1; seed <= 5; ++seed) {
    const TemporaryFolder folder;
    std::mt19937 random(seed);
    const auto r = solve_to_accuracy(chamfered(folder, random));
    ASSERT_TRUE(r) << seed;
    EXPECT_TRUE(r->accuracy->reached()) << seed;
    EXPECT_LE(r->accuracy->solves.size(), 4u) << seed;
    ASSERT_EQ(r->estimate->pressures[0].singular.size(), 1u) << seed;
    EXPECT_NEAR(r->estimate->pressures[0].singular[0].pressure_exponent, 0.5, 0.3) << seed;
  }
}

// Discs of radius 1 heaped up in a box that they fill: rows of `columns`, one less in each, every one touched in a
// point by all of its neighbours, the floor and the walls.
class Heap {
 public:
  Heap(int columns, int rows) {
    const double height = 2 + (rows - 1) * std::numbers::sqrt3;
    add_block("floor", -1, 2 * columns + 1, -1, 0);
    add_block("left", -1, 0, 0.02, height);
    add_block("right", 2 * columns, 2 * columns + 1, 0.02, height);
    for (int row = 0; row < rows; ++row)
      for (int k = 0; k < columns - row; ++k) add_disc({1 + row + 2 * k, 1 + row * std::numbers::sqrt3}, columns);
  }

  // `weights`: force per area of each disc, all bodies have a modulus of 55e3.
  Scene scene(const TemporaryFolder& folder, const std::vector<double>& weights, const std::string& asked) const {
    folder.write("heap.geo", geo_.str());
    std::ostringstream toml;
    toml << "mesh.file = \"heap.geo\"\nmaterials.m = { young = 55e3, poisson = 0.3 }\nbodies = { \"*\" = \"m\" }\n"
         << "boundary = [{ on = [\"floor_1\", \"left_4\", \"right_2\"], displacement = { x = 0, y = 0 } }]\n"
         << "contact = [" << pairs_.str() << "]\nbody_force = [\n";
    for (std::size_t k = 0; k < centres_.size(); ++k)
      toml << "{ body = \"disc" << k << "\", force = [0, " << -weights[k] << "] },\n";
    toml << "]\n[accuracy]\n" << asked << "\n";
    return read_scene(folder.write("heap.toml", toml.str()));
  }

 private:
  void add_surface(const std::string& name, int first) {
    ++surface_;
    geo_ << "Curve Loop(" << surface_ << ") = {" << first << " ... " << curve_ << "}; Plane Surface(" << surface_
         << ") = {" << surface_ << "}; Physical Surface(\"" << name << "\") = {" << surface_ << "};\n";
  }
  void add_point(double x, double y) { geo_ << "Point(" << ++point_ << ") = {" << x << ", " << y << ", 0};\n"; }

  void add_block(const std::string& name, double left, double right, double bottom, double top) {
    const int p = point_, first = curve_ + 1;
    add_point(left, bottom);
    add_point(right, bottom);
    add_point(right, top);
    add_point(left, top);
    for (int k = 0; k < 4; ++k) {
      geo_ << "Line(" << ++curve_ << ") = {" << p + 1 + k << ", " << p + 1 + (k + 1) % 4 << "};\n";
      geo_ << "Physical Curve(\"" << name << "_" << k + 1 << "\") = {" << curve_ << "};\n";
    }
    add_surface(name, first);
  }

  void add_disc(const Vec2& centre, int columns) {
    const int p = point_, first = curve_ + 1;
    const std::string disc = std::to_string(centres_.size()), rim = "\"rim" + disc + "\"";
    add_point(centre.x(), centre.y());
    for (const Vec2& d : {Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1)})
      add_point(centre.x() + d.x(), centre.y() + d.y());
    for (int k = 0; k < 4; ++k)
      geo_ << "Circle(" << ++curve_ << ") = {" << p + 2 + k << ", " << p + 1 << ", " << p + 2 + (k + 1) % 4 << "};\n";
    geo_ << "Physical Curve(" << rim << ") = {" << first << " ... " << curve_ << "};\n";
    add_surface("disc" + disc, first);
    const auto touch = [&](bool here, const std::string& other) {
      if (here) pairs_ << "{ between = [" << rim << ", \"" << other << "\"] },\n";
    };
    touch(centre.y() < 1.1, "floor_3");
    touch(centre.x() < 1.1, "left_2");
    touch(centre.x() > 2 * columns - 1.1, "right_4");
    for (std::size_t k = 0; k < centres_.size(); ++k)
      touch((centre - centres_[k]).norm() < 2.1, "rim" + std::to_string(k));
    centres_.push_back(centre);
  }

  std::ostringstream geo_ = [] {
    std::ostringstream exact;
    exact.precision(17);
    return exact;
  }();
  std::ostringstream pairs_;
  std::vector<Vec2> centres_;
  int point_ = 0, curve_ = 0, surface_ = 0;
};

// Each pair's force is that of a finer answer, within the bars of both.
void expect_forces(const Results& r, const Results& finer, const std::string& which) {
  ASSERT_TRUE(r.accuracy->reached() && finer.accuracy->reached()) << which;
  for (std::size_t k = 0; k < r.recovery.contacts.size(); ++k) {
    const ContactResults &found = r.recovery.contacts[k], &exact = finer.recovery.contacts[k];
    EXPECT_NEAR(found.force.norm(), exact.force.norm(),
                found.force_error->norm() + exact.force_error->norm() + 1e-9 * exact.force.norm())
        << which << ", pair " << k;
  }
}

// By its own weight a disc widens by far less than an edge at the walls sags.
TEST(BorderOverlaps, ADiscPressesTheWallsOfABox) {
  const Heap box(1, 1);
  for (const double weight : {2.0, 0.55, 0.2}) {
    const TemporaryFolder folder;
    const auto found = solve_to_accuracy(box.scene(folder, {weight}, "value = 0.02")),
               finer = solve_to_accuracy(box.scene(folder, {weight}, "value = 0.003\nfirst_edges = 31"));
    EXPECT_NEAR(finer->recovery.contacts[2].force.norm() / (std::numbers::pi * weight), 0.0185, 0.002) << weight;
    expect_forces(*found, *finer, std::to_string(weight));
  }
}

// Where some press others apart, pairs that carry little are as coarse as they may be, and as far off as their edges
// sag: others are open by that, or not.
TEST(BorderOverlaps, DiscsOfAHeapTouchWhereEdgesOfOthersAreCoarse) {
  const Heap heap(4, 2);
  const std::vector<double> weights = {3.846, 3.817, 0.6979, 0.7971, 3.424, 3.076, 2.844};
  const TemporaryFolder folder;
  const auto found = solve_to_accuracy(heap.scene(folder, weights, "value = 0.05")),
             finer = solve_to_accuracy(heap.scene(folder, weights, "value = 0.02\nfirst_edges = 27"));
  expect_forces(*found, *finer, "heap");
}

}  // namespace
}  // namespace mortise::test
