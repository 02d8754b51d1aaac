#include "contact/smooth_normals.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/vectors.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

constexpr double least_kink = 20 * std::numbers::pi / 180;

Vec2 right_of(const Vec2& tangent) { return Vec2(tangent.y(), -tangent.x()).normalized(); }

// The curve's vertices: vertex i begins edge i.
class Vertices {
 public:
  Vertices(const Points& nodes, const Curve& curve) : nodes_(nodes), curve_(curve), edges_(int(curve.edges.size())) {}

  int count() const { return edges_ + !curve_.closed; }
  int ahead(int i) const { return curve_.closed ? (i + 1) % edges_ : std::min(i + 1, edges_); }
  Vec2 position(int i) const {
    return nodes_.row(i < edges_ ? curve_.edges[i].nodes[0] : curve_.edges.back().nodes[1]).transpose();
  }
  bool is_end(int i) const { return !curve_.closed && (i == 0 || i == edges_); }

  // Normals of the edges that meet at an inner vertex.
  std::array<Vec2, 2> of_edges(int i) const {
    const Edge& before = curve_.edges[i > 0 ? i - 1 : edges_ - 1];
    return {edge_point(nodes_, before, 1).normal(), edge_point(nodes_, curve_.edges[i], -1).normal()};
  }
  bool smooth(int i) const {
    const auto [before, after] = of_edges(i);
    return angle_between(before, after) < least_kink;
  }

  // 3-node edges turn within, those of 2 nodes at their vertices.
  double edge_error() const {
    double error = 0;
    for (int i = 0; i < edges_; ++i) {
      const Edge& edge = curve_.edges[i];
      if (edge.node_count == 3) {
        const double angle = angle_between(edge_point(nodes_, edge, -1).normal(), edge_point(nodes_, edge, 1).normal());
        error = std::max(error, std::pow(angle, 4) / 128);
      } else if (!is_end(i) && smooth(i)) {
        const auto [before, after] = of_edges(i);
        error = std::max(error, std::pow(angle_between(before, after), 2) / 8);
      }
    }
    return error;
  }

  // Of the circle through three vertices; an inversion about the one it is taken at makes a line of the circle.
  Vec2 of_circle(int i) const {
    if (!is_end(i)) {
      const Vec2 from = position(i) - position(i > 0 ? i - 1 : edges_ - 1), to = position(ahead(i)) - position(i);
      return right_of(from / from.squaredNorm() + to / to.squaredNorm());
    }
    const int inwards = i == 0 ? 1 : -1;
    if (edges_ == 1 || !smooth(i + inwards)) return of_end(i);
    const Vec2 near = position(i + inwards) - position(i), far = position(i + 2 * inwards) - position(i);
    return right_of(inwards * (near / near.squaredNorm() - far / far.squaredNorm()));
  }

 private:
  Vec2 of_end(int i) const {
    return i == 0 ? edge_point(nodes_, curve_.edges.front(), -1).normal()
                  : edge_point(nodes_, curve_.edges.back(), 1).normal();
  }

  const Points& nodes_;
  const Curve& curve_;
  int edges_;
};

}  // namespace

std::vector<ContactNormal> smooth_normals(const Points& nodes, const Curve& curve, int other,
                                          const std::vector<char>& faces) {
  const Vertices vertices(nodes, curve);
  std::vector<char> taken(vertices.count(), 0);
  for (int i = 0; i < int(faces.size()); ++i)
    if (faces[i]) taken[i] = taken[vertices.ahead(i)] = 1;
  std::vector<ContactNormal> result;
  for (int i = 0; i < vertices.count(); ++i) {
    if (!taken[i]) continue;
    const Vec2 at = vertices.position(i);
    const auto add = [&](const Vec2& normal) { result.push_back({at, normal, curve.body, other}); };
    if (vertices.is_end(i) || vertices.smooth(i))
      add(vertices.of_circle(i));
    else
      for (const Vec2& normal : vertices.of_edges(i)) add(normal);
  }
  return result;
}

double edge_error(const Points& nodes, const Curve& curve) { return Vertices(nodes, curve).edge_error(); }

}  // namespace mortise
