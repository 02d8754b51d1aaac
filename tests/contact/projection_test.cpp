#include "contact/projection.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "contact/gap_cuts.hpp"
#include "contact/least_gap.hpp"
#include "contact/segments.hpp"
#include "fem/edges.hpp"
#include "mesh/thickness.hpp"
#include "support/two_plates.hpp"

namespace mortise {
namespace {

// One straight edge from (1, 0) to (0, 0): its body lies below, its normal points up.
struct StraightEdge {
  Points nodes = (Points(2, 2) << 1, 0, 0, 0).finished();
  Curve curve{0, 0, {{2, {0, 1, -1}}}, {}, false};
};

// A quadratic edge through (1, 0), (0.5, 0.1), (0, 0).
struct BentEdge {
  Points nodes = (Points(3, 2) << 1, 0, 0, 0, 0.5, 0.1).finished();
  Curve curve{0, 0, {{3, {0, 1, 2}}}, {}, false};
};

TEST(Projection, HitsAStraightEdgeWhereExpected) {
  const StraightEdge e;
  const auto hit = project_onto_edge(e.nodes, e.curve, 0, {Vec2(0.25, 2), Vec2(0, -1), 1});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->xi, 0.5, 1e-15);
  EXPECT_NEAR(hit->distance, 2, 1e-15);
}

TEST(Projection, AlongAnInclinedLineAndFromBehind) {
  const StraightEdge e;
  const Vec2 n = Vec2(1, -1).normalized();
  const auto hit = project_onto_edge(e.nodes, e.curve, 0, {Vec2(0.2, 0.3), n, 1});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->xi, 0, 1e-14);
  EXPECT_NEAR(hit->distance, 0.3 * std::sqrt(2), 1e-14);
  EXPECT_NEAR(project_onto_edge(e.nodes, e.curve, 0, {Vec2(0.5, -0.1), Vec2(0, -1), 1})->distance, -0.1, 1e-15);
}

TEST(Projection, IgnoresWhatDoesNotFaceOrLiesDeeperThanItsLineOrEdgeAllows) {
  StraightEdge e;
  EXPECT_FALSE(project_onto_edge(e.nodes, e.curve, 0, {Vec2(0.5, -1), Vec2(0, 1), 1}));  // its back
  EXPECT_FALSE(project_onto_edge(e.nodes, e.curve, 0, {Vec2(0.5, -1.1), Vec2(0, -1), 1}));
  EXPECT_TRUE(project_onto_edge(e.nodes, e.curve, 0, {Vec2(0.5, -1.1), Vec2(0, -1), 1.2}));
  EXPECT_FALSE(project_onto_edge(e.nodes, e.curve, 0, {Vec2(1.1, 1), Vec2(0, -1), 1}));  // beside it
  e.curve.thickness = {2};                                                               // of which half
  EXPECT_FALSE(project_onto_edge(e.nodes, e.curve, 0, {Vec2(0.5, -1.1), Vec2(0, -1), 1.2}));
  EXPECT_TRUE(project_onto_edge(e.nodes, e.curve, 0, {Vec2(0.5, -0.9), Vec2(0, -1), 1.2}));
}

// A corner of another body stands on the side face of the first, inside the first's height: what lies on an outline is
// not outside it, however its place is rounded.
TEST(Projection, ABodyHidesNothingOnItsOutline) {
  const Points nodes = (Points(4, 2) << 0, 0, 1, 0, 1, 1, 0, 1).finished();
  const auto edge = [](int start) { return Edge{2, {start, (start + 1) % 4, -1}}; };
  Curve top{0, 0, {edge(2)}, {}, false};
  top.outline = std::make_shared<BodyOutline>(nodes, std::vector<Edge>{edge(0), edge(1), edge(2), edge(3)});
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(0.01, 0.4);
  for (int k = 0; k < 200; ++k) {
    const double aside = part(random), down = part(random);
    const Vec2 n = Vec2(aside, -down).normalized(), corner(1, 1 - down);
    EXPECT_TRUE(project_onto_edge(nodes, top, 0, {corner, n, 1})) << aside << ' ' << down;
    EXPECT_FALSE(project_onto_edge(nodes, top, 0, {corner + 1e-6 * n, n, 1}));
  }
}

TEST(Projection, EndsCountToTheTolerance) {
  const StraightEdge e;
  for (const double x : {0.0, 1.0, -1e-12, 1 + 1e-12})
    EXPECT_TRUE(project_onto_edge(e.nodes, e.curve, 0, {Vec2(x, 0), Vec2(0, -1), 1})) << x;
  EXPECT_FALSE(project_onto_edge(e.nodes, e.curve, 0, {Vec2(1 + 1e-8, 0), Vec2(0, -1), 1}));
}

