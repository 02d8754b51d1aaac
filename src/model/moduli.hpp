// Elastic constants of materials that are not isotropic.
#pragma once

#include <Eigen/Cholesky>
#include <optional>

#include "base/types.hpp"

namespace mortise {

/// For three directions at right angles, the third out of the plane; nu_ij = -eps_j / eps_i under a stress along i.
struct OrthotropicModuli {
  double e1 = 0, e2 = 0, e3 = 0;        ///< stress, > 0
  double nu12 = 0, nu13 = 0, nu23 = 0;  ///< nu_ji = nu_ij E_j / E_i
  double g12 = 0;                       ///< stress, > 0
  double angle = 0;                     ///< from x1 to direction 1, radians

  bool operator==(const OrthotropicModuli&) const = default;
};

/// Stiffness (11, 22, 33, gamma_12) in the axes of the plane; nothing where the moduli belong to no material, as not
/// every strain has a positive energy (Lempriere 1968).
std::optional<Mat4> orthotropic_stiffness(const OrthotropicModuli& moduli);

/// Whether every strain has a positive energy.
bool is_stiffness(const Mat4& stiffness);

/// Of a positive definite matrix, without its determinant: that of moduli of 1e300 is beyond double precision.
template <class Matrix>
Matrix inverse(const Matrix& positive) {
  return positive.llt().solve(Matrix::Identity());
}

}  // namespace mortise
