#include "error/corner_cells.hpp"

#include <limits>

#include "base/each_once.hpp"
#include "error/corner_tails.hpp"

namespace mortise {
namespace {

void append(const std::array<std::vector<int>, 2>& rings, std::vector<int>& cells) {
  for (const std::vector<int>& ring : rings) cells.insert(cells.end(), ring.begin(), ring.end());
}

// The vertices of a curve at a place: one, or both of the edge within which it is.
std::vector<int> vertices_at(const Points& nodes, const Curve& curve, const Vec2& place) {
  constexpr double at_vertex = 0.25;  // of an edge: nearer to the vertex than to the edge's middle
  double least = std::numeric_limits<double>::infinity();
  std::vector<int> found;
  for (const Edge& edge : curve.edges) {
    const Vec2 start = nodes.row(edge.nodes[0]), chord = nodes.row(edge.nodes[1]).transpose() - start;
    const double along = std::clamp((place - start).dot(chord) / chord.squaredNorm(), 0.0, 1.0);
    const double distance = (start + along * chord - place).norm();
    if (!(distance < least)) continue;
    least = distance;
    found.clear();
    if (along < 1 - at_vertex) found.push_back(edge.nodes[0]);
    if (along > at_vertex) found.push_back(edge.nodes[1]);
  }
  return found;
}

}  // namespace

std::vector<int> cells_at_contact(const Mesh& mesh, const SideTable& table, const std::vector<ContactPair>& pairs,
                                  const std::vector<PressureEstimate>& pressures) {
  std::vector<int> cells;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    for (const SingularPoint& point : pressures[k].singular)
      for (const Curve* curve : {&pairs[k].multiplier, &pairs[k].opposite})
        append(rings_about(mesh, table, vertices_at(mesh.nodes, *curve, point.position)), cells);
  keep_each_once(cells);
  return cells;
}

std::vector<int> cells_at_corners(const Problem& problem, const std::vector<PressureEstimate>& pressures,
                                  EstimateMemory& memory) {
  const SideTable& table = memory.around(problem).table;
  std::vector<int> cells = cells_at_contact(problem.mesh, table, problem.pairs, pressures);
  for (const BodyCorner& corner : memory.corners(problem))
    append(rings_about(problem.mesh, table, {corner.node}), cells);
  keep_each_once(cells);
  return cells;
}

VecX unseen_at_corners(const Mesh& mesh, const std::vector<int>& cells, const MatX& parts) {
  VecX unseen = VecX::Zero(parts.cols());
  for (const int e : cells) unseen += (is_quadratic(mesh.cells[e].kind) ? 1 : 2) * parts.row(e).cwiseAbs().transpose();
  return unseen;
}

}  // namespace mortise
