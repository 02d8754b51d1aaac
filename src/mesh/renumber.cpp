#include "mesh/renumber.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/errors.hpp"
#include "base/printable.hpp"

namespace mortise {
namespace {

constexpr std::uint32_t bits = 16;  // per axis: 65536 x 65536 squares

/// Position of the square (x, y) along the Hilbert curve, two bits a level from the coarsest down; the turn of the
/// pattern from level to level is done by turning x and y instead (H. S. Warren, Hacker's Delight, chapter 16).
std::uint64_t hilbert(std::uint32_t x, std::uint32_t y) {
  std::uint64_t position = 0;
  for (std::uint32_t s = 1U << (bits - 1); s > 0; s >>= 1) {
    const std::uint32_t rx = (x & s) ? 1 : 0;
    const std::uint32_t ry = (y & s) ? 1 : 0;
    position = 4 * position + ((3 * rx) ^ ry);
    if (ry == 0) {
      if (rx == 1) {
        x = ~x;
        y = ~y;
      }
      std::swap(x, y);
    }
  }
  return position;
}

struct CellKey {
  int body;
  std::uint64_t position;
  int cell;
  bool operator<(const CellKey& other) const {
    if (body != other.body) return body < other.body;
    if (position != other.position) return position < other.position;
    return cell < other.cell;
  }
};

std::vector<CellKey> cell_order(const Mesh& mesh) {
  const Vec2 low = mesh.nodes.colwise().minCoeff().transpose();
  const Vec2 high = mesh.nodes.colwise().maxCoeff().transpose();
  const double size = (high - low).maxCoeff();
  const double scale = size > 0 ? ((1U << bits) - 1) / size : 0.0;

  std::vector<CellKey> keys(mesh.cells.size());
  for (std::size_t c = 0; c < keys.size(); ++c) {
    const Cell& cell = mesh.cells[c];
    const int corners = corner_count(cell.kind);
    Vec2 sum = Vec2::Zero();
    for (int i = 0; i < corners; ++i) sum += mesh.nodes.row(cell.nodes[i]).transpose();
    const Vec2 square = scale * (sum / corners - low);
    keys[c] = {cell.body, hilbert(static_cast<std::uint32_t>(square.x()), static_cast<std::uint32_t>(square.y())),
               static_cast<int>(c)};
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

void sort_cells(Mesh& mesh) {
  std::vector<Cell> sorted;
  sorted.reserve(mesh.cells.size());
  for (const CellKey& key : cell_order(mesh)) sorted.push_back(mesh.cells[key.cell]);
  mesh.cells = std::move(sorted);
}

/// New number of each node, -1 for the nodes of no cell; renumbers the cells on its way.
std::vector<int> number_by_cells(Mesh& mesh) {
  std::vector<int> number(mesh.nodes.rows(), -1);
  int count = 0;
  for (Cell& cell : mesh.cells) {
    for (int i = 0; i < node_count(cell.kind); ++i) {
      int& node = cell.nodes[i];
      if (number[node] < 0) number[node] = count++;
      node = number[node];
    }
  }
  return number;
}

void renumber_boundary(const Mesh& mesh, const std::vector<int>& number, Boundary& boundary) {
  for (Edge& edge : boundary.edges) {
    for (int i = 0; i < edge.node_count; ++i) {
      const int node = edge.nodes[i];
      if (number[node] < 0) {
        throw InputError(mesh.source + ": boundary '" + boundary.name + "': the edge " +
                         near_point(mesh.nodes.row(node).transpose()) + " belongs to no body");
      }
      edge.nodes[i] = number[node];
    }
  }
}

void renumber_points(const std::vector<int>& number, std::vector<NamedPoint>& points) {
  for (NamedPoint& point : points) {
    for (int& node : point.nodes) node = number[node];
    std::erase(point.nodes, -1);
    std::ranges::sort(point.nodes);
  }
  std::erase_if(points, [](const NamedPoint& point) { return point.nodes.empty(); });
}

}  // namespace

void renumber(Mesh& mesh) {
  if (mesh.cells.empty()) return;
  sort_cells(mesh);
  const std::vector<int> number = number_by_cells(mesh);
  for (Boundary& boundary : mesh.boundaries) renumber_boundary(mesh, number, boundary);
  renumber_points(number, mesh.points);

  Points nodes(*std::max_element(number.begin(), number.end()) + 1, 2);
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] >= 0) nodes.row(number[i]) = mesh.nodes.row(static_cast<Eigen::Index>(i));
  }
  mesh.nodes = std::move(nodes);
}

}  // namespace mortise
