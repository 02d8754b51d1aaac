// How wide contact is that a few vertices carry.
#pragma once

#include "error/pressure_estimate.hpp"
#include "problem/problem.hpp"

namespace mortise {

/// Edges from the middle of a contact to its end that tell its width: about what a first mesh has of a known one.
inline constexpr int edges_of_contact = 4;

/// Where round bodies press each other on two edges or less, the mesh knows the force and the curvature kappa of the
/// gap, and so the half width a: a^2 = 4 F / (pi E* kappa) with F by length, or about an axis a^3 = 3 F / (4 E* kappa)
/// (Johnson 1985, eq. 4.43 and 4.22). Sets LineError::narrow_at, in the middle and at both ends on both sides. `list`:
/// one a pair, with its line.
void add_narrow_contact(const Problem& problem, const VecX& u, std::vector<PressureEstimate>& list);

}  // namespace mortise
