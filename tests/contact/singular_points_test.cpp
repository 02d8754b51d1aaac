// Which points of two plates' contact line are singular, and how much.
#include "contact/singular_points.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "base/vectors.hpp"
#include "model/moduli.hpp"
#include "support/drawn_foot.hpp"
#include "support/points_of_pair.hpp"
#include "support/two_plates.hpp"
#include "support/wedges.hpp"

namespace mortise {
namespace {

using test::draw;
using test::draw_power;
using test::end_exponents;
using test::kink_exponents;
using test::points_of_pair;
using test::reached_everywhere;
using test::TwoPlates;
using test::wedge_exponent;

constexpr double deg = std::numbers::pi / 180;

struct Sides {
  std::vector<std::string> names;  // of boundaries
  std::vector<int> components;
};

std::vector<SingularPoint> points_of(const TwoPlates& plates, const Sides& held) {
  const Mesh mesh = test::mesh_of(plates);
  Constraints constraints = no_constraints(mesh);
  for (const std::string& name : held.names)
    for (const int c : held.components) prescribe(mesh, boundary_index(mesh, name), c, 0, constraints);
  const std::vector<ElasticLaw> laws(2, elastic_law(210e9, 0.3, {Plane::strain}));
  TipTable tips;
  const Curve lower = contact_curve(mesh, boundary_index(mesh, "lower_contact")),
              upper = contact_curve(mesh, boundary_index(mesh, "upper_contact"));
  return points_of_pair({mesh, SideTable(mesh), TiedVertices(), constraints, laws, tips}, lower, upper,
                        reached_everywhere(lower, upper));
}

const std::vector<std::string> all_sides{"upper_left", "upper_right", "lower_left", "lower_right"};

Wedge steel_wedge(double angle, Face outer) { return wedge(angle, elastic_law(210e9, 0.3, {Plane::strain}), outer); }

TEST(SingularPoints, OfABodyAloneAreItsCornersByWhatHoldsThem) {
  const Mesh mesh = test::mesh_of(TwoPlates{});
  const std::vector<ElasticLaw> laws(2, elastic_law(210e9, 0.3, {Plane::strain}));
  TipTable tips;
  const auto exponent_at = [&](int node, const Constraints& constraints) {
    return corner_exponent({mesh, SideTable(mesh), TiedVertices(), constraints, laws, tips}, node);
  };
  Constraints constraints = no_constraints(mesh);
  const Curve side = contact_curve(mesh, boundary_index(mesh, "lower_left"));
  const int corner = side.edges.front().nodes[0], middle = side.edges.front().nodes[1];
  EXPECT_EQ(exponent_at(corner, constraints), 1);
  EXPECT_EQ(exponent_at(middle, constraints), 1);
  for (const int c : {0, 1}) prescribe(mesh, boundary_index(mesh, "lower_left"), c, 0, constraints);
  EXPECT_NEAR(exponent_at(corner, constraints), wedge_exponent(steel_wedge(90 * deg, Face::free), Face::clamped).real(),
              1e-9);
  EXPECT_EQ(exponent_at(middle, constraints), 1);
}

TEST(SingularPoints, OfAFlatLineBetweenFreeOrSlidingSidesThereAreNone) {
  EXPECT_TRUE(points_of({}, {}).empty());
  EXPECT_TRUE(points_of({}, {all_sides, {0}}).empty());
}

TEST(SingularPoints, BetweenClampedSidesOnlyTheBodiesStressIs) {
  const auto points = points_of({}, {all_sides, {0, 1}});
  ASSERT_EQ(points.size(), 2u);
  for (const SingularPoint& p : points) {
    EXPECT_EQ(p.meeting, Meeting::ends);
    EXPECT_NEAR(p.exponent, wedge_exponent(steel_wedge(90 * deg, Face::free), Face::clamped).real(), 1e-9);
    EXPECT_EQ(p.pressure_exponent, 1);
  }
}

// Only the side beside the line says what holds the end, not the end node, which the bottom of a plate may share.
TEST(SingularPoints, WhatHoldsAnEndIsTheSideBesideIt) {
  const auto points = points_of({}, {{"lower_left"}, {0, 1}});
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].position.x(), 0, 1e-15);
  EXPECT_NEAR(points[0].exponent,
              end_exponents(steel_wedge(90 * deg, Face::clamped), steel_wedge(90 * deg, Face::free)).stress.real(),
              1e-9);
}

// Moves a body along x.
void push(Mesh& mesh, int body, double by) {
  std::set<int> nodes;
  for (const Cell& cell : mesh.cells)
    if (cell.body == body) nodes.insert(cell.nodes.begin(), cell.nodes.begin() + node_count(cell.kind));
  for (const int node : nodes) mesh.nodes(node, 0) += by;
}

