#include "contact/coupling.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "base/errors.hpp"
#include "base/vectors.hpp"
#include "contact/multiplier_space.hpp"
#include "fem/edges.hpp"
#include "mesh/body_points.hpp"
#include "mesh/thickness.hpp"
#include "support/two_plates.hpp"

namespace mortise {
namespace {

using test::TwoPlates;

struct Pair : ContactInterface {
  Mesh mesh;
};

Pair pair_of(const TwoPlates& plates, CouplingOptions options, const Constraints* constraints = nullptr,
             Integration integration = Integration::segments) {
  Pair p;
  p.mesh = test::mesh_of(plates);
  p.multiplier = contact_curve(p.mesh, boundary_index(p.mesh, "lower_contact"));
  p.opposite = contact_curve(p.mesh, boundary_index(p.mesh, "upper_contact"));
  p.points = contact_points(p.mesh.nodes, p, integration);
  p.coupling = couple(p.mesh, p, constraints ? *constraints : no_constraints(p.mesh), options);
  return p;
}

TwoPlates parabola(int n_upper, int n_lower) {
  TwoPlates plates;
  plates.height = [](double x) { return -1.25 * x * x + x + 0.2; };
  plates.n_upper = n_upper;
  plates.n_lower = n_lower;
  return plates;
}

constexpr Multipliers spaces[] = {Multipliers::quadratic, Multipliers::linear, Multipliers::dual};

TEST(Coupling, RigidTranslationsOpenNoGap) {
  for (const Multipliers space : spaces)
    for (const Integration integration : {Integration::segments, Integration::elements}) {
      const Pair p = pair_of(parabola(8, 11), {space, InitialGap::closed}, nullptr, integration);
      VecX u(p.coupling.B.cols());
      for (Eigen::Index i = 0; i < u.size(); ++i) u(i) = i % 2 ? 2.0 : -3.0;
      EXPECT_LE((p.coupling.B * u).cwiseQuotient(p.coupling.scale).cwiseAbs().maxCoeff(), 1e-13);
    }
}

TEST(Coupling, ForcesAndMomentsOfAnyMultipliersAreEqualAndOpposite) {
  for (const Multipliers space : spaces) {
    const Pair p = pair_of(parabola(7, 12), {space, InitialGap::measured});
    const VecX lambda = VecX::Random(p.coupling.B.rows());
    const VecX f = p.coupling.B.transpose() * lambda;
    Vec2 force = Vec2::Zero();
    double moment = 0, size = 0;
    for (Eigen::Index i = 0; i < p.mesh.nodes.rows(); ++i) {
      const Vec2 at = p.mesh.nodes.row(i).transpose(), on = f.segment<2>(2 * i);
      force += on;
      moment += at.x() * on.y() - at.y() * on.x();
      size += on.norm();
    }
    EXPECT_LE(force.norm(), 1e-14 * size);
    EXPECT_LE(std::abs(moment), 1e-13 * size);  // the pressure acts along the line that joins both points
  }
}

TEST(Coupling, RowsSumToTheLengthAndTheirScaleIsPositive) {
  for (const Multipliers space : spaces) {
    const Pair p = pair_of(parabola(7, 12), {space, InitialGap::closed});
    double sum = 0;  // each row is int psi ...: all of them together int 1
    for (const ContactPoint& c : p.points) sum += c.ds;
    EXPECT_NEAR(p.coupling.covered_length, sum, 1e-14);
    EXPECT_NEAR(sum, curve_length(p.mesh.nodes, p.multiplier), 1e-6);  // 3 Gauss points on curved edges
    EXPECT_GT(p.coupling.scale.minCoeff(), 0);
  }
}

TEST(Coupling, MeasuredGapOfPlatesApart) {
  TwoPlates plates;  // flat
  Pair p;
  p.mesh = test::mesh_of(plates);
  for (const Cell& cell : p.mesh.cells)
    if (cell.body == 0)
      for (int a = 0; a < node_count(cell.kind); ++a) {
        double& y = p.mesh.nodes(cell.nodes[a], 1);
        if (y < 0.31) y = 0.3 + 0.01 * 0.8;  // the contact nodes, once each
      }
  p.multiplier = contact_curve(p.mesh, boundary_index(p.mesh, "lower_contact"));
  p.opposite = contact_curve(p.mesh, boundary_index(p.mesh, "upper_contact"));
  p.points = contact_points(p.mesh.nodes, p, Integration::segments);
  const Coupling c = couple(p.mesh, p, no_constraints(p.mesh), {Multipliers::linear, InitialGap::measured});
  EXPECT_NEAR(c.gap_min, 0.008, 1e-14);
  EXPECT_NEAR(c.gap_max, 0.008, 1e-14);
  for (Eigen::Index r = 0; r < c.gap0.size(); ++r) EXPECT_NEAR(c.gap0(r), 0.008 * c.scale(r), 1e-15);  // psi >= 0
}

// ---- The curves that the meshes stand for ----

std::vector<ContactPoint> points_on_lines(const Mesh& mesh, const Curve& multiplier, const Curve& opposite) {
  ContactInterface interface {
    multiplier, opposite, {}, {}, {}
  };
  interface.geometry = {ContactLine(mesh.nodes, multiplier), ContactLine(mesh.nodes, opposite), true, true};
  return contact_points(mesh.nodes, interface, Integration::segments);
}

double largest_gap(const std::vector<ContactPoint>& points) {
  double largest = 0;
  for (const ContactPoint& c : points) largest = std::max(largest, std::abs(c.gap));
  return largest;
}

TEST(ContactGeometry, OneCurveHasNoGapOnTwoMeshes) {
  for (const CellKind kind : {CellKind::quad8, CellKind::quad4}) {
    double before = 0;
    for (const int n : {10, 20, 40, 80}) {
      TwoPlates plates = parabola(n, n * 5 / 4);
      plates.height = [](double x) { return 0.1 * (std::sqrt(9 + 80 * x - 100 * x * x) - 1); };
      plates.kind_upper = plates.kind_lower = kind;
      const Pair p = pair_of(plates, {Multipliers::linear, InitialGap::measured});
      const double gap = largest_gap(points_on_lines(p.mesh, p.multiplier, p.opposite));
      EXPECT_LE(gap, 0.3 * largest_gap(p.points)) << n;
      if (n > 20) EXPECT_GE(std::log2(before / gap), 3.5) << n;  // of the edges: 2 or 3
      before = gap;
    }
  }
}

TEST(ContactGeometry, AGapThatIsDrawnKeepsItsSize) {
  TwoPlates plates = parabola(40, 50);
  for (const double drawn : {1e-3, -1e-3}) {
    Pair p;
    p.mesh = test::mesh_of(plates);
    const int upper = body_index(p.mesh, "upper");
    std::vector<char> moved(p.mesh.nodes.rows(), 0);
    for (const Cell& cell : p.mesh.cells)
      for (int a = 0; a < node_count(cell.kind); ++a)
        if (cell.body == upper && !moved[cell.nodes[a]]++) p.mesh.nodes(cell.nodes[a], 1) += drawn;
    p.multiplier = contact_curve(p.mesh, boundary_index(p.mesh, "lower_contact"));
    p.opposite = contact_curve(p.mesh, boundary_index(p.mesh, "upper_contact"));
    for (const ContactPoint& c : points_on_lines(p.mesh, p.multiplier, p.opposite)) {
      const double x = edge_point(p.mesh.nodes, p.multiplier.edges[c.edge], c.xi).position.x();
      const double slope = 1 - 2.5 * x, vertical = drawn / std::sqrt(1 + slope * slope);
      EXPECT_NEAR(c.gap, vertical, 2e-3 * std::abs(drawn));  // of a parabola moved up by `drawn`, along its normal
    }
  }
}

TEST(ContactGeometry, ForcesAndMomentsStayEqualAndOpposite) {
  const Pair p = pair_of(parabola(7, 12), {Multipliers::quadratic, InitialGap::measured});
  for (const ContactPoint& c : points_on_lines(p.mesh, p.multiplier, p.opposite)) {
    const Vec2 x = edge_point(p.mesh.nodes, p.multiplier.edges[c.edge], c.xi).position;
    const Vec2 y = edge_point(p.mesh.nodes, p.opposite.edges[c.opposite_edge], c.eta).position;
    EXPECT_LE(std::abs(cross(y - x, c.normal)), 1e-14);  // both points on one line along the normal
  }
}

TEST(DualMultipliers, AreBiorthogonalAlsoOnPartOfAnEdge) {
  const Pair p = pair_of(parabola(7, 12), {Multipliers::dual, InitialGap::closed});
  std::vector<ContactPoint> part;
  for (const ContactPoint& c : p.points)
    if (c.edge == 3 && c.xi < 0.4) part.push_back(c);
  ASSERT_GE(part.size(), 3u);
  const EdgeMultipliers dual = edge_multipliers(p.multiplier.edges[3], Multipliers::dual, part);
  Eigen::Matrix3d D = Eigen::Matrix3d::Zero();
  Eigen::Vector3d weight = Eigen::Vector3d::Zero();
  for (const ContactPoint& c : part) {
    const EdgeShape s = edge_shape(3, c.xi);
    const Eigen::Vector3d N(s.N[0], s.N[1], s.N[2]);
    D += c.ds * dual.shape(c.xi) * N.transpose();
    weight += c.ds * N;
  }
  EXPECT_LE((D - Eigen::Matrix3d(weight.asDiagonal())).cwiseAbs().maxCoeff(), 1e-12 * weight.cwiseAbs().maxCoeff());
}

TEST(DualMultipliers, AreTheStandardOnesWhereASliverOfTheEdgeCannotTellThemApart) {
  const Pair p = pair_of(parabola(7, 12), {Multipliers::dual, InitialGap::closed});
  std::vector<ContactPoint> sliver(3, p.points.front());
  for (int i = 0; i < 3; ++i) sliver[std::size_t(i)].xi = -1 + 1e-3 * i;
  const EdgeMultipliers dual = edge_multipliers(p.multiplier.edges[sliver[0].edge], Multipliers::dual, sliver);
  EXPECT_EQ(dual.A, Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
}

TEST(Dropped, EndsHeldOnBothSidesShareTheirNeighboursRow) {
  TwoPlates plates;
  Mesh mesh = test::mesh_of(plates);
  Constraints held = no_constraints(mesh);
  for (const char* wall : {"upper_left", "lower_left"})
    for (int c = 0; c < 2; ++c) prescribe(mesh, boundary_index(mesh, wall), c, 0, held);
  const Pair free = pair_of(plates, {}), tied = pair_of(plates, {}, &held);
  ASSERT_EQ(tied.coupling.dropped.size(), 1u);
  EXPECT_EQ(mesh.nodes(tied.coupling.node[tied.coupling.dropped[0].multiplier], 0), 0);
  EXPECT_EQ(tied.coupling.B.rows(), free.coupling.B.rows() - 1);
  const VecX values = multiplier_values(tied.coupling, VecX::LinSpaced(tied.coupling.B.rows(), 1, 2));
  EXPECT_GT(values.minCoeff(), 0);  // the tied one has its neighbour's value
}

TEST(Dropped, MultipliersThatFaceNothingAreZeroAndNamed) {
  TwoPlates plates;
  Pair p;
  p.mesh = test::mesh_of(plates);
  std::vector<char> moved(p.mesh.nodes.rows(), 0);
  for (const Cell& cell : p.mesh.cells)
    for (int a = 0; a < node_count(cell.kind) && cell.body == 0; ++a) moved[cell.nodes[a]] = 1;
  for (Eigen::Index i = 0; i < p.mesh.nodes.rows(); ++i)
    if (moved[i]) p.mesh.nodes(i, 0) += 0.3;
  p.multiplier = contact_curve(p.mesh, boundary_index(p.mesh, "lower_contact"));
  p.opposite = contact_curve(p.mesh, boundary_index(p.mesh, "upper_contact"));
  p.points = contact_points(p.mesh.nodes, p, Integration::segments);
  const Coupling c = couple(p.mesh, p, no_constraints(p.mesh), {});
  EXPECT_EQ(c.dropped.size(), 4u);  // vertices at 0, 1/11, 2/11, 3/11 of 0.8; the one at 4/11 = 0.29 still counts
  EXPECT_NEAR(c.covered_length, 0.5, 1e-12);
}

// Of the first multiplier on the axis, 1 - r / h: 2 pi int (1 - r / h) r^3 dr, and of its neighbour.
TEST(Coupling, AQuadraticGapIsExactAlsoOnTheAxisOfRings) {
  for (const CellKind kind : {CellKind::quad4, CellKind::quad8}) {
    TwoPlates plates;
    plates.kind_lower = plates.kind_upper = kind;
    Pair p;
    p.mesh = test::mesh_of(plates);
    p.geometry.model = {.plane = Plane::axisymmetric};
    p.multiplier = contact_curve(p.mesh, boundary_index(p.mesh, "lower_contact"));
    p.opposite = contact_curve(p.mesh, boundary_index(p.mesh, "upper_contact"));
    const double h = plates.width / plates.n_lower;
    double first = 0, second = 0;
    for (const ContactPoint& point : contact_points(p.mesh.nodes, p, Integration::segments)) {
      const double r = edge_point(p.mesh.nodes, p.multiplier.edges[point.edge], point.xi).position.x();
      if (r > h) continue;
      first += (1 - r / h) * r * r * point.dA;
      second += r / h * r * r * point.dA;
    }
    EXPECT_NEAR(first / (2 * std::numbers::pi * std::pow(h, 4) / 20), 1, 1e-12);
    EXPECT_NEAR(second / (2 * std::numbers::pi * std::pow(h, 4) / 5), 1, 1e-12);
  }
}

TEST(Coupling, CurvesThatDoNotFaceAreAnError) {
  const Mesh mesh = test::mesh_of({});
  Curve top = contact_curve(mesh, boundary_index(mesh, "top")),
        bottom = contact_curve(mesh, boundary_index(mesh, "bottom"));
  const Thickness thickness(mesh.nodes, boundary_edges(mesh), bonded_to(mesh, body_points(mesh)));
  for (Curve* c : {&top, &bottom}) c->thickness = thickness.behind(*c);
  const ContactInterface interface {
    top, bottom, {}, {}, {}
  };
  EXPECT_TRUE(contact_points(mesh.nodes, interface, Integration::segments).empty());
  EXPECT_THROW(couple(mesh, interface, no_constraints(mesh), {}), InputError);
}

TEST(Coupling, EveryRowsWeightIsPositiveHoweverLittleOfAnEdgeFaces) {
  // The opposite side ends inside an edge of the multiplier side, at any place of it: int psi, which is what a gap of 1
  // makes of a row, must have the sign of a gap.
  for (const Multipliers space : spaces)
    for (const double shift : {1e-3, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07}) {
      TwoPlates plates;
      plates.n_upper = plates.n_lower = 10;
      Pair p = pair_of(plates, {space, InitialGap::measured});
      for (const Cell& cell : p.mesh.cells)
        for (int a = 0; a < node_count(cell.kind); ++a)
          if (double& x = p.mesh.nodes(cell.nodes[a], 0); cell.body == 0 && x < 10) x += 10 - shift;
      for (Eigen::Index i = 0; i < p.mesh.nodes.rows(); ++i)
        if (p.mesh.nodes(i, 0) > 9) p.mesh.nodes(i, 0) -= 10;
      p.points = contact_points(p.mesh.nodes, p, Integration::segments);
      for (ContactPoint& point : p.points) point.gap = 1;
      const Coupling c = couple(p.mesh, p, no_constraints(p.mesh), {space, InitialGap::measured});
      EXPECT_GE(c.gap0.cwiseQuotient(c.scale).minCoeff(), 0.02) << "shift " << shift;
      EXPECT_NEAR(c.gap0.sum(), c.covered_length, 1e-12);  // psi sum to one
    }
}

}  // namespace
}  // namespace mortise
