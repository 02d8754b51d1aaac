// VTK unstructured grids (.vtu), quadratic cells kept quadratic.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace mortise {

/// A named value at each point or cell: one row a point or cell, 1, 2, 3 or 4 columns.
/// Two columns (a plane vector) are written as three with a zero; others as they are.
struct VtuField {
  std::string name;
  MatX values;
  std::vector<std::string> components;  ///< names of the columns, may be empty
};

/// Points and cells with their fields. Cells or edges, not both.
struct VtuGrid {
  Points points;
  std::vector<Cell> cells;  ///< nodes are rows of `points`
  std::vector<Edge> edges;
  std::vector<VtuField> point_fields;
  std::vector<VtuField> cell_fields;
};

/// In one line why write_vtu cannot write here: VTK, a package of its own, cannot be loaded. Nothing if it can.
std::optional<std::string> why_no_vtu();

/// Binary appended, zlib-compressed only if that does not cost more time than it saves. Throws InputError if the
/// file cannot be written, or VTK cannot be loaded.
void write_vtu(const std::filesystem::path& path, const VtuGrid& grid);

}  // namespace mortise
