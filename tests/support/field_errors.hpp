// How far computed displacements are from an exact field, by quadrature.
#pragma once

#include <functional>

#include "fem/material.hpp"
#include "mesh/mesh.hpp"

namespace mortise::test {

/// An exact solution: displacement (length) and stress (11, 22, 33, 12) at a place of a body.
struct Field {
  std::function<Vec2(const Vec2& x, int body)> displacement;
  std::function<Vec4(const Vec2& x, int body)> stress;
};

/// Absolute: L2 norm of the error of u, and the energy norm sqrt(int d : C^-1 : d), d the error of the stress in the
/// plane.
struct FieldErrors {
  double displacement, energy;
};

/// 4 x 4 points a cell. With u = 0 and no initial strain the errors are the norms of the exact field itself.
FieldErrors field_errors(const Mesh& mesh, const std::vector<ElasticLaw>& laws, const VecX& u, const Field& exact);

}  // namespace mortise::test
