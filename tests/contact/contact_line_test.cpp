// The curve rebuilt from nodes against the curve that they were taken from.
#include "contact/contact_line.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "contact/curvature_jumps.hpp"

namespace mortise {
namespace {

constexpr double pi = std::numbers::pi;

using Shape = std::function<Vec2(double)>;

Vec2 wave(double t) { return {t, 0.3 + 0.08 * std::sin(5 * t) + 0.03 * t * t}; }
Vec2 polar(double t) {
  const double r = 1 + 0.1 * std::cos(2 * t) + 0.05 * std::cos(4 * t);
  return {r * std::cos(t), r * std::sin(t)};
}

// A chain of edges on a shape, 0 <= t <= end, unevenly spaced; middle nodes on the shape, or on the chords.
struct Chain {
  Points nodes;
  Curve curve{.boundary = 0, .body = 0, .edges = {}, .sides = {}, .closed = false};

  Chain(const Shape& shape, double end, int edges, int nodes_an_edge, bool closed = false, bool on_chords = false) {
    curve.closed = closed;
    const auto t_of = [&](double k) { return end * (k + 0.15 * std::sin(k)) / (edges + 0.15 * std::sin(edges)); };
    const int vertices = edges + !closed;
    nodes.resize(vertices + edges, 2);
    for (int i = 0; i < vertices; ++i) nodes.row(i) = shape(t_of(i)).transpose();
    for (int e = 0; e < edges; ++e) {
      const int next = (e + 1) % vertices;
      nodes.row(vertices + e) = on_chords ? ((nodes.row(e) + nodes.row(next)) / 2).eval()
                                          : shape((t_of(e) + t_of(e + 1)) / 2).transpose().eval();
      curve.edges.push_back({nodes_an_edge, {e, next, nodes_an_edge == 3 ? vertices + e : -1}});
    }
  }
};

// Largest distance of the rebuilt line from the shape, and largest difference of their normals.
struct Errors {
  double place = 0, normal = 0;
};

Errors errors_of(const Shape& shape, double end, const Chain& chain) {
  const ContactLine line(chain.nodes, chain.curve);
  Errors worst;
  for (int e = 0; e < int(chain.curve.edges.size()); ++e)
    for (double xi = -0.9; xi < 1; xi += 0.2) {
      const LinePoint p = line.at(e, xi);
      double t = end * (e + 0.5) / double(chain.curve.edges.size());  // nearest on the shape, by Newton's method
      const double d = 1e-5;
      for (int step = 0; step < 50; ++step) {
        const Vec2 slope = (shape(t + d) - shape(t - d)) / (2 * d);
        t += (p.position - shape(t)).dot(slope) / slope.squaredNorm();
      }
      const Vec2 slope = (shape(t + d) - shape(t - d)) / (2 * d);
      worst.place = std::max(worst.place, (p.position - shape(t)).norm());
      worst.normal = std::max(worst.normal, (p.normal() - Vec2(slope.y(), -slope.x()).normalized()).norm());
    }
  return worst;
}

TEST(ContactLine, FallsToTheCurveAsHToTheFourth) {
  for (const bool closed : {false, true})
    for (const int nodes_an_edge : {2, 3}) {
      const Shape shape = closed ? Shape(polar) : Shape(wave);
      const double end = closed ? 2 * pi : 2;
      std::vector<Errors> on;
      const int coarsest = nodes_an_edge == 2 ? 32 : 16;
      for (int n = coarsest; n <= 8 * coarsest; n *= 2)
        on.push_back(errors_of(shape, end, Chain(shape, end, n, nodes_an_edge, closed)));
      for (std::size_t k = 1; k < on.size(); ++k) {
        EXPECT_GE(std::log2(on[k - 1].place / on[k].place), 3.5) << closed << nodes_an_edge << k;
        EXPECT_GE(std::log2(on[k - 1].normal / on[k].normal), 2.7) << closed << nodes_an_edge << k;
      }
      if (nodes_an_edge == 3) EXPECT_LE(on.back().normal, 1e-6) << closed;
      std::printf("closed %d, %d nodes an edge: place %.1e ... %.1e, normal %.1e ... %.1e\n", closed, nodes_an_edge,
                  on.front().place, on.back().place, on.front().normal, on.back().normal);
    }
}

TEST(ContactLine, StraightLinesAreExact) {
  const Shape straight = [](double t) { return Vec2(0.1 + 3 * t, 0.2 - 4 * t); };
  for (const int nodes_an_edge : {2, 3}) {
    const Chain chain(straight, 1, 7, nodes_an_edge);
    const ContactLine line(chain.nodes, chain.curve);
    for (int e = 0; e < 7; ++e)
      for (const double xi : {-1.0, -0.3, 0.0, 0.8, 1.0})
        EXPECT_LE((line.at(e, xi).normal() - Vec2(-0.8, -0.6)).norm(), 1e-14);
  }
}

TEST(ContactLine, PassesThroughEveryNode) {
  const Chain chain(wave, 2, 9, 3);
  const ContactLine line(chain.nodes, chain.curve);
  for (int e = 0; e < 9; ++e) {
    const auto& nodes = chain.curve.edges[e].nodes;
    EXPECT_LE((line.at(e, -1).position - chain.nodes.row(nodes[0]).transpose()).norm(), 1e-15);
    EXPECT_LE((line.at(e, 1).position - chain.nodes.row(nodes[1]).transpose()).norm(), 1e-14);
    const auto middle = line.foot(e, chain.nodes.row(nodes[2]).transpose(), 0);
    ASSERT_TRUE(middle);
    EXPECT_LE((line.at(e, *middle).position - chain.nodes.row(nodes[2]).transpose()).norm(), 1e-14);
  }
}

TEST(ContactLine, StraightSidesOf3NodeEdgesSayNothingOfTheCurve) {
  const Chain chain([](double t) { return Vec2(std::cos(t), std::sin(t)); }, 2, 16, 3, false, true);
  const ContactLine line(chain.nodes, chain.curve);
  for (int e = 0; e < 16; ++e) EXPECT_NEAR(line.at(e, 0).position.norm(), 1, 2e-6);  // the chords: 2e-3
}

TEST(ContactLine, CoarseStraightSidesAreNoPolygon) {
  const Chain chain([](double t) { return Vec2(std::cos(t), std::sin(t)); }, pi / 2, 4, 3, false,
                    true);  // 22.5 degrees
  const ContactLine line(chain.nodes, chain.curve);
  for (int e = 0; e < 4; ++e) EXPECT_NEAR(line.at(e, 0).position.norm(), 1, 2e-3);  // the chords: 2e-2
}

// ---- Corners ----

Vec2 corner(double t) { return t < 1 ? Vec2(t, 0.1 * t * t) : Vec2(1 + 0.1 * (t - 1), 0.1 + (t - 1)); }

TEST(ContactLine, ACornerStaysAndIsExactOnBothSides) {
  for (const int nodes_an_edge : {2, 3}) {
    Chain chain(corner, 2, 12, nodes_an_edge);
    double nearest = 1;
    int at = 0;
    for (int i = 0; i < 13; ++i)  // put a vertex on the corner
      if (const double d = (chain.nodes.row(i) - Eigen::RowVector2d(1, 0.1)).norm(); d < nearest) nearest = d, at = i;
    chain.nodes.row(at) << 1, 0.1;
    for (const int e : {at - 1, at}) {
      const Vec2 middle = (chain.nodes.row(e) + chain.nodes.row(e + 1)).transpose() / 2;
      chain.nodes.row(13 + e) << middle.x(), e < at ? 0.1 * middle.x() * middle.x() : middle.y();
    }
    const ContactLine line(chain.nodes, chain.curve);
    EXPECT_LE((line.at(at - 1, 1).normal() - Vec2(0.2, -1).normalized()).norm(), 1e-3);
    EXPECT_LE((line.at(at, -1).normal() - Vec2(1, -0.1).normalized()).norm(), 1e-12);
  }
}

TEST(ContactLine, ASlightCornerStays) {
  for (const double rise : {0.02, 0.1, 0.3})
    for (const int nodes_an_edge : {2, 3})
      for (const int edges : {4, 8, 30}) {
        const Shape tent = [&](double t) { return Vec2(t, rise * std::min(t, 2 - t)); };
        Chain chain(tent, 2, edges, nodes_an_edge);
        for (int i = 0; i <= edges; ++i) chain.nodes.row(i) = tent(2.0 * i / edges).transpose();
        for (int e = 0; e < edges; ++e)
          chain.nodes.row(edges + 1 + e) = (chain.nodes.row(e) + chain.nodes.row(e + 1)) / 2;
        const ContactLine line(chain.nodes, chain.curve);
        for (int e = 0; e < edges; ++e)
          EXPECT_LE((line.at(e, 0.3).normal() - Vec2(e < edges / 2 ? rise : -rise, -1).normalized()).norm(), 1e-12)
              << rise << " " << nodes_an_edge << " " << edges << " " << e;
      }
}

TEST(ContactLine, FineStraightSidesAreFoundToo) {
  const Chain chain([](double t) { return Vec2(std::cos(t), std::sin(t)); }, pi / 2, 300, 3, false, true);
  const ContactLine line(chain.nodes, chain.curve);
  for (int e = 0; e < 300; ++e) EXPECT_NEAR(line.at(e, 0).position.norm(), 1, 1e-9);  // the chords: 3e-6
}

TEST(ContactLine, ACoarseCircleHasNoCorners) {
  const Shape circle = [](double t) { return Vec2(std::cos(t), std::sin(t)); };
  for (const bool closed : {false, true}) {
    const Chain chain(circle, closed ? 2 * pi : 3, closed ? 10 : 5, 2, closed);  // 36 degrees a vertex
    const ContactLine line(chain.nodes, chain.curve);
    for (int e = 1; e < int(chain.curve.edges.size()); ++e)
      EXPECT_LE((line.at(e - 1, 1).normal() - line.at(e, -1).normal()).norm(), 1e-12) << closed << e;
  }
}

TEST(ContactLine, ASquareOfSingleEdgesHasFour) {
  const Shape square = [](double t) {
    const int side = int(t + 0.5) % 4;
    return std::array{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}[side];
  };
  Chain chain(square, 4, 4, 2, true);
  for (int i = 0; i < 4; ++i) chain.nodes.row(i) = square(i).transpose();
  const ContactLine line(chain.nodes, chain.curve);
  for (int e = 0; e < 4; ++e)
    EXPECT_LE((line.at(e, 0.3).tangent.normalized() - line.at(e, 0).tangent.normalized()).norm(), 1e-14);
}

// ---- Drawn curves ----

TEST(ContactLine, GoesThroughTheSamplesOfADrawnCurve) {
  for (const int nodes_an_edge : {2, 3}) {
    Chain chain([](double t) { return Vec2(std::cos(t), std::sin(t)); }, 2, 8, nodes_an_edge, false, true);
    for (int e = 0; e < 8; ++e) {
      const auto angle = [&](int node) { return std::atan2(chain.nodes(node, 1), chain.nodes(node, 0)); };
      const double start = angle(e), end = angle(e + 1);
      SamplePiece& piece = chain.curve.samples.emplace_back().pieces.emplace_back(SamplePiece{.end = 1, .places = {}});
      for (int k = 0; k < 9; ++k) {
        const double t = (start + end) / 2 - (end - start) / 2 * std::cos(pi * k / 8);
        piece.places[k] = {std::cos(t), std::sin(t)};
      }
    }
    const ContactLine line(chain.nodes, chain.curve);
    for (int e = 0; e < 8; ++e)
      for (double xi = -1; xi <= 1; xi += 0.125) {
        const LinePoint p = line.at(e, xi);
        EXPECT_NEAR(p.position.norm(), 1, 1e-14);
        EXPECT_LE((p.normal() - Vec2(p.position)).norm(), 1e-12);
      }
  }
}

// ---- Feet and crossings ----

TEST(ContactLine, TheFootsNormalPassesThroughThePoint) {
  const Chain chain(wave, 2, 9, 3);
  const ContactLine line(chain.nodes, chain.curve);
  for (int e = 0; e < 9; ++e)
    for (const double xi : {-0.95, -0.2, 0.7}) {
      const LinePoint p = line.at(e, xi);
      for (const double away : {-0.02, 0.0, 0.03}) {
        const auto foot = line.foot(e, p.position + away * p.normal(), 0);
        ASSERT_TRUE(foot) << e << " " << xi << " " << away;
        EXPECT_NEAR(*foot, xi, 1e-13);
        const auto crossing = line.crossing(e, p.position + away * p.normal(), p.normal(), 0);
        ASSERT_TRUE(crossing);
        EXPECT_NEAR(*crossing, xi, 1e-13);
      }
    }
  EXPECT_FALSE(line.foot(0, Vec2(1.9, 0.3), 0));
}

// A line, an arc of radius 2 that it touches, and an arc of radius 5 that goes on where the first one ends; then a
// kink.
TEST(CurvatureJumps, AreWhereDrawnArcsJoinAndNotAtKinks) {
  const auto places = [](const Shape& shape, double from, double to) {
    const CurvePlaces at = [&](const std::vector<double>& t) {
      std::vector<Vec2> list;
      for (const double value : t) list.push_back(shape(value));
      return list;
    };
    return sample_edges(at, {{from, to}})[0];
  };
  const Vec2 end(2 * std::sin(0.5), 2 - 2 * std::cos(0.5));
  const Vec2 centre = end + 5 * Vec2(-std::sin(0.5), std::cos(0.5));
  const Vec2 last = centre + 5 * Vec2(std::sin(0.8), -std::cos(0.8));
  const std::vector<Shape> shapes{[](double t) { return Vec2(t, 0); },
                                  [](double t) { return Vec2(2 * std::sin(t), 2 - 2 * std::cos(t)); },
                                  [&](double t) { return Vec2(centre + 5 * Vec2(std::sin(t), -std::cos(t))); },
                                  [&](double t) { return Vec2(last + t * Vec2(0, 1)); }};
  const std::vector<std::array<double, 2>> ranges{{-1, 0}, {0, 0.5}, {0.5, 0.8}, {0, 1}};
  Curve curve{.boundary = 0, .body = 0, .edges = {}, .sides = {}, .closed = false};
  Points nodes(5, 2);
  for (int e = 0; e < 4; ++e) {
    nodes.row(e) = shapes[e](ranges[e][0]).transpose();
    curve.edges.push_back({2, {e, e + 1, -1}});
    curve.samples.push_back(places(shapes[e], ranges[e][0], ranges[e][1]));
  }
  nodes.row(4) = shapes[3](1).transpose();
  const std::vector<CurvatureJump> jumps = curvature_jumps(nodes, curve, ContactLine(nodes, curve));
  ASSERT_EQ(jumps.size(), 2);
  EXPECT_EQ(jumps[0].edge, 1);
  EXPECT_NEAR(jumps[0].jump, 1 / 2., 1e-9);
  EXPECT_EQ(jumps[1].edge, 2);
  EXPECT_NEAR(jumps[1].jump, 1 / 5. - 1 / 2., 1e-9);
  curve.samples.clear();
  EXPECT_TRUE(curvature_jumps(nodes, curve, ContactLine(nodes, curve)).empty());
}

// A straight line and an arc in one edge.
TEST(CurvatureJumps, AreAlsoWithinAnEdge) {
  const CurvePlaces at = [](const std::vector<double>& t) {
    std::vector<Vec2> list;
    for (const double value : t)
      list.push_back(value < 1 ? Vec2(value - 1, 0) : Vec2(std::sin(value - 1), 1 - std::cos(value - 1)));
    return list;
  };
  Curve curve{.boundary = 0, .body = 0, .edges = {{2, {0, 1, -1}}}, .sides = {}, .closed = false};
  curve.samples = sample_edges(at, {{0, 2}});
  Points nodes(2, 2);
  nodes << at({0})[0].transpose(), at({2})[0].transpose();
  const std::vector<CurvatureJump> jumps = curvature_jumps(nodes, curve, ContactLine(nodes, curve));
  ASSERT_EQ(jumps.size(), 1);
  EXPECT_NEAR(jumps[0].xi, 0, 1e-6);
  EXPECT_NEAR(jumps[0].jump, 1, 1e-3);
}

// However short the edges of an arc are, round-off of its places is no jump; that of an arc that ends is one.
TEST(CurvatureJumps, AreNotMadeByRoundOff) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> exponent(-3.8, -1), place(-40, 40), angle(-3, 3);
  for (int i = 0; i < 200; ++i) {
    const double h = std::pow(10, exponent(random)), radius = 10 + std::abs(place(random)), start = angle(random);
    const Vec2 centre(place(random), place(random));
    const auto arc = [&](const std::vector<double>& t) {
      std::vector<Vec2> list;
      for (const double value : t) list.push_back(centre + radius * Vec2(std::cos(value), std::sin(value)));
      return list;
    };
    Curve curve{.boundary = 0, .body = 0, .edges = {}, .sides = {}, .closed = false};
    for (const int k : {0, 1, 2}) curve.edges.push_back({2, {k, k + 1, -1}});
    const double step = h / radius;
    const std::array<double, 4> ends{start, start + step, start + 2 * step, start + 1};
    curve.samples = sample_edges(arc, {{ends[0], ends[1]}, {ends[1], ends[2]}, {ends[2], ends[3]}});
    Points nodes(4, 2);
    for (const int k : {0, 1, 2, 3}) nodes.row(k) = arc({ends[k]})[0].transpose();
    EXPECT_TRUE(curvature_jumps(nodes, curve, ContactLine(nodes, curve)).empty()) << i;
    const Vec2 end = nodes.row(1).transpose(), along(-std::sin(start + step), std::cos(start + step));
    const auto straight = [&](const std::vector<double>& t) {
      std::vector<Vec2> list;
      for (const double value : t) list.push_back(end + value * along);
      return list;
    };
    const std::vector<EdgeSamples> on = sample_edges(straight, {{0, h}, {h, radius}});
    std::ranges::copy(on, curve.samples.begin() + 1);
    for (const int k : {2, 3}) nodes.row(k) = straight({k == 2 ? h : radius})[0].transpose();
    const std::vector<CurvatureJump> jumps = curvature_jumps(nodes, curve, ContactLine(nodes, curve));
    ASSERT_EQ(jumps.size(), 1) << i;
    EXPECT_NEAR(jumps[0].jump, -1 / radius, 0.2 / radius) << i;
  }
}

// Where edges are too short for their curvatures those further away tell of the jump, and where it is; a curvature that
// varies, as that of a parabola, makes none.
TEST(CurvatureJumps, AreSeenHoweverShortTheEdgesThere) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> exponent(-7, -3), place(-40, 40), angle(-3, 3), growth(1.2, 2), part(0, 1);
  for (int i = 0; i < 1000; ++i) {
    const double radius = 10 + std::abs(place(random)), turned = angle(random), grows = growth(random);
    const Vec2 centre(place(random), place(random));
    const bool parabola = i % 2 == 1;
    const auto shape = [&](double t) {
      const Vec2 x = parabola ? Vec2(t, t * t / 2 / radius)
                     : t < 0  ? Vec2(t, 0)
                              : Vec2(radius * std::sin(t / radius), radius - radius * std::cos(t / radius));
      return Vec2(centre + Vec2(std::cos(turned) * x.x() - std::sin(turned) * x.y(),
                                std::sin(turned) * x.x() + std::cos(turned) * x.y()));
    };
    const auto places = [&](const std::vector<double>& t) {
      std::vector<Vec2> list;
      for (const double value : t) list.push_back(shape(value));
      return list;
    };
    std::vector<double> ends{0};
    for (const double side : {-1, 1})
      for (double h = std::pow(10, exponent(random)), t = side * h; std::abs(t) < 5; h *= grows, t += side * h)
        ends.push_back(t);
    std::ranges::sort(ends);
    Curve curve{.boundary = 0, .body = 0, .edges = {}, .sides = {}, .closed = false};
    Points nodes(ends.size(), 2);
    for (int k = 0; k < int(ends.size()); ++k) {
      nodes.row(k) = shape(ends[k]).transpose();
      if (k + 1 < int(ends.size())) {
        curve.edges.push_back({2, {k, k + 1, -1}});
        curve.samples.push_back(sample_edges(places, {{ends[k], ends[k + 1]}})[0]);
      }
    }
    const std::vector<CurvatureJump> jumps = curvature_jumps(nodes, curve, ContactLine(nodes, curve));
    ASSERT_EQ(jumps.size(), parabola ? 0 : 1) << i;
    if (parabola) continue;
    EXPECT_NEAR(ends[jumps[0].edge], 0, 1e-6 * radius) << i;  // what round-off leaves of the turn
    EXPECT_NEAR(jumps[0].jump, 1 / radius, 0.2 / radius) << i;
  }
}

}  // namespace
}  // namespace mortise
