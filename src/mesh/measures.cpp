#include "mesh/measures.hpp"

#include "base/vectors.hpp"

namespace mortise {
namespace {

/// Weighs a part with its size.
void add(Measure& measure, double size, const Vec2& centre) {
  measure.size += size;
  measure.centre += size * centre;
}

std::vector<Measure> divided(std::vector<Measure> measures) {
  for (Measure& measure : measures) measure.centre /= measure.size;
  return measures;
}

}  // namespace

std::vector<Measure> body_measures(const Mesh& mesh) {
  std::vector<Measure> measures(mesh.bodies.size());
  for (const Cell& cell : mesh.cells) {
    const Vec2 origin = centre_of(mesh.nodes, cell);
    const auto add_triangle = [&](int from, int to) {
      const Vec2 a = mesh.nodes.row(from), b = mesh.nodes.row(to);
      add(measures[cell.body], cross(a - origin, b - origin) / 2, (origin + a + b) / 3);
    };
    for (int i = 0; i < corner_count(cell.kind); ++i) {
      const auto [start, end, middle] = side_edge(cell, i).nodes;
      add_triangle(start, middle < 0 ? end : middle);
      if (middle >= 0) add_triangle(middle, end);
    }
  }
  return divided(std::move(measures));
}

std::vector<Measure> boundary_measures(const Mesh& mesh) {
  std::vector<Measure> measures;
  for (const Boundary& boundary : mesh.boundaries) {
    Measure& measure = measures.emplace_back();
    const auto add_line = [&](int from, int to) {
      const Vec2 a = mesh.nodes.row(from), b = mesh.nodes.row(to);
      add(measure, (b - a).norm(), (a + b) / 2);
    };
    for (const Edge& edge : boundary.edges) {
      const auto [start, end, middle] = edge.nodes;
      add_line(start, middle < 0 ? end : middle);
      if (middle >= 0) add_line(middle, end);
    }
  }
  return divided(std::move(measures));
}

}  // namespace mortise