// A body that ends within the other's edge, nearer to its vertex or not, ends on a straight side.
TEST(SingularPoints, AnEndWithinTheOthersEdgeIsNoMeetingOfCorners) {
  TwoPlates plates;
  plates.n_upper = plates.n_lower = 8;
  const double exact =
      end_exponents(steel_wedge(90 * deg, Face::free), steel_wedge(180 * deg, Face::free)).pressure.real();
  for (const double edges : {0.1, 0.4, 0.6}) {
    Mesh mesh = test::mesh_of(plates);
    const Curve upper = contact_curve(mesh, boundary_index(mesh, "upper_contact")),
                lower = contact_curve(mesh, boundary_index(mesh, "lower_contact"));
    push(mesh, upper.body, edges * 0.1);
    const std::vector<ElasticLaw> laws(2, elastic_law(210e9, 0.3, {Plane::strain}));
    TipTable tips;
    const auto points = points_of_pair({mesh, SideTable(mesh), TiedVertices(), no_constraints(mesh), laws, tips}, lower,
                                       upper, reached_everywhere(lower, upper));
    const auto end = std::ranges::find_if(
        points, [&](const SingularPoint& p) { return std::abs(p.position.x() - edges * 0.1) < 1e-12; });
    ASSERT_NE(end, points.end()) << edges;
    EXPECT_NEAR(end->pressure_exponent, exact, 1e-9) << edges;
  }
}

// Bodies with directions, one pushed along the other, the drawing turned with its materials: each end of the line is
// the upper plate's corner on the lower one or the lower one's under the upper, faces as they lie, whichever curve is
// first.
TEST(SingularPoints, KnowHowBodiesWithDirectionsLie) {
  std::mt19937 random(8);
  const OrthotropicModuli wood{12, 1, 0.8, 0.4, 0.35, 0.5, 0.7};
  for (int i = 0; i < 30; ++i) {
    TwoPlates plates;
    plates.n_upper = plates.n_lower = 8;
    const double shift = draw(random, -0.6, 0.6), turn = i == 0 ? 0 : draw(random, -3, 3),
                 axes[] = {0.5, draw(random, -1, 1)};
    Mesh mesh = test::mesh_of(plates);
    const Curve upper = contact_curve(mesh, boundary_index(mesh, "upper_contact")),
                lower = contact_curve(mesh, boundary_index(mesh, "lower_contact"));
    push(mesh, upper.body, shift);
    mesh.nodes = mesh.nodes * Eigen::Rotation2Dd(turn).toRotationMatrix().transpose();
    std::vector<ElasticLaw> laws(2, elastic_law(1, 0.3, {Plane::strain}));
    for (const int k : {0, 1}) {
      OrthotropicModuli moduli = wood;
      moduli.angle = axes[k] + turn;
      laws[k == 0 ? upper.body : lower.body] = elastic_law(*orthotropic_stiffness(moduli), {Plane::strain}, 1);
    }
    const auto above = [&](double from, double angle) {
      return wedge(angle * deg, laws[upper.body], Face::free, from * deg + turn);
    };
    const auto below = [&](double from, double angle) {
      return wedge(angle * deg, laws[lower.body], Face::free, from * deg + turn);
    };
    // Counter-clockwise, the joint on the right of the place or on its left.
    const bool right = shift > 0;
    const double at_left = end_exponents(right ? below(180, 180) : below(270, 90), right ? above(0, 90) : above(0, 180))
                               .stress.real(),
                 at_right =
                     end_exponents(right ? above(0, 180) : above(90, 90), right ? below(180, 90) : below(180, 180))
                         .stress.real();
    TipTable tips;
    const Surroundings around{mesh, SideTable(mesh), TiedVertices(), no_constraints(mesh), laws, tips};
    for (const bool lower_first : {true, false}) {
      const Curve &first = lower_first ? lower : upper, &second = lower_first ? upper : lower;
      const auto points = points_of_pair(around, first, second, reached_everywhere(first, second));
      std::vector<double> found;
      for (const SingularPoint& p : points) found.push_back(p.exponent);
      std::vector<double> expected;
      for (const double e : {at_left, at_right})
        if (e <= singular_limit) expected.push_back(e);
      std::ranges::sort(found);
      std::ranges::sort(expected);
      ASSERT_EQ(found.size(), expected.size()) << i;
      for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-8) << i;
    }
  }
}

