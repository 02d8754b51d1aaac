// Displacements and stresses that go as a power of the distance from the tip of a wedge, by potentials.
#pragma once

#include "contact/williams.hpp"

namespace mortise::test {

/// Of the four coefficients of a wedge's potentials at an angle and r = 1.
struct WedgeFields {
  Eigen::RowVector4d normal, shear, ur, ut;  // sigma_thetatheta, sigma_rtheta, u
};

/// Kolosov's potentials phi = a z^lambda, psi = b z^lambda of (Re a, Im a, Re b, Im b), real lambda. Of a body with
/// directions, whose angles are those from x_1, Lekhnitskii's functions A z^lambda, z = cos theta + mu sin theta, of
/// (Re A, Im A) for each root of s11 mu^4 - 2 s16 mu^3 + (2 s12 + s66) mu^2 - 2 s26 mu + s22 = 0.
WedgeFields fields(const Wedge& w, double lambda, double theta);

/// Of an isotropic one; in the plane eps_11 = (kappa + 1) / 8 mu sigma_11.
double shear(const Wedge& w);
double kolosov(const Wedge& w);

}  // namespace mortise::test
