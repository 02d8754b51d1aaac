#include "mesh/orientation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "base/vectors.hpp"

namespace mortise {
namespace {

[[noreturn]] void fail(const Mesh& mesh, const Cell& cell, const std::string& trouble) {
  const int corners = corner_count(cell.kind);
  Vec2 centre = Vec2::Zero();
  for (int i = 0; i < corners; ++i) centre += mesh.nodes.row(cell.nodes[i]).transpose() / corners;
  throw InputError(mesh.source + ": body '" + mesh.bodies[cell.body] + "': the cell " + near_point(centre) + " " +
                   trouble);
}

/// Twice the area between the corners, positive counter-clockwise.
/// Throws if it is nothing against the longest diagonal, or if the straight sides cross (two corners turn each way).
double signed_area(const Mesh& mesh, const Cell& cell) {
  const int corners = corner_count(cell.kind);
  const auto corner = [&](int i) -> Vec2 { return mesh.nodes.row(cell.nodes[i % corners]).transpose(); };
  double area = 0;
  double longest = 0;
  int left_turns = 0;
  for (int i = 0; i < corners; ++i) {
    const Vec2 side = corner(i + 1) - corner(i);
    area += cross(corner(i) - corner(0), side);
    longest = std::max({longest, side.squaredNorm(), (corner(i + 2) - corner(i)).squaredNorm()});
    if (cross(side, corner(i + 2) - corner(i + 1)) > 0) ++left_turns;
  }
  if (corners == 4 && left_turns == 2) fail(mesh, cell, "is inverted: its sides cross");
  if (!(std::abs(area) > 1e-12 * longest)) fail(mesh, cell, "is degenerate: it has no area");
  return area;
}

/// The same cell the other way round, from the same corner: corners a b c d become a d c b, and the middle of the
/// new side i is that of the old side (corners - 1 - i).
void reverse(Cell& cell) {
  const int corners = corner_count(cell.kind);
  std::reverse(cell.nodes.begin() + 1, cell.nodes.begin() + corners);
  if (is_quadratic(cell.kind)) std::reverse(cell.nodes.begin() + corners, cell.nodes.begin() + 2 * corners);
}

/// Two cells on the same side of an edge: one was not listed the other way round, it lies over the other.
void check_not_folded(const Mesh& mesh, std::size_t first, const std::vector<char>& was_clockwise,
                      bool clockwise_is_odd) {
  std::map<std::pair<int, int>, std::size_t> sides;
  for (std::size_t c = first; c < mesh.cells.size(); ++c)
    for (int i = 0; i < corner_count(mesh.cells[c].kind); ++i) {
      const Edge side = side_edge(mesh.cells[c], i);
      const auto [other, is_new] = sides.emplace(std::pair(side.nodes[0], side.nodes[1]), c);
      if (is_new) continue;
      const bool this_one = bool(was_clockwise[c - first]) == clockwise_is_odd;
      fail(mesh, mesh.cells[this_one ? c : other->second],
           "is inverted: it runs the other way round than the rest of its surface");
    }
}

}  // namespace

std::size_t orient_cells(Mesh& mesh, std::size_t first) {
  std::size_t clockwise = 0;
  std::vector<char> is_clockwise(mesh.cells.size() - first);
  for (std::size_t c = first; c < mesh.cells.size(); ++c) {
    const bool negative = signed_area(mesh, mesh.cells[c]) < 0;
    clockwise += negative ? 1 : 0;
    is_clockwise[c - first] = negative;
  }
  if (clockwise == 0) return 0;

  for (std::size_t c = first; c < mesh.cells.size(); ++c)
    if (is_clockwise[c - first]) reverse(mesh.cells[c]);
  const std::size_t count = mesh.cells.size() - first;
  if (clockwise == count) return 0;
  check_not_folded(mesh, first, is_clockwise, 2 * clockwise <= count);
  return 2 * clockwise <= count ? clockwise : count - clockwise;
}

}  // namespace mortise
