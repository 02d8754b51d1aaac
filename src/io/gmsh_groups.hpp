// Physical groups of the mesh that gmsh has open. No gmsh header here.
#pragma once

#include <string>
#include <vector>

namespace mortise {

/// A named physical surface or curve.
struct PhysicalGroup {
  int tag;
  std::string name;
  std::vector<int> entities;  ///< tags of its surfaces or curves
};

/// Physical groups of dimension 1 or 2, by tag.
/// Throws InputError naming `file` where a group has no name, or two have the same.
std::vector<PhysicalGroup> physical_groups(const std::string& file, int dimension);

/// Throws InputError where a surface that carries cells is in no physical surface or in two, or if there is none.
void check_surfaces(const std::string& file, const std::vector<PhysicalGroup>& bodies);

}  // namespace mortise
