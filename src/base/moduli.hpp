// Elastic constants of materials that are not isotropic.
#pragma once

#include "base/types.hpp"

namespace mortise {

/// Of three directions at right angles, the third out of the plane; nu_ij = -eps_j / eps_i under a stress along i.
struct OrthotropicModuli {
  double e1 = 0, e2 = 0, e3 = 0;        ///< stress, > 0
  double nu12 = 0, nu13 = 0, nu23 = 0;  ///< nu_ji = nu_ij E_j / E_i
  double g12 = 0;                       ///< stress, > 0
  double angle = 0;                     ///< from x1 to direction 1, radians
};

}  // namespace mortise
