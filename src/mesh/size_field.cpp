#include "mesh/size_field.hpp"

#include <algorithm>
#include <queue>

#include "base/vectors.hpp"

namespace mortise {
namespace {

// So far outside, in a triangle's own coordinates, a place on a body's curve may lie between the curve and its chord:
// that of an arc of 40 degrees.
constexpr double beside = 0.1;

// How deep outside the triangle x lies, in its own coordinates; 0 inside. `at`: the coordinates, cut off at the sides.
double outside(const std::array<Vec2, 3>& t, const Vec2& x, Eigen::Vector3d& at) {
  const double twice_area = cross(Vec2(t[1] - t[0]), Vec2(t[2] - t[0]));
  at = Eigen::Vector3d(cross(Vec2(t[1] - x), Vec2(t[2] - x)), cross(Vec2(t[2] - x), Vec2(t[0] - x)),
                       cross(Vec2(t[0] - x), Vec2(t[1] - x))) /
       twice_area;
  const double deepest = std::max(0.0, -at.minCoeff());
  at = at.cwiseMax(0);
  at /= at.sum();
  return deepest;
}

// With a margin for places between a chord and its curve.
template <typename Triangle>
std::vector<Box> boxes_of(const std::vector<Triangle>& triangles) {
  std::vector<Box> boxes;
  for (const Triangle& t : triangles) {
    Box box(t.x[0]);
    box.extend(t.x[1]).extend(t.x[2]);
    const Vec2 margin = Vec2::Constant(beside * box.sizes().norm());
    boxes.emplace_back(box.min() - margin, box.max() + margin);
  }
  return boxes;
}

}  // namespace

SizeField::SizeField(const Mesh& mesh, const VecX& sizes, std::vector<SizeLayers> layers)
    : SizeField(triangles_of(mesh, sizes), std::move(layers)) {}

SizeField::SizeField(std::vector<Triangle> triangles, std::vector<SizeLayers> layers)
    : triangles_(std::move(triangles)), layers_(std::move(layers)), boxes_(boxes_of(triangles_)) {}

std::vector<SizeField::Triangle> SizeField::triangles_of(const Mesh& mesh, const VecX& sizes) {
  std::vector<Triangle> triangles;
  for (const Cell& cell : mesh.cells)
    for (int k = 2; k < corner_count(cell.kind); ++k) {
      Triangle& t = triangles.emplace_back();
      t.body = cell.body;
      for (int a = 0; a < 3; ++a) {
        const int node = cell.nodes[a == 0 ? 0 : k - 2 + a];
        t.x[a] = mesh.nodes.row(node);
        t.size[a] = sizes(node);
      }
    }
  return triangles;
}

double SizeField::operator()(const Vec2& x) const {
  constexpr double inside = 1e-6;  // in the triangle's own coordinates
  struct Nearest {
    int body;
    double depth, size;
  };
  std::vector<Nearest> bodies;  // a few
  const auto look_at = [&](int number) {
    const Triangle& t = triangles_[number];
    Eigen::Vector3d at;
    const double depth = outside(t.x, x, at);
    const double value = at(0) * t.size[0] + at(1) * t.size[1] + at(2) * t.size[2];
    const auto of = std::ranges::find(bodies, t.body, &Nearest::body);
    if (of == bodies.end())
      bodies.push_back({t.body, depth, value});
    else if (depth <= inside && of->depth <= inside)
      *of = {t.body, depth, std::min(of->size, value)};
    else if (depth < of->depth)
      *of = {t.body, depth, value};
  };
  for (const int number : boxes_.meeting(Box(x))) look_at(number);
  constexpr int looked_at = 8;
  if (bodies.empty())  // far outside
    for (const int number : boxes_.nearest(x, looked_at)) look_at(number);
  const double near = std::max(beside, std::ranges::min(bodies, {}, &Nearest::depth).depth);
  double size = layers_(x);
  for (const Nearest& of : bodies)
    if (of.depth <= near) size = std::min(size, of.size);
  return size;
}

void limit_growth(const Mesh& mesh, double growth, VecX& sizes) {
  struct Side {
    int to;
    double length;
  };
  std::vector<std::vector<Side>> sides(mesh.nodes.rows());
  for (const Cell& cell : mesh.cells) {
    const int corners = corner_count(cell.kind);
    for (int a = 0; a < corners; ++a) {
      const int i = cell.nodes[a], j = cell.nodes[(a + 1) % corners];
      const double length = (mesh.nodes.row(i) - mesh.nodes.row(j)).norm();
      sides[i].push_back({j, length});
      sides[j].push_back({i, length});
    }
  }
  // From the smallest on, each vertex once (Dijkstra).
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (int i = 0; i < int(sides.size()); ++i)
    if (!sides[i].empty()) queue.emplace(sizes(i), i);
  while (!queue.empty()) {
    const auto [size, i] = queue.top();
    queue.pop();
    if (size > sizes(i)) continue;
    for (const Side& side : sides[i]) {
      const double limit = size + growth * side.length;
      if (!(limit < sizes(side.to))) continue;
      sizes(side.to) = limit;
      queue.emplace(limit, side.to);
    }
  }
}

}  // namespace mortise
