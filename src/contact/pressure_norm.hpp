// The norm in which multipliers are measured: h-weighted, a discrete stand-in for H^-1/2 of the contact curve.
#pragma once

#include "contact/coupling.hpp"

namespace mortise {

/// m x m, length^2: sum over the edges of the multiplier side of h int psi_a psi_b ds, h the edge's length, on the rows
/// of the coupling (docs/theory.md eq. 40; Wohlmuth 2000, section 2). `space` as in couple().
SparseMatrix pressure_norm(const Points& nodes, const ContactInterface& interface, Multipliers space);

}  // namespace mortise
