#include "problem/held_pieces.hpp"

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "base/union_find.hpp"
#include "fem/rigid_motions.hpp"

namespace mortise {
namespace {

// Of each cell, by the first that hangs together with it.
std::vector<int> pieces_of_cells(const Mesh& mesh) {
  std::vector<std::vector<int>> cells(mesh.bodies.size());
  for (int e = 0; e < int(mesh.cells.size()); ++e) cells[mesh.cells[e].body].push_back(e);
  UnionFind pieces(mesh.cells.size());
  std::vector<int> last(mesh.nodes.rows(), -1);  // cell at each node
  for (std::size_t body = 0; body < cells.size(); ++body)
    for (const int e : cells[body])
      for (int a = 0; a < node_count(mesh.cells[e].kind); ++a) {
        int& before = last[mesh.cells[e].nodes[a]];
        if (before >= 0 && mesh.cells[before].body == int(body)) pieces.join(before, e);
        before = e;
      }
  std::vector<int> of_cells;
  for (int e = 0; e < int(mesh.cells.size()); ++e) of_cells.push_back(pieces.find(e));
  return of_cells;
}

}  // namespace

void require_held_pieces(const Mesh& mesh, const Constraints& constraints, const std::vector<std::string>& findings) {
  const std::vector<int> pieces = pieces_of_cells(mesh);
  std::vector<int> first;  // cell of each piece
  for (int e = 0; e < int(pieces.size()); ++e)
    if (pieces[e] == e) first.push_back(e);
  if (first.size() == mesh.bodies.size()) return;
  std::vector<int> number(mesh.cells.size()), count(mesh.bodies.size(), 0);
  Mesh parts = mesh;
  parts.bodies.clear();
  for (const int e : first) {
    number[e] = int(parts.bodies.size());
    parts.bodies.push_back(mesh.bodies[mesh.cells[e].body]);
    ++count[mesh.cells[e].body];
  }
  for (std::size_t e = 0; e < pieces.size(); ++e) parts.cells[e].body = number[pieces[e]];
  for (const auto& motion : free_motions(parts, constraints, SparseMatrix(0, 2 * mesh.nodes.rows())))
    for (const RigidMotion& of : motion) {
      const Cell& cell = mesh.cells[first[of.body]];
      if (count[cell.body] == 1) continue;
      throw SceneError(worded("body '", mesh.bodies[cell.body], "' is ", count[cell.body],
                              " pieces, of which nothing but contact can hold that ",
                              near_point(centre_of(mesh.nodes, cell)),
                              "; expected a body of its own for each piece that contact is to hold",
                              findings.empty() ? "" : ": " + findings.front()));
    }
}

}  // namespace mortise
