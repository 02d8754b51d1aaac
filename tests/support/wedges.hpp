// Exponents of the fans that tests ask for.
#pragma once

#include "contact/williams.hpp"

namespace mortise::test {

inline TipExponents end_exponents(const Wedge& a, const Wedge& b) { return exponents(end_fan(a, b), 0); }

inline TipExponents kink_exponents(const Wedge& a, const Wedge& b) { return exponents(kink_fan(a, b), 0); }

/// Of the modes that are symmetric about the bisector, or antisymmetric.
inline TipExponents kink_exponents(Wedge a, Wedge b, Face bisector) {
  for (Wedge* w : {&a, &b}) {
    w->angle /= 2;
    w->outer = bisector;
  }
  return end_exponents(a, b);
}

inline std::complex<double> wedge_exponent(const Wedge& wedge, Face other) {
  return exponents({{wedge}, {}, other, wedge.outer}).stress;
}

inline std::complex<double> bonded_exponent(const std::vector<Wedge>& wedges, Face first, Face last) {
  return exponents({wedges, std::vector<Joint>(wedges.size() - 1, Joint::bonded), first, last}).stress;
}

inline std::complex<double> bonded_exponent_inside(const std::vector<Wedge>& wedges) {
  return exponents({wedges, std::vector<Joint>(wedges.size(), Joint::bonded)}).stress;
}

}  // namespace mortise::test
