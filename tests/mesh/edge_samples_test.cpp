// Piecewise smooth curves, whose pieces are known, against what sampling finds of them.
#include "mesh/edge_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace mortise {
namespace {

using Shape = std::function<Vec2(double)>;

CurvePlaces places_of(const Shape& shape, int* count = nullptr) {
  return [shape, count](const std::vector<double>& parameters) {
    std::vector<Vec2> places;
    for (const double t : parameters) places.push_back(shape(t));
    if (count) *count += int(parameters.size());
    return places;
  };
}

// The polynomial through a piece's places, by Lagrange's formula; z: -1 ... 1 on the piece.
Vec2 on_piece(const SamplePiece& piece, double z) {
  const auto node = [](int k) { return -std::cos(std::numbers::pi * k / 8); };
  Vec2 x = Vec2::Zero();
  for (int k = 0; k < 9; ++k) {
    double weight = 1;
    for (int m = 0; m < 9; ++m)
      if (m != k) weight *= (z - node(m)) / (node(k) - node(m));
    x += weight * piece.places[k];
  }
  return x;
}

// Largest distance of an edge's pieces from the shape, whose parameter is t0 ... t1 along it.
double largest_miss(const EdgeSamples& samples, const Shape& shape, double t0, double t1) {
  double begin = -1, miss = 0;
  for (const SamplePiece& piece : samples.pieces) {
    for (double z = -1; z <= 1; z += 0.01) {
      const double xi = (begin + piece.end) / 2 + z * (piece.end - begin) / 2;
      miss = std::max(miss, (on_piece(piece, z) - shape(((1 - xi) * t0 + (1 + xi) * t1) / 2)).norm());
    }
    begin = piece.end;
  }
  EXPECT_EQ(begin, 1);
  return miss;
}

TEST(EdgeSamples, ASmoothCurveHasOnePieceAnEdge) {
  const Shape arc = [](double t) { return Vec2(3 + std::cos(t), std::sin(t)); };
  int count = 0;
  const auto edges = sample_edges(places_of(arc, &count), {{0, 0.2}, {0.2, 0.5}, {0.5, 0.6}});
  EXPECT_EQ(count, 3 * 17);  // nothing is asked twice
  for (const EdgeSamples& edge : edges) {
    EXPECT_EQ(edge.pieces.size(), 1u);
    EXPECT_LE(edge.misfit, 1e-13);
  }
  EXPECT_GT(sample_edges(places_of(arc), {{0, 3}})[0].pieces.size(), 1u);
  EXPECT_LE(largest_miss(sample_edges(places_of(arc), {{0, 3}})[0], arc, 0, 3), 1e-12);
}

// A jump in the derivative of order 1 (a kink), 2 (curvature) or 3 at t = knot.
TEST(EdgeSamples, AKnotEndsAPieceWhereverItLies) {
  for (const int order : {1, 2, 3})
    for (const double knot : {0.003, 0.21, 0.5, 0.7731, 0.9999}) {
      const Shape shape = [&](double t) {
        return Vec2(t, 0.1 * t * t + 0.3 * std::pow(std::max(t - knot, 0.0), order));
      };
      const EdgeSamples edge = sample_edges(places_of(shape), {{0, 1}})[0];
      ASSERT_GE(edge.pieces.size(), 2u) << order << " " << knot;
      ASSERT_LE(edge.pieces.size(), 3u) << order << " " << knot;  // of a kink the part about it, too
      EXPECT_NEAR(edge.pieces[0].end, 2 * knot - 1, order < 3 ? 1e-4 : 5e-3) << order;  // what 1e-13 shows of it
      EXPECT_LE(largest_miss(edge, shape, 0, 1), 2e-13) << order << " " << knot;
    }
}

TEST(EdgeSamples, RandomCubicsBetweenRandomKnotsAreFoundAsTheyAre) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int draw = 0; draw < 40; ++draw) {
    std::vector<std::array<double, 3>> knots;  // where, and what jumps: second and third derivative
    for (int k = 0; k < 1 + draw % 12; ++k) knots.push_back({uniform(random), uniform(random) - 0.5, uniform(random)});
    const Shape shape = [&](double t) {
      Vec2 x(t, 0.2 * t * t);
      for (const auto& [at, second, third] : knots)
        if (t > at) x.y() += (second + third * (t - at)) * (t - at) * (t - at);
      return x;
    };
    const double cut = 0.1 + 0.8 * uniform(random);
    const auto edges = sample_edges(places_of(shape), {{0, cut}, {cut, 1}});
    EXPECT_LE(edges[0].pieces.size() + edges[1].pieces.size(), 2 * knots.size() + 2) << draw;
    EXPECT_LE(largest_miss(edges[0], shape, 0, cut), 1e-12) << draw;
    EXPECT_LE(largest_miss(edges[1], shape, cut, 1), 1e-12) << draw;
  }
}

TEST(EdgeSamples, WhatHasNoDerivativesIsSaidAndCostsLittle) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-1e-6, 1e-6);
  int count = 0;
  const EdgeSamples edge =
      sample_edges(places_of([&](double t) { return Vec2(t, noise(random)); }, &count), {{0, 1}})[0];
  EXPECT_GT(edge.misfit, 2e-7);
  EXPECT_LE(edge.misfit, 1e-5);
  EXPECT_LE(count, 20000);
}

TEST(EdgeSamples, FarFromTheOriginRoundOffIsNoMisfit) {
  const Shape arc = [](double t) { return Vec2(1e6 + std::cos(t), 1e6 + std::sin(t)); };
  EXPECT_EQ(sample_edges(places_of(arc), {{0, 0.3}})[0].pieces.size(), 1u);
}

// Its places near the origin are small differences of its radius: noisier than their coordinates tell.
TEST(EdgeSamples, ALargeCircleIsOnePieceAnEdge) {
  for (const double radius : {6e2, 6e4, 6e6}) {
    const Shape arc = [&](double t) {
      return Vec2(radius * std::cos(t / radius - std::numbers::pi / 2),
                  radius + radius * std::sin(t / radius - std::numbers::pi / 2));
    };
    int count = 0;
    std::vector<std::array<double, 2>> ends;
    for (int e = -50; e < 50; ++e) ends.push_back({e / 5.0, (e + 1) / 5.0});
    const auto edges = sample_edges(places_of(arc, &count), ends);
    for (const EdgeSamples& edge : edges) EXPECT_EQ(edge.pieces.size(), 1u) << radius;
    EXPECT_LE(count, 100 * (17 + 3 * 17)) << radius;  // places to see with, and of the short parts
  }
}

TEST(EdgeSamples, ReversedRunsTheOtherWay) {
  const Shape shape = [](double t) { return Vec2(t, std::pow(std::max(t - 0.3, 0.0), 2)); };
  const EdgeSamples edge = sample_edges(places_of(shape), {{0, 1}})[0];
  EXPECT_LE(largest_miss(reversed(edge), shape, 1, 0), 2e-13);
}

TEST(EdgeSamples, AStraightEdgeIsItsEnds) {
  const Shape straight = [](double t) { return Vec2(1 + 2 * t, 3 - t); };
  const auto edges = sample_straight_edges(places_of(straight), {{0, 0.5}, {0.5, 1}});
  ASSERT_EQ(edges.size(), 2u);
  EXPECT_LE(largest_miss(edges[1], straight, 0.5, 1), 1e-14);
}

}  // namespace
}  // namespace mortise
