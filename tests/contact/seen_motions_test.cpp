// Motions that change no curve as drawn: turns of arcs, slides of lines, and what two curves leave together.
#include "contact/seen_motions.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>

#include "base/vectors.hpp"

namespace mortise {
namespace {

// Two chains of 2-node edges in one set of nodes, of bodies 0 and 1; each edge of the first faces one of the second.
struct Facing {
  Points nodes{0, 2};
  Curve first{0, 0, {}, {}, false}, second{1, 1, {}, {}, false};
  std::vector<ContactPoint> points;

  Facing(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
    add(a, first);
    add(b, second);
    for (int e = 0; e < int(a.size()) - 1; ++e)
      points.push_back({e, 0, 1, 1, Vec2(0, 1), std::min(e, int(b.size()) - 2), 0, 0});
  }

  void add(const std::vector<Vec2>& vertices, Curve& curve) {
    const int before = int(nodes.rows());
    nodes.conservativeResize(before + Eigen::Index(vertices.size()), 2);
    for (std::size_t i = 0; i < vertices.size(); ++i) nodes.row(before + Eigen::Index(i)) = vertices[i].transpose();
    for (int e = before; e + 1 < int(nodes.rows()); ++e) curve.edges.push_back({2, {e, e + 1, -1}});
  }

  // How many relative motions (two translations, a turn) the normals leave free.
  Eigen::Index free() const {
    const SmoothNormals seen = seen_motions(nodes, first, second, points);
    MatX rows(Eigen::Index(seen.normals.size()), 3);
    for (Eigen::Index k = 0; k < rows.rows(); ++k) {
      const ContactNormal& at = seen.normals[std::size_t(k)];
      rows.row(k) << at.normal.transpose(), cross(at.position, at.normal);
    }
    Eigen::FullPivLU<MatX> lu(rows);
    lu.setThreshold(1e-6);
    return 3 - lu.rank();
  }
};

std::vector<Vec2> curve(const std::function<Vec2(double)>& place, int edges) {
  std::vector<Vec2> vertices;
  for (int i = 0; i <= edges; ++i) {
    const double t = double(i) / edges;
    vertices.push_back(place(t + 0.1 * t * (1 - t)));  // unevenly spaced
  }
  return vertices;
}

std::vector<Vec2> arc(const Vec2& centre, double radius, double from, double to) {
  return curve(
      [&](double t) {
        const double angle = from + t * (to - from);
        return Vec2(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
      },
      9);
}

std::vector<Vec2> line(const Vec2& from, const Vec2& to) {
  return curve([&](double t) { return Vec2(from + t * (to - from)); }, 7);
}

std::vector<Vec2> parabola() {
  return curve([](double t) { return Vec2(2 * t - 1, (2 * t - 1) * (2 * t - 1)); }, 9);
}

std::vector<char> all(const Curve& curve) { return std::vector<char>(curve.edges.size(), 1); }

TEST(SeenMotions, ArcsTurnLinesSlideAndOtherCurvesDoNeither) {
  const Facing disc(arc({2, 1}, 3, 0.3, 1.4), line({0, 0}, {3, 4}));
  const Symmetry turn = symmetry(disc.nodes, disc.first, all(disc.first)),
                 slide = symmetry(disc.nodes, disc.second, all(disc.second));
  EXPECT_EQ(turn.kind, Symmetry::Kind::turn);
  EXPECT_LE((turn.centre - Vec2(2, 1)).norm(), 1e-9);
  EXPECT_EQ(slide.kind, Symmetry::Kind::slide);
  EXPECT_NEAR(std::abs(slide.direction.dot(Vec2(0.6, 0.8))), 1, 1e-12);
  const Facing other(parabola(), line({0, 0}, {1, 0}));
  EXPECT_EQ(symmetry(other.nodes, other.first, all(other.first)).kind, Symmetry::Kind::none);
}

TEST(SeenMotions, AreThoseOfBothCurvesWhicheverCarriesTheMultipliers) {
  const auto disc = arc({0, 1}, 1, -2, -1), other_disc = arc({0.6, -1}, 1, 1, 2),
             same_centre = arc({0, 1}, 1.1, -2, -1), plate = line({-1, 0}, {1, 0}), wedge = line({-1, 0.5}, {1, 0});
  const std::vector<std::tuple<std::vector<Vec2>, std::vector<Vec2>, Eigen::Index>> pairs{
      {disc, plate, 2},        // turns and slides
      {disc, other_disc, 2},   // turns, and rolls about the other
      {disc, same_centre, 1},  // a pin in its hole turns
      {plate, plate, 1},       // slides
      {parabola(), plate, 1},  // slides along the plate
      {parabola(), disc, 1},   // rolls about the disc
      {parabola(), parabola(), 0},
      {plate, wedge, 0}};  // a corner: nothing is told
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    SCOPED_TRACE(k);
    const auto& [a, b, free] = pairs[k];
    EXPECT_EQ(Facing(a, b).free(), free);
    EXPECT_EQ(Facing(b, a).free(), free);
  }
}

TEST(SeenMotions, ADrawnCurveIsNoArcBecauseItsVerticesAre) {
  Facing facing(arc({0, 1}, 1, -2, -1), line({-1, 0}, {1, 0}));
  const auto samples = [&](double bump) {
    std::vector<EdgeSamples> of_edges;
    for (const Edge& edge : facing.first.edges) {
      SamplePiece piece{.end = 1, .places = {}};
      auto& places = piece.places;
      const Vec2 from = facing.nodes.row(edge.nodes[0]).transpose(), to = facing.nodes.row(edge.nodes[1]).transpose();
      for (std::size_t k = 0; k < places.size(); ++k) {
        const double t = double(k) / double(places.size() - 1);
        const Vec2 place = from + t * (to - from) - Vec2(0, 1);
        places[k] = Vec2(0, 1) + place.normalized() * (1 + bump * t * (1 - t));
      }
      of_edges.push_back({.pieces = {piece}});
    }
    return of_edges;
  };
  facing.first.samples = samples(0);
  EXPECT_EQ(symmetry(facing.nodes, facing.first, all(facing.first)).kind, Symmetry::Kind::turn);
  facing.first.samples = samples(1e-4);
  EXPECT_EQ(symmetry(facing.nodes, facing.first, all(facing.first)).kind, Symmetry::Kind::none);
}

}  // namespace
}  // namespace mortise
