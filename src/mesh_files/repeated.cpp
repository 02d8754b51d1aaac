#include "mesh_files/repeated.hpp"

#include <algorithm>
#include <array>

#include "base/errors.hpp"
#include "base/printable.hpp"

namespace mortise {
namespace {

/// Corners of a cell or ends of an edge in rising order, -1 where there are fewer than four.
using Corners = std::array<int, 4>;

Corners corners_of(const Cell& cell) {
  Corners corners{-1, -1, -1, -1};
  std::copy_n(cell.nodes.begin(), corner_count(cell.kind), corners.begin());
  std::sort(corners.begin(), corners.begin() + corner_count(cell.kind));
  return corners;
}

Corners corners_of(const Edge& edge) {
  const auto [low, high] = std::minmax(edge.nodes[0], edge.nodes[1]);
  return {low, high, -1, -1};
}

/// Two elements with the same corners, or {-1, -1}. Elements with the same first corner are held in a chain: `last`
/// is the newest of each node, `before` the one before each element; few elements meet at a node.
template <typename Element>
std::array<int, 2> find_repeated(const std::vector<Element>& elements, std::vector<int>& last) {
  std::vector<int> before(elements.size(), -1);
  std::array<int, 2> found{-1, -1};
  for (int e = 0; e < static_cast<int>(elements.size()) && found[0] < 0; ++e) {
    const Corners corners = corners_of(elements[e]);
    for (int other = last[corners[0]]; other >= 0; other = before[other]) {
      if (corners_of(elements[other]) == corners) found = {other, e};
    }
    before[e] = last[corners[0]];
    last[corners[0]] = e;
  }
  for (const Element& element : elements) last[corners_of(element)[0]] = -1;
  return found;
}

std::string middle_of(const Mesh& mesh, const Corners& corners) {
  Vec2 sum = Vec2::Zero();
  int count = 0;
  for (const int node : corners) {
    if (node < 0) continue;
    sum += mesh.nodes.row(node).transpose();
    ++count;
  }
  return near_point(sum / count);
}

}  // namespace

void check_no_repetition(const Mesh& mesh) {
  std::vector<int> last(mesh.nodes.rows(), -1);
  if (const auto [first, second] = find_repeated(mesh.cells, last); first >= 0) {
    const std::string& body = mesh.bodies[mesh.cells[first].body];
    const std::string& other = mesh.bodies[mesh.cells[second].body];
    throw InputError(mesh.source + ": the cell " + middle_of(mesh, corners_of(mesh.cells[first])) +
                     " is listed twice, in " +
                     (body == other ? "body '" + body + "'" : "the bodies '" + body + "' and '" + other + "'"));
  }
  for (const Boundary& boundary : mesh.boundaries) {
    if (const auto [first, second] = find_repeated(boundary.edges, last); first >= 0) {
      throw InputError(mesh.source + ": boundary '" + boundary.name + "': the edge " +
                       middle_of(mesh, corners_of(boundary.edges[first])) + " is listed twice");
    }
  }
}

}  // namespace mortise
