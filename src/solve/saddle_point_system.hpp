// The equations of bodies in contact: K u + B^T lambda = f, with B u = g or, on unilateral rows, B u >= g, lambda <= 0
// and lambda (B u - g) = 0; some unknowns prescribed.
#pragma once

#include <algorithm>

#include "base/constraints.hpp"
#include "model/contact_law.hpp"
#include "solve/solution.hpp"

namespace mortise {

/// The law of a layer: that of compressions before this end which are no earlier layer's.
struct LayerLaw {
  ContactLaw law;
  int end;
};

/// l compressions d of surface layers, with the energy sum weight int_0^d p: unknowns of their own beside u
/// (layered_system.hpp). None: all empty.
struct SurfaceLayers {
  std::vector<LayerLaw> laws;
  VecX weight;              ///< l, length times depth
  SparseMatrix B;           ///< m x l: rows are B u + B_d d, length times depth
  std::vector<int> beside;  ///< l: an unknown of the body that each lies on

  bool are_linear() const {
    return std::ranges::all_of(laws, [](const LayerLaw& layer) { return layer.law.is_linear(); });
  }
};

/// Unknowns come in pairs (2 i, 2 i + 1: one node). Any units: the system is made dimensionless by the two scales.
/// Without rows (m = 0) it is that of the bodies alone.
struct SaddlePointSystem {
  SparseMatrix K;              ///< n x n, lower triangle, positive semidefinite, stress units
  VecX f;                      ///< n, force times depth (model/model.hpp)
  Constraints constraints;     ///< n
  double stiffness_scale = 1;  ///< a typical entry of K (Young's modulus)
  /// Unknowns that springs must hold for K to be positive definite (one for each motion that only B resists). The
  /// springs are taken out again exactly: docs/theory.md eq. 18.
  std::vector<int> grounded;

  SparseMatrix B;                ///< m x n, length
  VecX g;                        ///< m, length^2
  VecX row_scale;                ///< m: size of each row of B, length times depth
  std::vector<char> unilateral;  ///< m: rows that may open; empty: none
  std::vector<char> start;       ///< m: rows that are closed at first; empty: all
  SurfaceLayers layers = {};     ///< of rows that give way
};

/// Forces are compared with this part of stiffness times displacement, |K| |u| in their own row, where they are
/// smaller: those of a body that moves without being deformed are round-off of that product, and so are those in thin
/// elements, whose stiffness is many times the material's (|K| |u| is what Oettli & Prager 1964 compare a residual
/// with).
inline constexpr double rigid_part = 1e-3;

/// The grounded unknowns that take part in the solution's rigid modes: springs hold them, with less than 1e-5 of the
/// forces.
std::vector<int> held_unknowns(const std::vector<int>& grounded, const Solution& solution);

/// Of the diagonal of K.
double largest_stiffness(const SparseMatrix& K);

/// f - K u - B^T lambda, where the solution has none computed.
VecX unbalanced_forces(const SaddlePointSystem& system, const Solution& solution);

/// Fills the two residuals of u and lambda, where the `active` rows are closed, and what is unbalanced.
/// held_unknowns() have no residual.
void measure_residuals(const SaddlePointSystem& system, Solution& solution);

}  // namespace mortise
