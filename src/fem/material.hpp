// Linear elasticity in a plane or in the meridian plane of rings, with an initial strain.
#pragma once

#include <functional>

#include "base/types.hpp"
#include "model/model.hpp"

namespace mortise {

/// A strain (11, 22, 33, 12), with the tensor shear strain 12, of the place; empty: none.
using StrainField = std::function<Vec4(const Vec2&)>;

/// Hooke's law of one body, docs/theory.md eq. (2): stress (11, 22, 33, 12) =
/// stiffness * (eps_11, eps_22, eps_33, gamma_12) + stress0, with stress0 = -C : initial strain (preprint eq. 5).
/// 33 is the direction out of the plane: eps_33 = 0 in plane strain, sigma_33 = 0 in plane stress (the stiffness has
/// it eliminated), eps_33 = u_1 / x_1 in rings.
struct ElasticLaw {
  Model model;
  Mat4 stiffness;
  /// Its inverse, (11, 22, 33, gamma_12); in plane stress of the rest, with zeros for 33.
  Mat4 compliance;
  /// sigma_33 of (sigma_11, sigma_22, sigma_12) without initial strain; of rings that is no function of these.
  Eigen::RowVector3d out_of_plane;
  double young = 0;  ///< the largest modulus
  StrainField initial_strain;

  /// -C : initial strain at a place.
  Vec4 stress0(const Vec2& x) const;
  /// Energy density 1/2 eps0 : C : eps0 of the initial strain held at zero strain, stress.
  double energy0(const Vec2& x) const;
  /// To six digits.
  bool is_isotropic_in_plane() const;
};

/// Isotropic. Expects young > 0 and -1 < poisson < 1/2.
ElasticLaw elastic_law(double young, double poisson, const Model& model, StrainField initial_strain = {});

/// Of any stiffness, (11, 22, 33, gamma_12), positive definite; for plane stress without_33. `young`: of its size.
ElasticLaw elastic_law(const Mat4& stiffness, const Model& model, double young, StrainField initial_strain = {});

/// The stiffness with sigma_33 = 0 eliminated; row and column 33 are zero.
Mat4 without_33(Mat4 stiffness);

/// Stiffness of a body's edge against a pressure on it: E / (1 - nu^2) in plane strain, E in plane stress.
double contact_modulus(const ElasticLaw& law);

/// E* of two bodies pressed together, 1 / E* = sum of 1 / contact_modulus (Johnson 1985, section 4.2).
double contact_modulus(const ElasticLaw& first, const ElasticLaw& second);

/// sqrt(3/2 s:s), s the deviator of (11, 22, 33, 12).
double von_mises(const Vec4& stress);

/// The stress (11, 22, 33, 12) in axes that are turned counter-clockwise by an angle, radians.
Vec4 in_turned_axes(const Vec4& stress, double angle);

/// The smallest and the largest of the three principal stresses of (11, 22, 33, 12), tension positive.
struct PrincipalStresses {
  double smallest, largest;
};
PrincipalStresses principal_stresses(const Vec4& stress);

}  // namespace mortise
