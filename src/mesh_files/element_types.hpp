// The kinds of elements that gmsh knows, by the numbers that .msh files give them.
#pragma once

#include <string>

namespace mortise {

struct ElementType {
  int number;
  int dimension;
  int node_count;
  const char* name;  ///< gmsh's, such as "Triangle 10"
};

/// Null for a number that gmsh does not have, and for kinds without a fixed number of nodes (polygons).
const ElementType* element_type(int number);

}  // namespace mortise