// An arc drawn in both bodies, contact up to a vertex in the middle of it: however short its edges are and wherever it
// is, the round-off of its places is no kink.
TEST(SingularPoints, AreNotMadeByRoundOffOfDrawnArcs) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> exponent(-4, 0), place(-40, 40), angle(-3, 3);
  const Mesh flat = test::mesh_of({});
  const double y0 = flat.nodes(contact_curve(flat, boundary_index(flat, "lower_contact")).edges[0].nodes[0], 1);
  const std::vector<ElasticLaw> laws(2, elastic_law(210e9, 0.3, {Plane::strain}));
  TipTable tips;
  for (int i = 0; i < 100; ++i) {
    const double scale = std::pow(10, exponent(random)), radius = 10 + std::abs(place(random)), start = angle(random);
    const Vec2 centre(place(random), place(random));
    const auto at = [&](double t, double r) { return Vec2(centre + r * Vec2(std::sin(t), std::cos(t))); };
    const auto turn = [&](int node) { return start + scale * flat.nodes(node, 0) / radius; };
    Mesh mesh = flat;
    for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n)
      mesh.nodes.row(n) = at(turn(int(n)), radius + scale * (flat.nodes(n, 1) - y0)).transpose();
    std::vector<Curve> curves;
    ContactReach reach;
    for (const char* name : {"lower_contact", "upper_contact"}) {
      Curve& curve = curves.emplace_back(contact_curve(mesh, boundary_index(mesh, name)));
      std::vector<std::array<double, 2>> ends;
      for (const Edge& edge : curve.edges) ends.push_back({turn(edge.nodes[0]), turn(edge.nodes[1])});
      curve.samples = sample_edges(
          [&](const std::vector<double>& turns) {
            std::vector<Vec2> places;
            for (const double t : turns) places.push_back(at(t, radius));
            return places;
          },
          ends);
      std::vector<Reach> reached(curve.edges.size() + 1, {false, false});
      for (std::size_t v = 0; v < reached.size(); ++v) {  // where x is less than that of a vertex
        const auto inside = [&](std::size_t edge) {
          return edge < curve.edges.size() &&
                 std::max(flat.nodes(curve.edges[edge].nodes[0], 0), flat.nodes(curve.edges[edge].nodes[1], 0)) < 0.5;
        };
        reached[v] = {v > 0 && inside(v - 1), inside(v)};
      }
      reach[curves.size() - 1] = reached;
    }
    const auto points = points_of_pair({mesh, SideTable(mesh), TiedVertices(), no_constraints(mesh), laws, tips},
                                       curves[0], curves[1], reach);
    EXPECT_TRUE(points.empty()) << i << ": edges of " << scale << " times the plates'";
  }
}

// The preprint's parabola has slopes 1 and -1 at its ends, with elements of any kind, and no corner between them.
TEST(SingularPoints, AParabolaMeetsItsSlidingSidesAtTheAnglesOfTheCurve) {
  TwoPlates plates;
  plates.height = [](double x) { return 0.2 + x - 1.25 * x * x; };
  for (const CellKind kind : {CellKind::quad4, CellKind::tri3, CellKind::quad8}) {
    plates.kind_upper = plates.kind_lower = kind;
    const auto points = points_of(plates, {all_sides, {0}});
    ASSERT_EQ(points.size(), 2u);
    const double exact =
        end_exponents(steel_wedge(45 * deg, Face::symmetric), steel_wedge(135 * deg, Face::symmetric)).pressure.real();
    for (const SingularPoint& p : points) {
      EXPECT_NEAR(p.exponent, exact, 2e-3);  // rebuilt through 8 and 12 vertices; by the chords 0.05
      EXPECT_EQ(p.exponent, p.pressure_exponent);
    }
  }
}

TEST(SingularPoints, AKinkOfBothPlatesIsOnePointWithBothFacesShared) {
  TwoPlates plates;
  plates.height = [](double x) { return 0.4 - std::abs(x - 0.4) / 2; };
  plates.n_upper = 8;
  plates.n_lower = 12;
  const auto points = points_of(plates, {all_sides, {0}});
  ASSERT_EQ(points.size(), 3u);
  const auto kink = std::ranges::find(points, Meeting::kink, &SingularPoint::meeting);
  ASSERT_NE(kink, points.end());
  const double turn = 2 * std::atan(0.5), half_turn = turn / 2, straight = std::numbers::pi;
  EXPECT_NEAR(kink->position.x(), 0.4, 1e-12);
  EXPECT_NEAR(kink->wedges[0].angle, straight - turn, 1e-9);
  EXPECT_NEAR(kink->wedges[1].angle, straight + turn, 1e-9);
  // Its symmetric modes are those of an end beside a sliding side; the lowest mode is antisymmetric.
  const double beside = points[kink == points.begin() ? 1 : 0].exponent;
  EXPECT_NEAR(kink_exponents(kink->wedges[0], kink->wedges[1], Face::symmetric).stress.real(), beside, 1e-9);
  EXPECT_NEAR(kink->exponent,
              end_exponents(steel_wedge(straight / 2 - half_turn, Face::antisymmetric),
                            steel_wedge(straight / 2 + half_turn, Face::antisymmetric))
                  .stress.real(),
              1e-9);
}

