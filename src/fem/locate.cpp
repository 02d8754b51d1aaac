#include "fem/locate.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <map>

namespace mortise {
namespace {

constexpr double reach = 0.1;  // of a cell's size

Vec2 into_cell(CellKind kind, const Vec2& xi) {
  if (corner_count(kind) == 4) return xi.cwiseMax(-1).cwiseMin(1);
  const Vec2 inside = xi.cwiseMax(0);
  const double sum = inside.sum();
  if (sum <= 1) return inside;
  const double first = std::clamp((1 + inside(0) - inside(1)) / 2, 0.0, 1.0);  // on the side from (1, 0) to (0, 1)
  return {first, 1 - first};
}

Box box_of(const Mesh& mesh, const Cell& cell) {
  Box box;
  for (int a = 0; a < node_count(cell.kind); ++a) box.extend(mesh.nodes.row(cell.nodes[a]).transpose());
  return box;
}

// The box of a cell and of all that may lie beside it.
Box reach_of(const Mesh& mesh, const Cell& cell) {
  const Box box = box_of(mesh, cell);
  const Vec2 margin = Vec2::Constant(reach * box.diagonal().norm());
  return {box.min() - margin, box.max() + margin};
}

// Newton's method, held to the cell at each step.
CellPlace nearest_in(const Mesh& mesh, int e, const Vec2& x) {
  const Cell& cell = mesh.cells[e];
  CellPlace place{e, reference_centre(cell.kind), 0};
  for (int step = 0;; ++step) {
    const CellPoint at = cell_point(mesh.nodes, cell, cell_shape(cell.kind, place.xi));
    place.distance = (x - at.x).norm();
    const Vec2 next = into_cell(cell.kind, place.xi + at.x_xi.transpose().inverse() * (x - at.x));
    if (step == 20 || (next - place.xi).norm() < 1e-14) return place;
    place.xi = next;
  }
}

}  // namespace

std::optional<CellPlace> locate(const Mesh& mesh, int body, const Vec2& x) {
  std::optional<CellPlace> nearest;
  for (int e = 0; e < int(mesh.cells.size()); ++e) {
    const Cell& cell = mesh.cells[e];
    if (cell.body != body) continue;
    if (!reach_of(mesh, cell).contains(x)) continue;
    const CellPlace place = nearest_in(mesh, e, x);
    if (place.distance <= reach * cell_size(mesh, e) && (!nearest || place.distance < nearest->distance))
      nearest = place;
  }
  return nearest;
}

double cell_size(const Mesh& mesh, int cell) { return box_of(mesh, mesh.cells[cell]).diagonal().norm(); }

CellFinder::CellFinder(const Mesh& mesh)
    : mesh_(mesh), cells_([&] {
        std::vector<Box> boxes;
        for (const Cell& cell : mesh.cells) boxes.push_back(reach_of(mesh, cell));
        return boxes;
      }()) {}

std::optional<CellPlace> CellFinder::nearest(const Vec2& x) const {
  const std::vector<int> cells = cells_.meeting(Box(x));
  const auto holds = [&](const CellPlace& place) { return place.distance <= 1e-12 * cell_size(mesh_, place.cell); };
  for (const int e : cells)  // of thin cells hundreds are as near as their length allows, and few have x in their box
    if (box_of(mesh_, mesh_.cells[e]).contains(x))
      if (const CellPlace place = nearest_in(mesh_, e, x); holds(place)) return place;
  std::optional<CellPlace> nearest;
  for (const int e : cells) {
    const CellPlace place = nearest_in(mesh_, e, x);
    const double size = cell_size(mesh_, e);
    if (holds(place)) return place;
    if (place.distance <= reach * size && (!nearest || place.distance < nearest->distance)) nearest = place;
  }
  return nearest;
}

double cell_area(const Mesh& mesh, int cell) {
  const Cell& c = mesh.cells[cell];
  const int corners = corner_count(c.kind);
  double twice = 0;
  for (int a = 0; a < corners; ++a) {
    const auto x = mesh.nodes.row(c.nodes[a]), y = mesh.nodes.row(c.nodes[(a + 1) % corners]);
    twice += x(0) * y(1) - x(1) * y(0);
  }
  return twice / 2;
}

std::vector<CellPlace> CellFinder::around(const Vec2& x) const {
  std::map<int, CellPlace> nearest;  // of each body
  for (const int e : cells_.meeting(Box(x))) {
    const CellPlace place = nearest_in(mesh_, e, x);
    if (place.distance > reach * cell_size(mesh_, e)) continue;
    const auto [found, is_new] = nearest.try_emplace(mesh_.cells[e].body, place);
    if (!is_new && place.distance < found->second.distance) found->second = place;
  }
  std::vector<CellPlace> places;
  for (const auto& [body, place] : nearest) places.push_back(place);
  std::ranges::stable_sort(places, {}, &CellPlace::distance);
  return places;
}

}  // namespace mortise
