// How far stresses are off, in the energy norm.
#pragma once

#include "fem/error_products.hpp"

namespace mortise {

/// What stresses recovered by patches say of the discretisation error (fem/patch_recovery.hpp). Blind to where contact
/// ends within an edge, and to what a load does within an element.
struct EnergyEstimate {
  double error;   ///< energy norm of the error over that of the stresses; 0 where these are round-off of displacements
  VecX density;   ///< squared, of each cell by its area: energy per volume times two, stress
  VecX areas;     ///< of each cell, length^2
  int body;       ///< whose part of the squared error is the largest
  double part;    ///< that part, 0 ... 1
  Vec2 position;  ///< the cell in it with the largest share
};

/// `found`: of displacements u alone, or first; `stiffness_scale`: as of SaddlePointSystem.
EnergyEstimate energy_estimate(const Mesh& mesh, const ErrorProducts& found, double stiffness_scale, const VecX& u);

}  // namespace mortise
