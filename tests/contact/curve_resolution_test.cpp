// Gaps that two meshes of one curve make, against real ones.
#include "contact/curve_resolution.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "contact/gap_resolution.hpp"
#include "fem/edges.hpp"
#include "support/two_plates.hpp"

namespace mortise {
namespace {

using test::TwoPlates;

struct GapCurves : ContactInterface {
  Mesh mesh;
};

// Both plates of one mesh, the upper one lifted by `gap`.
GapCurves gap_curves_of(const TwoPlates& plates, double gap = 0) {
  GapCurves c;
  c.mesh = test::mesh_of(plates);
  for (Eigen::Index i = 0; i < c.mesh.nodes.rows(); ++i) {
    const auto in_upper = [&](const Cell& cell) {
      return cell.body == 0 && std::find(cell.nodes.begin(), cell.nodes.begin() + node_count(cell.kind), int(i)) !=
                                   cell.nodes.begin() + node_count(cell.kind);
    };
    if (std::any_of(c.mesh.cells.begin(), c.mesh.cells.end(), in_upper)) c.mesh.nodes(i, 1) += gap;
  }
  c.multiplier = contact_curve(c.mesh, boundary_index(c.mesh, "lower_contact"));
  c.opposite = contact_curve(c.mesh, boundary_index(c.mesh, "upper_contact"));
  c.points = contact_points(c.mesh.nodes, c, Integration::segments);
  return c;
}

TwoPlates circle(int n_upper, int n_lower, CellKind kind) {
  TwoPlates plates;
  plates.height = [](double x) { return std::sqrt(0.25 - (x - 0.4) * (x - 0.4)); };  // radius 0.5
  plates.n_upper = n_upper;
  plates.n_lower = n_lower;
  plates.kind_upper = plates.kind_lower = kind;
  return plates;
}

TEST(Sagittas, OfAStraightCurveVanish) {
  for (const CellKind kind : {CellKind::quad4, CellKind::quad8}) {
    TwoPlates plates;
    plates.kind_upper = plates.kind_lower = kind;
    const GapCurves c = gap_curves_of(plates);
    for (const double s : sagittas(c.mesh.nodes, c.multiplier)) EXPECT_LE(s, 1e-15);
  }
}

TEST(Sagittas, OfChordsAreAtLeastTheArcsDistance) {
  const GapCurves c = gap_curves_of(circle(20, 31, CellKind::quad4));
  const std::vector<double> list = sagittas(c.mesh.nodes, c.multiplier);
  for (std::size_t e = 0; e < list.size(); ++e) {
    const double h = edge_length(c.mesh.nodes, c.multiplier.edges[e]);
    const double exact = 0.5 - std::sqrt(0.25 - h * h / 4);
    EXPECT_GE(list[e], 0.9 * exact);
    EXPECT_LE(list[e], 2 * exact);
  }
}

// How far each edge of the lower plate's line lies from `height`, by the vertical distance and the slope.
std::vector<double> distances(const GapCurves& c, const std::function<double(double)>& height) {
  std::vector<double> list;
  for (const Edge& e : c.multiplier.edges) {
    double largest = 0;
    for (double xi = -1; xi <= 1; xi += 0.0625) {
      const Vec2 x = edge_point(c.mesh.nodes, e, xi).position;
      const double slope = (height(x.x() + 1e-5) - height(x.x() - 1e-5)) / 2e-5;
      largest = std::max(largest, std::abs(x.y() - height(x.x())) / std::hypot(1, slope));
    }
    list.push_back(largest);
  }
  return list;
}

TEST(Sagittas, OfQuadraticEdgesAreWhatParabolasMiss) {
  const std::function<double(double)> curves[] = {
      [](double x) { return std::sqrt(0.25 - (x - 0.4) * (x - 0.4)); },           // circle
      [](double x) { return 0.3 + 0.05 * std::cos(5 * x); },                      // cosine
      [](double x) { return 0.5 * std::sqrt(1 - (x - 0.3) * (x - 0.3) / 0.49); }  // ellipse, not symmetric
  };
  for (const auto& height : curves)
    for (const int n : {6, 12, 24, 48}) {
      TwoPlates plates;
      plates.height = height;
      plates.n_upper = plates.n_lower = n;
      const GapCurves c = gap_curves_of(plates);
      const std::vector<double> bound = sagittas(c.mesh.nodes, c.multiplier), exact = distances(c, height);
      for (std::size_t e = 0; e < bound.size(); ++e) EXPECT_LE(exact[e], 2 * bound[e]) << n << " " << e;
      EXPECT_LE(*std::max_element(bound.begin(), bound.end()), 20 * *std::max_element(exact.begin(), exact.end())) << n;
    }
}

// Middle nodes at half the way in x1: the edges are the parabola, and the estimate falls faster than h^3.
TEST(Sagittas, OfAParabolaInQuadraticEdgesFallAtTheFourthOrder) {
  const auto largest = [](int n) {
    TwoPlates plates;
    plates.height = [](double x) { return 0.2 + x - 1.25 * x * x; };
    plates.n_upper = plates.n_lower = n;
    const GapCurves c = gap_curves_of(plates);
    const std::vector<double> list = sagittas(c.mesh.nodes, c.multiplier);
    return *std::max_element(list.begin(), list.end());
  };
  EXPECT_LE(largest(40), largest(20) / 12);
  EXPECT_LE(largest(80), largest(40) / 12);
}

TEST(OpenPlace, AClearanceOfAThousandthIsNotTheQuadraticMeshesOwn) {
  const GapCurves c = gap_curves_of(circle(20, 31, CellKind::quad8), 5e-4);
  EXPECT_TRUE(open_place(c.mesh.nodes, c, 1e-6));
}

TEST(OpenPlace, NoneBetweenTwoMeshesOfOneCurve) {
  for (const CellKind kind : {CellKind::quad4, CellKind::quad8, CellKind::tri3, CellKind::tri6})
    for (const auto& [n_upper, n_lower] : {std::pair(5, 8), {8, 5}, {4, 40}, {20, 31}}) {
      const GapCurves c = gap_curves_of(circle(n_upper, n_lower, kind));
      EXPECT_FALSE(open_place(c.mesh.nodes, c)) << n_upper << " " << n_lower;
      EXPECT_FALSE(open_place(c.mesh.nodes, c, 1e-6));
    }
}

TEST(OpenPlace, IsARealGap) {
  const double gap = 2e-3;  // on flat edges of 0.1 and 0.07 the limit is 1 % of the longer
  TwoPlates plates;
  plates.n_upper = 8;
  plates.n_lower = 12;
  const GapCurves c = gap_curves_of(plates, gap);
  const auto open = open_place(c.mesh.nodes, c);
  ASSERT_TRUE(open);
  EXPECT_NEAR(open->gap, gap, 1e-14);
  EXPECT_NEAR(open->limit, 1e-3, 1e-12);
  EXPECT_NEAR(open->position.y(), 0.3, 1e-12);
  EXPECT_FALSE(open_place(c.mesh.nodes, c, 0.021));
}

// Every second gap of an arc's meshes half of what they show, the others round-off of either sign.
TEST(OneLine, GapsThatAreNoneHaveNoSign) {
  GapCurves c = gap_curves_of(circle(20, 31, CellKind::quad4));
  c.geometry.multiplier = ContactLine(c.mesh.nodes, c.multiplier);
  c.geometry.opposite = ContactLine(c.mesh.nodes, c.opposite);
  c.geometry.gap = true;
  const double least = std::ranges::min(sagittas(c.mesh.nodes, c.multiplier));
  const auto one_line = [&](double first, double second) {
    for (std::size_t i = 0; i < c.points.size(); ++i) c.points[i].gap = i % 2 == 0 ? first : second;
    find_one_line(c.mesh.nodes, c);
    return std::ranges::count(c.geometry.one_line, 1);
  };
  EXPECT_EQ(one_line(least / 2, -least / 2), 31);
  EXPECT_EQ(one_line(least / 2, 1e-17), 0);
  EXPECT_EQ(one_line(least / 2, -1e-17), 0);
}

}  // namespace
}  // namespace mortise