TEST(Projection, OnABentEdgeTheHitLiesOnTheLine) {
  const BentEdge e;
  for (const double x : {0.01, 0.3, 0.77})
    for (const double slope : {-0.4, 0.0, 0.2}) {
      const Vec2 from(x, 0.5), n = Vec2(slope, -1).normalized();
      const auto hit = project_onto_edge(e.nodes, e.curve, 0, {from, n, 1});
      if (!hit) continue;
      const Vec2 at = edge_point(e.nodes, e.curve.edges[0], hit->xi).position;
      EXPECT_NEAR((at - from - hit->distance * n).norm(), 0, 1e-14);
    }
}

TEST(Foot, IsWhereTheNormalPassesThroughThePoint) {
  const BentEdge e;
  for (const double xi : {-0.99, -0.5, 0.0, 0.3, 0.9})
    for (const double away : {-0.05, 0.0, 1e-12, 0.2}) {
      const EdgePoint p = edge_point(e.nodes, e.curve.edges[0], xi);
      const auto foot = foot_on_edge(e.nodes, e.curve.edges[0], p.position + away * p.normal());
      ASSERT_TRUE(foot) << xi << " " << away;
      EXPECT_NEAR(*foot, xi, 1e-12);
    }
  EXPECT_FALSE(foot_on_edge(e.nodes, e.curve.edges[0], Vec2(2, 0)));
}

// Strongly bent edges too, on which Newton's method goes astray.
TEST(Foot, IsFoundWhereverTheOffsetChangesItsSign) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> part(-1, 1);
  int found = 0;
  for (int k = 0; k < 2000; ++k) {
    const Points nodes = (Points(3, 2) << 0, 0, 1, 0, 0.5 + 0.2 * part(random), 0.8 * part(random)).finished();
    const Edge edge{3, {0, 1, 2}};
    const Vec2 x(0.5 + part(random), part(random));
    const auto offset = [&](double xi) {
      const EdgePoint p = edge_point(nodes, edge, xi);
      return (x - p.position).dot(p.tangent);
    };
    const auto foot = foot_on_edge(nodes, edge, x);
    if (foot) {
      EXPECT_LE(std::abs(*foot), 1) << k;
      EXPECT_LE(std::abs(offset(*foot)), 1e-10) << k;
    }
    if (offset(-1) > 0 && offset(1) < 0) EXPECT_TRUE(foot) << k;
    found += foot.has_value();
  }
  EXPECT_GT(found, 500);
}

// An edge that goes past the line and comes back: start, middle and end lie on one side.
TEST(Projection, OfAnEdgeThatGoesPastTheLineAndBackIsWhereItFacesIt) {
  const Points nodes = (Points(3, 2) << -4, 0.2, -1, -0.2, -0.05, 0).finished();
  const Curve curve{0, 0, {{3, {0, 1, 2}}}, {}, false};
  const auto hit = project_onto_edge(nodes, curve, 0, {Vec2(0, 1), Vec2(0, -1), 10});
  ASSERT_TRUE(hit);
  const EdgePoint at = edge_point(nodes, curve.edges[0], hit->xi);
  EXPECT_NEAR(at.position.x(), 0, 1e-14);
  EXPECT_GT(at.normal().y(), 0);
  EXPECT_NEAR(hit->distance, 1 - at.position.y(), 1e-14);
}

// A curve that knows its lengths passes over edges that the line cannot meet: it must find what all edges give.
TEST(Projection, PassesOverNoEdgeThatTheLineMeets) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(-1, 1);
  int hits = 0;
  for (int k = 0; k < 200; ++k) {
    test::TwoPlates plates;  // waves of any height and length, with normals that meet one another and edges that bend
    const double height = 0.15 * part(random), waves = 20 * part(random);
    plates.height = [=](double x) { return 0.3 + height * std::sin(waves * x); };
    plates.n_upper = plates.n_lower = 1 + int(30 * std::abs(part(random)));
    plates.kind_lower = k % 2 ? CellKind::quad8 : CellKind::quad4;
    const Mesh mesh = test::mesh_of(plates);
    const Curve curve = contact_curve(mesh, boundary_index(mesh, "lower_contact"));
    Curve of_unknown_length = curve;
    of_unknown_length.along.clear();
    for (int i = 0; i < 20; ++i) {
      const Line line{Vec2(0.4 + part(random), 0.3 + 0.5 * part(random)), Vec2(part(random), part(random)).normalized(),
                      1};
      const auto hit = project_onto_curve(mesh.nodes, curve, line),
                 of_all = project_onto_curve(mesh.nodes, of_unknown_length, line);
      ASSERT_EQ(hit.has_value(), of_all.has_value()) << k << " " << i;
      if (!hit) continue;
      EXPECT_TRUE(hit->edge == of_all->edge && hit->xi == of_all->xi && hit->distance == of_all->distance)
          << k << " " << i;
      ++hits;
    }
  }
  EXPECT_GT(hits, 500);
}

