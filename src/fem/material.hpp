// Linear isotropic elasticity in the plane, with an initial strain.
#pragma once

#include "base/choices.hpp"
#include "base/types.hpp"

namespace mortise {

/// Hooke's law of one body, docs/theory.md eq. (2): stress (11, 22, 33, 12) =
/// stiffness * (eps_11, eps_22, gamma_12) + stress0, with stress0 = -C : initial strain (preprint eq. 5).
struct ElasticLaw {
  Eigen::Matrix<double, 4, 3> stiffness;
  Vec4 stress0 = Vec4::Zero();
  /// Energy density 1/2 eps0 : C : eps0 of the initial strain held at zero strain, stress.
  double energy0 = 0;
  double young = 0;
};

/// `initial_strain` is (11, 22, 33, 12) with the tensor shear strain 12; in plane stress its 33 has no effect.
/// Plane strain holds eps_33 = 0, plane stress sigma_33 = 0.
/// Expects young > 0 and -1 < poisson < 1/2.
ElasticLaw elastic_law(double young, double poisson, Plane plane, const Vec4& initial_strain = Vec4::Zero());

/// Stiffness of a body's edge against a pressure on it: E / (1 - nu^2) in plane strain, E in plane stress.
double contact_modulus(const ElasticLaw& law);

/// sqrt(3/2 s:s), s the deviator of (11, 22, 33, 12).
double von_mises(const Vec4& stress);

}  // namespace mortise
