// Structured meshes of two plates that meet along a line, without gmsh.
#pragma once

#include <functional>

#include "mesh/mesh.hpp"

namespace mortise::test {

/// The contact line x2 = height(x1) between plates that fill 0 <= x1 <= width, bottom <= x2 <= top.
/// Vertices are even in x1, middle nodes of the contact line lie on it.
struct TwoPlates {
  std::function<double(double)> height = [](double) { return 0.3; };
  int n_upper = 7, n_lower = 11;
  CellKind kind_upper = CellKind::quad8, kind_lower = CellKind::quad8;
  double width = 0.8, bottom = 0, top = 0.6;
};

/// Bodies "upper", "lower"; boundaries top, bottom, upper_left, upper_right, lower_left, lower_right, upper_contact,
/// lower_contact. 3/8 n elements through each plate, at least one.
Mesh mesh_of(const TwoPlates& plates);

}  // namespace mortise::test
