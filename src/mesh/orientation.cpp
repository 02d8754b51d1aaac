#include "mesh/orientation.hpp"

#include <algorithm>
#include <cmath>

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

}  // namespace

void orient_cells(Mesh& mesh, std::size_t first) {
  std::size_t clockwise = 0;
  std::size_t last_of[2] = {first, first};  // the last cell of each orientation
  for (std::size_t c = first; c < mesh.cells.size(); ++c) {
    const bool negative = signed_area(mesh, mesh.cells[c]) < 0;
    clockwise += negative ? 1 : 0;
    last_of[negative ? 1 : 0] = c;
  }
  if (clockwise == 0) return;

  const std::size_t count = mesh.cells.size() - first;
  if (clockwise != count) {
    const Cell& odd_one = mesh.cells[last_of[2 * clockwise <= count ? 1 : 0]];
    fail(mesh, odd_one, "is inverted: it runs the other way round than the rest of its surface");
  }
  for (std::size_t c = first; c < mesh.cells.size(); ++c) reverse(mesh.cells[c]);
}

}  // namespace mortise
