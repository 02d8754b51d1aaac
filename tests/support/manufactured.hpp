// An exact plane-strain field, and two plates in contact that it solves.
#pragma once

#include "fem/constraints.hpp"
#include "model/choices.hpp"
#include "support/two_plates.hpp"

namespace mortise::test {

/// A field without body force from the Kolosov-Muskhelishvili potentials phi = c2 z^2 + c3 z^3 + c4 z^4 and
/// psi = d1 z + d2 z^2 + d3 z^3: 2 mu (u1 + i u2) = kappa phi - z conj(phi') - conj(psi).
struct ExactField {
  double young = 1, poisson = 0.3;
  Vec2 displacement(const Vec2& x) const;
  Vec4 stress(const Vec2& x) const;
};

/// Prescribes the exact displacements on a boundary, both components.
void prescribe_exactly(const Mesh& mesh, const ExactField& exact, const std::string& name, Constraints& constraints);

/// The exact tractions on the vertical sides of two plates, and the tangential ones on both contact curves.
VecX exact_loads(const Mesh& mesh, const ExactField& exact);

/// Slip along the contact line y = h(x): the upper body moves by s(x) (1, h'(x)) more than the lower one, with
/// s = s0 + s1 x, so that normal displacements stay equal.
struct Slip {
  double s0, s1;
  std::function<std::array<double, 3>(double)> derivatives;  ///< h', h'', h'''

  Vec2 displacement(const Vec2& x) const;
  Vec4 stress(const Vec2& x, double young, double poisson) const;
  Vec2 body_force(const Vec2& x, double young, double poisson) const;
};

struct ManufacturedCase {
  TwoPlates plates;
  Multipliers multipliers = Multipliers::quadratic;
  Integration integration = Integration::segments;
  bool multipliers_on_lower = true;
  Normals normals = Normals::edges;
  std::optional<Slip> slip = {};
};

/// Errors against the exact field, absolute: ||u||_L2, energy norm, ||p||_L2 along the multiplier side; and what patch
/// recovery estimates of the second.
struct Errors {
  double displacement, energy, pressure;
  double energy_estimate = 0;
};

/// Solves with exact displacements on top and bottom, exact tractions on the vertical sides, and the exact tangential
/// tractions on both contact curves; the normal ones are left to the contact.
Errors manufactured_errors(const ManufacturedCase& which);

}  // namespace mortise::test
