#include "fem/material.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "model/moduli.hpp"

namespace mortise {
namespace {

// Tensor shear strain to gamma_12.
Vec4 engineering(Vec4 strain) {
  strain(3) *= 2;
  return strain;
}

const std::array in_plane{0, 1, 3};

}  // namespace

Vec4 ElasticLaw::stress0(const Vec2& x) const {
  return initial_strain ? Vec4(-(stiffness * engineering(initial_strain(x)))) : Vec4(Vec4::Zero());
}

double ElasticLaw::energy0(const Vec2& x) const {
  if (!initial_strain) return 0;
  const Vec4 strain = engineering(initial_strain(x));
  return 0.5 * strain.dot(stiffness * strain);
}

bool ElasticLaw::is_isotropic_in_plane() const {
  constexpr double alike = 1e-6;
  const Mat4& C = stiffness;
  const double most = std::max(
      {std::abs(C(0, 0) - C(1, 1)), std::abs(C(0, 3)), std::abs(C(1, 3)), std::abs((C(0, 0) - C(0, 1)) / 2 - C(3, 3))});
  return most <= alike * C(0, 0);
}

ElasticLaw elastic_law(double young, double poisson, const Model& model, StrainField initial_strain) {
  assert(young > 0 && poisson > -1 && poisson < 0.5);
  const double mu = young / (2 * (1 + poisson));
  // sigma_33 = 0 turns lambda into 2 mu lambda / (lambda + 2 mu).
  const double lame = model.plane == Plane::stress ? young * poisson / (1 - poisson * poisson)
                                                   : young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  Mat4 stiffness;
  stiffness << lame + 2 * mu, lame, lame, 0,  //
      lame, lame + 2 * mu, lame, 0,           //
      lame, lame, lame + 2 * mu, 0,           //
      0, 0, 0, mu;
  if (model.plane == Plane::stress) {
    stiffness.row(2).setZero();
    stiffness.col(2).setZero();
  }
  return elastic_law(stiffness, model, young, std::move(initial_strain));
}

ElasticLaw elastic_law(const Mat4& stiffness, const Model& model, double young, StrainField initial_strain) {
  ElasticLaw law{.model = model,
                 .stiffness = stiffness,
                 .compliance = Mat4::Zero(),
                 .out_of_plane = Eigen::RowVector3d::Zero(),
                 .young = young,
                 .initial_strain = std::move(initial_strain)};
  const Eigen::Matrix3d of_plane = inverse(Eigen::Matrix3d(stiffness(in_plane, in_plane)));
  law.out_of_plane = stiffness(2, in_plane) * of_plane;
  if (model.plane == Plane::stress) {
    law.compliance(in_plane, in_plane) = of_plane;
  } else {
    law.compliance = inverse(stiffness);
  }
  return law;
}

Mat4 without_33(Mat4 stiffness) {
  stiffness -= Mat4(stiffness.col(2) * stiffness.row(2) / stiffness(2, 2));
  stiffness.row(2).setZero();
  stiffness.col(2).setZero();
  return stiffness;
}

double contact_modulus(const ElasticLaw& law) {
  const Mat4& C = law.stiffness;
  return std::min(C(0, 0), C(1, 1)) - C(0, 1) * (C(0, 1) / std::max(C(0, 0), C(1, 1)));
}

double contact_modulus(const ElasticLaw& first, const ElasticLaw& second) {
  return 1 / (1 / contact_modulus(first) + 1 / contact_modulus(second));
}

double von_mises(const Vec4& s) {
  const double a = s(0) - s(1), b = s(1) - s(2), c = s(2) - s(0);
  return std::sqrt((a * a + b * b + c * c) / 2 + 3 * s(3) * s(3));
}

Vec4 in_turned_axes(const Vec4& s, double angle) {
  const double mean = (s(0) + s(1)) / 2, half = (s(0) - s(1)) / 2, c = std::cos(2 * angle), d = std::sin(2 * angle);
  const double turned = c * half + d * s(3);
  return {mean + turned, mean - turned, s(2), c * s(3) - d * half};
}

PrincipalStresses principal_stresses(const Vec4& s) {
  const double mean = (s(0) + s(1)) / 2, radius = std::hypot((s(0) - s(1)) / 2, s(3));
  return {std::min(mean - radius, s(2)), std::max(mean + radius, s(2))};
}

}  // namespace mortise
