// Exponents of the stress where wedges meet at a point, each bonded to the next or touching it without friction:
// u ~ r^lambda, stress ~ r^(lambda - 1). docs/theory.md section 8, eq. (42) to (44).
//
// M. L. Williams (1952), one wedge; J. Dundurs, M. S. Lee (1972), a wedge on a half-plane; A. N. Stroh (1958), bodies
// that are not alike in all directions.
#pragma once

#include <complex>
#include <numbers>
#include <optional>
#include <vector>

#include "fem/material.hpp"

namespace mortise {

constexpr double straight = std::numbers::pi;  // the angle of a boundary without a corner

/// The condition on a straight face of a wedge: nothing, u = 0, the face as a line of symmetry (u_theta = sigma_rtheta
/// = 0), or of antisymmetry (u_r = sigma_thetatheta = 0).
enum class Face { free, clamped, symmetric, antisymmetric };

struct Wedge {
  double angle = 0;  ///< interior, radians, 0 ... 2 pi
  /// Strains (11, 22, gamma_12) of the stresses (11, 22, 12) in the plane, 1 / stress.
  Eigen::Matrix3d compliance = Eigen::Matrix3d::Zero();
  double modulus = 0;  ///< contact_modulus, stress
  Face outer = Face::free;
  /// Direction of its first face, counter-clockwise from x_1, radians; none of an isotropic body.
  std::optional<double> first = {};

  bool is_alike(const Wedge& other) const { return compliance == other.compliance; }
  bool goes_on_in(const Wedge& next) const;  ///< both are one material, alike as it lies
  void round(double to);                     ///< both angles, to multiples of this
};

/// Of a law that is not isotropic with the direction of its first face.
Wedge wedge(double angle, const ElasticLaw& law, Face outer = Face::free, double first = 0);

/// What a wedge's last face and the next one's first have in common: all, or u_theta and sigma_thetatheta without
/// sigma_rtheta.
enum class Joint { bonded, sliding };

/// Wedges around a point, counter-clockwise. Of as many joints as wedges the last one closes the fan; of one less, its
/// outer faces are held as `first` and `last` say. The wedges' own `outer` is not used.
struct Fan {
  std::vector<Wedge> wedges;
  std::vector<Joint> joints;  ///< of each wedge with the next
  Face first = Face::free, last = Face::free;
};

/// Exponents of real part below this make a stress without limit; above, a regular one counts as exact.
inline constexpr double regular_exponent = 0.999;

/// Exponents lambda of the smallest real part in (0, regular_exponent), imaginary part in [0, 1]; 1 where there is
/// none. Rigid motions are none of them.
struct TipExponents {
  std::complex<double> stress = 1;    ///< of all modes
  std::complex<double> pressure = 1;  ///< of those whose sigma_thetatheta is not zero on the joint that was asked for
  /// Where both are 1, the exponent of the pressure between regular_exponent's like above 1 and falling_limit, of the
  /// end of a contact line: p falls as r^(falling - 1) to zero. 1 where there is none.
  double falling = 1;
};

/// Falling faster than as the root of r, p at an end is seen by the mesh: slopes of p show it.
inline constexpr double falling_limit = 1.5;

/// Accurate to 1e-10, or to 1e-7 where two exponents coincide. `joint`: the sliding one whose pressure is asked for; no
/// sliding joint: `stress` alone.
TipExponents exponents(const Fan& fan, std::optional<std::size_t> joint = {});

/// A mode u ~ r^exponent of a fan, up to a factor.
struct TipMode {
  std::complex<double> exponent;
  std::vector<double> pressure;  ///< -sigma_thetatheta on each sliding joint; 0 where it is round-off
  double first = 0, last = 0;    ///< u_theta of the outer faces, those of a fan that is not closed
  bool has_signs = false;        ///< it is the only one of a real exponent
};

/// Those of the exponents of real part in (0, regular_exponent), the smallest first.
std::vector<TipMode> modes(const Fan& fan);

/// Two wedges of which the first one's last face is the second one's first: the end of a contact line, or a corner on
/// another body.
Fan end_fan(const Wedge& a, const Wedge& b);

/// Two wedges that share both faces, a kink of the contact line: angles of sum 2 pi.
Fan kink_fan(const Wedge& a, const Wedge& b);

}  // namespace mortise
