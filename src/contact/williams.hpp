// Exponents of the stress at the tip of one wedge, and of two wedges that touch without friction: u ~ r^lambda,
// stress ~ r^(lambda - 1). docs/theory.md section 8, eq. (42) to (44).
//
// M. L. Williams (1952), one wedge; J. Dundurs, M. S. Lee (1972), a wedge on a half-plane.
#pragma once

#include <complex>
#include <map>
#include <mutex>
#include <numbers>
#include <span>
#include <tuple>
#include <vector>

#include "fem/material.hpp"

namespace mortise {

constexpr double straight = std::numbers::pi;  // the angle of a boundary without a corner

/// The condition on a straight face of a wedge: nothing, u = 0, the face as a line of symmetry (u_theta = sigma_rtheta
/// = 0), or of antisymmetry (u_r = sigma_thetatheta = 0).
enum class Face { free, clamped, symmetric, antisymmetric };

struct Wedge {
  double angle;    ///< interior, radians, 0 ... 2 pi
  double shear;    ///< shear modulus mu, stress
  double kolosov;  ///< 3 - 4 nu in plane strain, (3 - nu) / (1 + nu) in plane stress
  Face outer = Face::free;

  double compliance() const { return (kolosov + 1) / shear; }  ///< 8 / E'
};

Wedge wedge(double angle, const ElasticLaw& law, Face outer = Face::free);

/// Exponents of real part below this make a stress without limit; above, a regular one counts as exact.
inline constexpr double regular_exponent = 0.999;

/// Exponents lambda of the smallest real part in (0, regular_exponent), imaginary part in [0, 1]; 1 where there is
/// none. Rigid motions are none of them.
struct TipExponents {
  std::complex<double> stress = 1;    ///< of all modes
  std::complex<double> pressure = 1;  ///< of those whose sigma_thetatheta on the contact face is not zero
  /// Where both are 1, the exponent of the pressure between regular_exponent's like above 1 and falling_limit, of the
  /// end of a contact line: p falls as r^(falling - 1) to zero. 1 where there is none.
  double falling = 1;
};

/// Falling faster than as the root of r, p at an end is seen by the mesh: slopes of p show it.
inline constexpr double falling_limit = 1.5;

/// One wedge, by its outer face and its other one. Accurate to 1e-10, or to 1e-7 where two exponents coincide.
std::complex<double> wedge_exponent(const Wedge& wedge, Face other);

/// Wedges that are bonded one to the next, counter-clockwise, by the first face of the first and the last face of the
/// last; their own `outer` is not used. And such that go all around a point, the last one bonded to the first.
std::complex<double> bonded_exponent(std::span<const Wedge> wedges, Face first, Face last);
std::complex<double> bonded_exponent_inside(std::span<const Wedge> wedges);

/// Two wedges that share one face: the end of a contact line, or a corner on another body.
TipExponents end_exponents(const Wedge& a, const Wedge& b);

/// Two wedges that share both faces, a kink of the contact line: angles of sum 2 pi, outer faces not used. They have
/// one bisector: modes symmetric about it, antisymmetric ones (the bodies slide across the kink), or the smaller of
/// both.
TipExponents kink_exponents(const Wedge& a, const Wedge& b, Face bisector);
TipExponents kink_exponents(const Wedge& a, const Wedge& b);

/// The same for many tips, most of them alike: computed once for all whose angles are one to 1e-10. Any thread may ask.
class TipTable {
 public:
  TipExponents ends(const Wedge& a, const Wedge& b);
  TipExponents kinks(const Wedge& a, const Wedge& b);
  /// Real parts of bonded_exponent, of one wedge wedge_exponent.
  double corner(const std::vector<Wedge>& wedges, Face first, Face last);
  double inside(const std::vector<Wedge>& wedges);

 private:
  using Key = std::tuple<bool, double, double, double, Face, double, double, double, Face>;
  TipExponents find(bool kink, Wedge a, Wedge b);

  std::map<Key, TipExponents> known_;
  std::map<std::vector<double>, double> known_corners_;
  template <typename Find>
  double find_corner(const std::vector<Wedge>& wedges, double first, double last, const Find& find);
  std::mutex mutex_;
};

}  // namespace mortise