// ---- Segments ----

using test::TwoPlates;

struct Curves {
  Mesh mesh;
  Curve upper, lower;
};

Curves curves_of(const TwoPlates& plates) {
  Curves c{test::mesh_of(plates), {}, {}};
  c.upper = contact_curve(c.mesh, boundary_index(c.mesh, "upper_contact"));
  c.lower = contact_curve(c.mesh, boundary_index(c.mesh, "lower_contact"));
  return c;
}

double covered(const std::vector<Segment>& segments, const Curves& c, const Curve& side) {
  double length = 0;
  for (const Segment& s : segments)
    length += length_to(c.mesh.nodes, side.edges[s.edge], s.end) - length_to(c.mesh.nodes, side.edges[s.edge], s.begin);
  return length;
}

TEST(Segments, OfFlatMeshesAreTheCommonRefinement) {
  const Curves c = curves_of({});  // 7 against 11 edges: 17 pieces
  const auto segments = find_segments(c.mesh.nodes, {c.lower, c.upper, {}, {}, {}});
  EXPECT_EQ(segments.size(), 17u);
  EXPECT_NEAR(covered(segments, c, c.lower), 0.8, 1e-15);
}

TEST(Segments, OfMatchingMeshesAreTheEdges) {
  TwoPlates plates;
  plates.height = [](double x) { return 0.3 + 0.1 * std::sin(7 * x); };
  plates.n_upper = plates.n_lower = 9;
  const Curves c = curves_of(plates);
  const auto segments = find_segments(c.mesh.nodes, {c.lower, c.upper, {}, {}, {}});
  ASSERT_EQ(segments.size(), 9u);
  for (const Segment& s : segments) EXPECT_EQ(s.end - s.begin, 2);
}

TEST(Segments, CoverACurvedLineFromBothSides) {
  TwoPlates plates;
  plates.height = [](double x) { return -1.875 * x * x + 1.5 * x + 0.1; };
  plates.n_upper = 13;
  plates.n_lower = 8;
  const Curves c = curves_of(plates);
  for (const auto& [side, other] : {std::pair(&c.lower, &c.upper), std::pair(&c.upper, &c.lower)}) {
    const auto segments = find_segments(c.mesh.nodes, {*side, *other, {}, {}, {}});
    EXPECT_NEAR(covered(segments, c, *side), curve_length(c.mesh.nodes, *side), 1e-12);
    for (std::size_t i = 1; i < segments.size(); ++i) EXPECT_GE(segments[i].edge, segments[i - 1].edge);
  }
}

TEST(Segments, CoverOnlyWhereTheCurvesFaceEachOther) {
  for (const auto& [edges, shift] : {std::pair(7, 0.13), {1, 0.13}, {7, -0.13}, {1, -0.13}}) {
    TwoPlates plates;
    plates.n_upper = edges;
    Curves c = curves_of(plates);
    // The upper plate pushed to the right by a quarter of an edge and more: the lower one sticks out on the left.
    const auto body = std::find(c.mesh.bodies.begin(), c.mesh.bodies.end(), "upper") - c.mesh.bodies.begin();
    std::vector<char> moved(c.mesh.nodes.rows(), 0);
    for (const Cell& cell : c.mesh.cells)
      if (cell.body == body)
        for (int a = 0; a < node_count(cell.kind); ++a) moved[cell.nodes[a]] = 1;
    for (Eigen::Index i = 0; i < c.mesh.nodes.rows(); ++i)
      if (moved[i]) c.mesh.nodes(i, 0) += shift;
    EXPECT_NEAR(covered(find_segments(c.mesh.nodes, {c.lower, c.upper, {}, {}, {}}), c, c.lower), 0.67, 1e-12);
    EXPECT_NEAR(covered(find_segments(c.mesh.nodes, {c.upper, c.lower, {}, {}, {}}), c, c.upper), 0.67, 1e-12);
  }
}

// From x = 1 to 0 along y = 0, in ten edges, and from 0 to 1 above it: along y = 0 up to 0.5, and from 0.5 + ramp on at
// a height.
struct Ramp {
  Points nodes{11 + 12, 2};
  Curve lower{0, 0, {}, {}, false}, upper{1, 1, {}, {}, false};

