// A mesh as solvers' decks hold it: elements, and named sets of nodes, of elements and of sides.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh_files/mesh_data.hpp"

namespace mortise {

struct SetElement {
  std::int64_t tag;
  int type;                ///< gmsh's number of the kind, 0 of one that is left out
  std::vector<int> nodes;  ///< rows of SetMesh::nodes
};

bool is_cell(const SetElement& element);
int corners_of(const SetElement& cell);

/// Rows of nodes or of elements, rising, each once.
struct NamedSet {
  std::string name;
  std::vector<int> members;
};

/// Sides of cells by their end nodes, and all sides on the boundary of some cells.
struct SideSet {
  std::string name;
  std::vector<std::array<int, 2>> ends;
  std::vector<int> cells;
};

struct SetMesh {
  std::string file;  ///< for messages
  std::vector<std::array<double, 3>> nodes;
  std::vector<SetElement> elements;
  std::vector<NamedSet> node_sets, element_sets;
  std::vector<std::vector<int>> candidates;  ///< lists of element sets: the first that parts the cells are the bodies
  std::vector<int> bodies;                   ///< the element sets that the file says are bodies
  std::vector<SideSet> sides;
  std::vector<std::string> notes;
  bool named_by_tag = false;  ///< whether sets were named by numbers of the file
};

/// For files that number the properties of elements: cells of one property are a candidate for a body, surface_7, after
/// the sets that have cells; its lines are a curve, curve_7, if no set makes curves. -1: none.
void add_property_sets(const std::vector<std::int64_t>& properties, SetMesh& mesh);

/// Bodies: the sets that the file says, else of the candidates, each part that has no nodes in common with the others
/// for itself as SET_1, SET_2 ...; else the parts that have no nodes in common, called surface_1, surface_2 ... Curves:
/// the sides in `sides`; the lines of element sets that are sides of cells; the sides on a body's boundary that have
/// all their nodes in a node set. Points: node sets without such sides. Throws InputError: no cells, a cell in no body
/// or in two.
MeshData data_of_sets(const SetMesh& mesh);

}  // namespace mortise