// The lower plate's top stays flat, the upper plate's foot is a wedge about x = middle, of slope `slope` on both sides.
struct WedgeOnFlat {
  double slope, middle;
  double gap = 0;
};

std::vector<SingularPoint> points_of(const WedgeOnFlat& wedge, const std::vector<Reach>& upper_reach,
                                     const Sides& held) {
  TwoPlates plates;
  plates.height = [](double) { return 0.3; };
  plates.n_upper = plates.n_lower = 8;
  Mesh mesh = test::mesh_of(plates);
  const Curve upper = contact_curve(mesh, boundary_index(mesh, "upper_contact"));
  for (const int node : curve_nodes(upper))
    mesh.nodes(node, 1) += wedge.gap + wedge.slope * std::abs(mesh.nodes(node, 0) - wedge.middle);
  Constraints constraints = no_constraints(mesh);
  for (const std::string& name : held.names)
    for (const int c : held.components) prescribe(mesh, boundary_index(mesh, name), c, 0, constraints);
  const std::vector<ElasticLaw> laws(2, elastic_law(210e9, 0.3, {Plane::strain}));
  TipTable tips;
  const Curve lower = contact_curve(mesh, boundary_index(mesh, "lower_contact"));
  ContactReach reach = reached_everywhere(lower, upper);
  for (Reach& at : reach[0]) at = {false, false};
  if (!upper_reach.empty()) reach[1] = upper_reach;
  return points_of_pair({mesh, SideTable(mesh), TiedVertices(), constraints, laws, tips}, lower, upper, reach);
}

// Johnson (1985), section 5.2: p = E* slope / pi arccosh(a / x), whose logarithm has half of what a cone's has.
TEST(SingularPoints, UnderAWedgeOnAFlatPressureGrowsAsTheLogarithm) {
  const double stiffness = 210e9 / (1 - 0.09) / 2;
  for (const double slope : {0.05, 2e-3})
    for (const double gap : {0.0, 0.2}) {  // however far it is drawn
      const auto points = points_of({slope, 0.4, gap}, std::vector<Reach>(9, {true, true}), {});
      const auto tip = std::ranges::find_if(points, [](const SingularPoint& p) { return p.log_pressure > 0; });
      ASSERT_NE(tip, points.end());
      EXPECT_EQ(tip->pressure_exponent, 1);
      EXPECT_NEAR(tip->position.x(), 0.4, 1e-12);
      EXPECT_NEAR(tip->log_pressure, stiffness * 2 * std::atan(slope) / 4, 1e-3 * tip->log_pressure);
    }
}

TEST(SingularPoints, UnderACornerPressedOnOneFaceItIsThatOfAWedge) {
  std::vector<Reach> reach(9, {false, false});
  reach[4] = {true, false};
  const auto points = points_of({0.5, 0.4}, reach, {});
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].log_pressure, 0);
  const double angle = 180 - 2 * std::atan(0.5) / deg;
  EXPECT_NEAR(points[0].pressure_exponent,
              end_exponents(steel_wedge(angle * deg, Face::free), steel_wedge(180 * deg, Face::free)).pressure.real(),
              1e-3);
}

// Exponents of 0.95 and more do not tell: p falls to zero as a power of the distance under a corner of 75 degrees.
TEST(SingularPoints, UnderASharpCornerPressedOnOneFaceItIsASmallPower) {
  std::vector<Reach> reach(9, {false, false});
  reach[4] = {true, false};
  const double slope = 1.3, angle = 180 * deg - 2 * std::atan(slope);
  const Fan fan = end_fan(steel_wedge(angle, Face::free), steel_wedge(180 * deg, Face::free));
  const auto points = points_of({slope, 0.4}, reach, {});
  ASSERT_EQ(points.size(), 1u);
  EXPECT_GT(points[0].small_power, 0.05);
  EXPECT_NEAR(points[0].small_power, exponents(fan, 0).falling - 1, 1e-3);
}

TEST(SingularPoints, WhatContactDoesNotReachIsNone) {
  EXPECT_TRUE(points_of({0.5, 0.4}, std::vector<Reach>(9, {false, false}), {}).empty());
}

// Half a wedge beside its line of symmetry.
TEST(SingularPoints, AWedgesTipOnASymmetryLineIsOne) {
  const auto points = points_of({0.05, 0}, std::vector<Reach>(9, {true, true}), {all_sides, {0}});
  ASSERT_FALSE(points.empty());
  EXPECT_NEAR(points[0].position.x(), 0, 1e-12);
  EXPECT_NEAR(points[0].log_pressure, 210e9 / (1 - 0.09) / 2 * 2 * std::atan(0.05) / 4, 1e-3 * points[0].log_pressure);
}

}  // namespace
}  // namespace mortise