  Ramp(double ramp, double height) {
    for (int i = 0; i <= 10; ++i) nodes.row(i) << 1 - 0.1 * i, 0;
    for (int i = 0; i <= 5; ++i) {
      nodes.row(11 + i) << 0.1 * i, 0;
      nodes.row(17 + i) << 0.5 + ramp + 0.2 * i * (0.5 - ramp), height;
    }
    for (int i = 0; i < 10; ++i) lower.edges.push_back({2, {i, i + 1, -1}});
    for (int i = 11; i < 22; ++i) upper.edges.push_back({2, {i, i + 1, -1}});
  }

  // Of the lower one's ten edges, how many are covered up to steps.
  double covered() const {
    ContactInterface c{lower, upper, {}, {}, {}};
    c.geometry.multiplier = ContactLine(nodes, lower);
    c.geometry.opposite = ContactLine(nodes, upper);
    c.geometry.normals = true;
    double sum = 0;
    for (const Segment& s : up_to_steps(nodes, c, find_segments(nodes, c))) sum += (s.end - s.begin) / 2;
    return sum;
  }
};

// On the edge beside the corner, unless strains and turns of small displacements may close the gap within it.
TEST(Segments, EndAtStepsAndWhereTheGapRisesAtOnce) {
  EXPECT_NEAR(Ramp(1e-3, 0.01).covered(), 9, 1e-9);
  EXPECT_NEAR(Ramp(0.1, 0.1).covered(), 9, 1e-9);
  EXPECT_NEAR(Ramp(0.3, 0.01).covered(), 10, 1e-9);   // too flat
  EXPECT_NEAR(Ramp(1e-3, 1e-3).covered(), 10, 1e-9);  // not deep enough
  Ramp wedge(0.1, 0.1);
  for (int i = 11; i <= 22; ++i) wedge.nodes.row(i) << (i - 11) / 11., std::abs((i - 11) / 11. - 6 / 11.);
  EXPECT_NEAR(wedge.covered(), 10, 1e-9);  // as the gap opens both ways, from where contact begins
}

TEST(Segments, VerticesThatAlmostCoincideMakeNoSlivers) {
  for (const double shift : {1e-14, 1e-12, -1e-12, 1e-11}) {
    TwoPlates plates;
    plates.n_upper = plates.n_lower = 6;
    Curves c = curves_of(plates);
    for (const Edge& e : c.upper.edges)
      for (const int node : e.nodes)
        if (c.mesh.nodes(node, 0) > 0.01 && c.mesh.nodes(node, 0) < 0.79) c.mesh.nodes(node, 0) += shift;
    const auto segments = find_segments(c.mesh.nodes, {c.lower, c.upper, {}, {}, {}});
    EXPECT_EQ(segments.size(), 6u) << shift;
    EXPECT_NEAR(covered(segments, c, c.lower), 0.8, 1e-12);
  }
}

// A rim of `inner` edges in a hole of `outer`, both closed; the hole's edges begin with the `start`th.
struct RimInHole {
  Points nodes;
  Curve rim{0, 0, {}, {}, true}, hole{1, 1, {}, {}, true};

  RimInHole(int inner, int outer, int start) : nodes(inner + outer, 2) {
    const auto place = [&](int row, double angle) { nodes.row(row) << std::cos(angle), std::sin(angle); };
    for (int i = 0; i < inner; ++i) {
      place(i, 2 * std::numbers::pi * i / inner);
      rim.edges.push_back({2, {i, (i + 1) % inner, -1}});
    }
    for (int k = 0; k < outer; ++k) place(inner + k, 0.1 + 2 * std::numbers::pi * k / outer);
    for (int k = 0; k < outer; ++k) {  // against the rim: its body lies outside
      const int i = (start + outer - k) % outer;
      hole.edges.push_back({2, {inner + i, inner + (i + outer - 1) % outer, -1}});
    }
  }
};

TEST(Segments, DoNotDependOnWhereAClosedCurveBegins) {
  for (int start = 0; start < 23; ++start) {
    const RimInHole c(8, 23, start);
    const auto segments = find_segments(c.nodes, {c.rim, c.hole, {}, {}, {}});
    EXPECT_GE(segments.size(), 8u + 23u) << start;
    for (const Segment& s : segments) {  // each on the one opposite edge that its normals meet
      const Edge& other = c.hole.edges[s.opposite_edge];
      for (const double part : {0.1, 0.5, 0.9}) {
        const Line line = line_from(c.nodes, c.rim, s.edge, s.begin + part * (s.end - s.begin));
        EXPECT_TRUE(project_onto_edge(c.nodes, c.hole, s.opposite_edge, line)) << start << " " << other.nodes[0];
      }
    }
  }
}

