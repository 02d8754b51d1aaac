#include "fem/material.hpp"

#include <cassert>
#include <cmath>

namespace mortise {

ElasticLaw elastic_law(double young, double poisson, Plane plane, const Vec4& initial_strain) {
  assert(young > 0 && poisson > -1 && poisson < 0.5);
  const double mu = young / (2 * (1 + poisson));
  const double lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  // sigma_33 = 0 turns lambda into 2 mu lambda / (lambda + 2 mu).
  const double coupling = plane == Plane::strain ? lame : young * poisson / (1 - poisson * poisson);

  ElasticLaw law;
  law.young = young;
  law.stiffness << coupling + 2 * mu, coupling, 0,                              //
      coupling, coupling + 2 * mu, 0,                                           //
      plane == Plane::strain ? lame : 0, plane == Plane::strain ? lame : 0, 0,  //
      0, 0, mu;
  const Vec4& e = initial_strain;
  law.stress0 = -law.stiffness * Eigen::Vector3d(e(0), e(1), 2 * e(3));
  if (plane == Plane::strain) law.stress0 -= e(2) * Vec4(lame, lame, lame + 2 * mu, 0);
  law.energy0 = -0.5 * (law.stress0.head<3>().dot(e.head<3>()) + 2 * law.stress0(3) * e(3));
  return law;
}

double contact_modulus(const ElasticLaw& law) {
  const double c11 = law.stiffness(0, 0), c12 = law.stiffness(0, 1);
  return (c11 * c11 - c12 * c12) / c11;
}

double von_mises(const Vec4& s) {
  const double a = s(0) - s(1), b = s(1) - s(2), c = s(2) - s(0);
  return std::sqrt((a * a + b * b + c * c) / 2 + 3 * s(3) * s(3));
}

}  // namespace mortise
