// A mesh as plain data: nodes, cells grouped by body, named boundaries made of edges.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/types.hpp"
#include "mesh/edge_samples.hpp"

namespace mortise {

enum class CellKind { tri3, tri6, quad4, quad8, quad9 };

/// The one list of kinds, for all that goes through them.
inline constexpr std::array all_cell_kinds{CellKind::tri3, CellKind::tri6, CellKind::quad4, CellKind::quad8,
                                           CellKind::quad9};

constexpr int node_count(CellKind kind) {
  switch (kind) {
    case CellKind::tri3:
      return 3;
    case CellKind::tri6:
      return 6;
    case CellKind::quad4:
      return 4;
    case CellKind::quad8:
      return 8;
    case CellKind::quad9:
      return 9;
  }
  return 0;  // no kind
}

// A new kind does not compile until it stands in every switch over kinds, and here until it stands in the list.
static_assert(node_count(CellKind(all_cell_kinds.size())) == 0);

constexpr int corner_count(CellKind kind) { return kind == CellKind::tri3 || kind == CellKind::tri6 ? 3 : 4; }

constexpr bool is_quadratic(CellKind kind) { return kind != CellKind::tri3 && kind != CellKind::quad4; }

/// A value for each kind: value[int(kind)].
template <typename T>
using ForEachKind = std::array<T, all_cell_kinds.size()>;

/// Calls visit.operator()<kind>() for each kind.
template <typename Visit>
void for_each_kind(Visit visit) {
  [&]<std::size_t... k>(std::index_sequence<k...>) { (visit.template operator()<all_cell_kinds[k]>(), ...); }
  (std::make_index_sequence<all_cell_kinds.size()>());
}

/// Nodes of a cell: corners counter-clockwise, then the middles of the sides (side i joins corner i to i+1),
/// then the centre of a quad9. The order of gmsh and of VTK.
struct Cell {
  CellKind kind;
  int body;                  ///< index into Mesh::bodies
  std::array<int, 9> nodes;  ///< rows of Mesh::nodes; the first node_count(kind) are used
};

/// An edge of a cell: both ends, and the middle node if node_count is 3.
struct Edge {
  int node_count;            ///< 2 or 3
  std::array<int, 3> nodes;  ///< start, end, middle (middle = -1 when node_count is 2)
};

/// A physical curve.
struct Boundary {
  std::string name;
  std::vector<Edge> edges;                ///< in no particular order or direction
  std::vector<EdgeSamples> samples = {};  ///< of each edge; empty where only the mesh is known
  std::string undrawn = {};               ///< why there are none although the file draws a geometry
  int piece_of = -1;                      ///< the boundary of which it is a chain (problem/contact_curves.hpp)
};

/// A physical point.
struct NamedPoint {
  std::string name;
  std::vector<int> nodes;  ///< rows of Mesh::nodes, rising: one or more
};

/// A node whose place and displacement follow those of others: the sum of weight * that of the other.
struct TiedNode {
  int node;
  std::vector<std::pair<int, double>> weights;  ///< they add up to 1
  double area;                                  ///< int psi dA of its multiplier, length times depth
  int beside;  ///< the next node of an edge that it ends: the middle one, or the other end
};

/// A straight cut of a tie that draws its faces into each other, along one normal.
struct Pretension {
  Vec2 normal;                    ///< of the curve that follows, out of its body
  std::optional<double> force;    ///< times depth (model/model.hpp), + draws them together
  std::optional<double> overlap;  ///< length, + into each other; none: what the force makes of it
};

/// Two curves that are one: the nodes of the first follow the second, or that turned about the origin.
struct Tie {
  std::string key;  ///< of the scene, for messages
  int entry = 0;    ///< which of the scene's [[contact]]
  std::array<std::string, 2> curves;
  std::array<int, 2> boundary, body;
  std::vector<TiedNode> nodes;
  std::optional<Pretension> pretension = {};
  Eigen::Matrix2d turn = Eigen::Matrix2d::Identity();
};

/// Two boundaries, by name, that an earlier solve of the same geometry knows to be in contact: patterns pair them
/// however far apart they are drawn (problem/contact_curves.hpp).
struct KnownPair {
  std::array<std::string, 2> curves;
  bool first_is_multiplier;  ///< and stays it; else the choice is free
};

struct Mesh {
  std::string source;                ///< the file it came from, for messages
  Points nodes;                      ///< every node belongs to at least one cell
  std::vector<Cell> cells;           ///< sorted by body
  std::vector<std::string> bodies;   ///< physical surfaces, a name each, all different
  std::vector<Boundary> boundaries;  ///< physical curves, by names that are all different
  std::vector<NamedPoint> points;    ///< physical points that are nodes of cells
  std::vector<Tie> ties;             ///< as the scene has them (problem/ties.hpp)
  std::vector<std::string> notes;    ///< what was mended when it was read, a sentence each
  bool named_by_tag = false;         ///< whether a body or a boundary had no name in the file
  std::vector<KnownPair> known_pairs;
};

/// Index of the body or boundary called `name`. Throws InputError with the known names.
int body_index(const Mesh& mesh, const std::string& name);
int boundary_index(const Mesh& mesh, const std::string& name);

/// Names of all boundaries, in their order.
std::vector<std::string> boundary_names(const Mesh& mesh);

/// The side of a cell that an edge lies on.
struct CellSide {
  int cell;  ///< index into Mesh::cells
  int side;  ///< joins corner `side` to the next one, counter-clockwise
};

/// Mean of a cell's corners.
Vec2 centre_of(const Points& nodes, const Cell& cell);

/// Nodes of a side, in the cell's counter-clockwise direction: the body lies on its left.
Edge side_edge(const Cell& cell, int side);

}  // namespace mortise