// Away from either end, of a gap that is no straight line.
TEST(GapCuts, SlopesAtTheEndsAreThoseOfTheGivenGap) {
  const Curves c = curves_of({});
  ContactGeometry geometry;
  geometry.given = Field("x^2 + 3*x", {});
  const bool backwards = c.mesh.nodes(c.lower.edges[0].nodes[0], 0) > 0.4;
  auto slopes = gap_slopes_at_ends(c.mesh.nodes, c.lower, geometry);
  if (backwards) std::swap(slopes[0], slopes[1]);
  EXPECT_NEAR(slopes[0], 3, 1e-7);
  EXPECT_NEAR(slopes[1], -(2 * 0.8 + 3), 1e-7);
  geometry.given = Field(0.1);
  EXPECT_EQ(gap_slopes_at_ends(c.mesh.nodes, c.lower, geometry), (std::array<double, 2>{0, 0}));
}

TEST(GapCuts, AClosedCurveHasNoEndsAtWhichAGapCouldRise) {
  const RimInHole c(8, 23, 0);
  ContactGeometry geometry;
  geometry.given = Field("1 + x + 3*y", {});
  EXPECT_EQ(gap_slopes_at_ends(c.nodes, c.rim, geometry), (std::array<double, 2>{0, 0}));
}

// The upper plate comes down the more the farther right.
TEST(LeastGap, IsWhereTheSidesComeNearest) {
  const Curves c = curves_of({});
  ContactInterface pair{c.lower, c.upper, {}, {}, {}};
  pair.points = contact_points(c.mesh.nodes, pair, Integration::segments);
  VecX u = VecX::Zero(2 * c.mesh.nodes.rows());
  for (const int node : curve_nodes(c.upper)) u(2 * node + 1) = -0.1 * c.mesh.nodes(node, 0);
  double right = 0;
  for (const ContactPoint& p : pair.points)
    right = std::max(right, edge_point(c.mesh.nodes, c.lower.edges[p.edge], p.xi).position.x());
  const LeastGap least = least_gap(c.mesh.nodes, u, pair);
  EXPECT_NEAR(least.approach, 0.1 * right, 1e-15);
  EXPECT_NEAR(least.gap, -0.1 * right, 1e-15);
  EXPECT_NEAR(least.place.x(), right, 1e-15);
  EXPECT_NEAR(least.edge, 0.8 / double(c.lower.edges.size()), 1e-15);
  EXPECT_LE(least_gap(c.mesh.nodes, -u, pair).approach, 0);  // they part
}

// The upper plate takes the shape of a parabola with its lowest place at x: within an edge, at a vertex, at an end.
TEST(LeastGap, TroughsAreWhereItIsLeastBetweenThePoints) {
  const Curves c = curves_of({});
  ContactInterface pair{c.lower, c.upper, {}, {}, {}};
  pair.points = contact_points(c.mesh.nodes, pair, Integration::segments);
  for (const double x : {0.0, 0.1, 0.1234, 0.2, 0.37, 0.4, 0.8}) {
    SCOPED_TRACE(x);
    VecX u = VecX::Zero(2 * c.mesh.nodes.rows());
    for (const int node : curve_nodes(c.upper)) u(2 * node + 1) = 0.3 * std::pow(c.mesh.nodes(node, 0) - x, 2) - 0.01;
    const std::vector<Trough> found = troughs(c.mesh.nodes, u, pair);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(edge_point(c.mesh.nodes, c.lower.edges[found[0].point.edge], found[0].point.xi).position.x(), x, 1e-6);
    EXPECT_NEAR(gap_at(u, pair, found[0].point), -0.01, 1e-12);
    EXPECT_NEAR(found[0].curvature, 0.6, 1e-3);
    EXPECT_EQ(found[0].point.ds, 0);
  }
}

TEST(LeastGap, CurvesStayOpenThatComeNoNearerOrWhoseGapIsKnown) {
  const auto open = [](double coarser, double finer, double approach) {
    return stays_open({coarser, {}, 1, approach}, {finer, {}, 1, approach}, 1e-9);
  };
  EXPECT_TRUE(open(-1, -1, 1e-10));
  EXPECT_TRUE(open(1, 0.7, 1));
  EXPECT_FALSE(open(1, 0.6, 1));
  EXPECT_FALSE(open(-1, -1, 1));
  EXPECT_TRUE(open(1, std::numeric_limits<double>::infinity(), 1));
}

}  // namespace
}  // namespace mortise
