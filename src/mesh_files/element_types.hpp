// The kinds of elements that gmsh knows, by the numbers that .msh files give them.
#pragma once

#include <optional>
#include <string>

#include "mesh/mesh.hpp"

namespace mortise {

enum class ElementShape { point, line, triangle, quadrilateral, tetrahedron, pyramid, prism, hexahedron };

struct ElementType {
  int number;
  ElementShape shape;
  int node_count;

  int dimension() const;
  std::string name() const;  ///< gmsh's, such as "Triangle 10"
};

/// Null for a number that gmsh does not have, and for kinds without a fixed number of nodes (polygons).
const ElementType* element_type(int number);

/// Of the kinds that meshes here are made of, the numbers.
inline constexpr int point_type = 15;
constexpr int line_type(int nodes) { return nodes == 2 ? 1 : 8; }
int cell_type(CellKind kind);

constexpr bool is_line(int number) { return number == line_type(2) || number == line_type(3); }
constexpr int line_node_count(int number) { return number == line_type(2) ? 2 : 3; }
std::optional<CellKind> cell_kind(int number);

/// The number of the cells that decks have, by their nodes: 3, 4, 6 or 8; 0 for others.
int deck_cell_type(int nodes);

}  // namespace mortise
