// What gmsh makes of curves that a .geo has it mesh as one: Compound Curve. No gmsh header here.
#pragma once

#include <vector>

#include "mesh_files/mesh_data.hpp"

namespace mortise {

/// Tags of curves: those that are one of others, and these others.
struct CompoundCurves {
  std::vector<int> compounds, members;
};

/// A compound has a mesh of its own beside those of its members. Surfaces that are compound too are meshed from it, all
/// others from the members: takes away of both what no cell touches. `data`: with the members in the groups that they
/// are drawn in. Throws InputError where surfaces are meshed from a compound that is not in the groups of its members.
void leave_compounds(const CompoundCurves& curves, MeshData& data);

}  // namespace mortise
