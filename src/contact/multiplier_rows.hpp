// Which multipliers are unknowns of their own.
#pragma once

#include "contact/contact_interface.hpp"
#include "fem/constraints.hpp"
#include "mesh/curve.hpp"
#include "model/choices.hpp"

namespace mortise {

/// Sums over the contact points for each multiplier.
struct Support {
  /// int |N| ds, length, with N the Lagrange function of the multiplier's node: dual psi may vanish where N does not.
  VecX extent;
  VecX scale, weight;  ///< int |psi| dA, int psi dA, which for dual psi is int N dA
  VecX lagrange;       ///< int |N| dA
  VecX faced;          ///< how much of its edges faces the other side, length
};

/// The multipliers along the curve: start, middle, end of each edge.
std::vector<int> multipliers_along(const Coupling& coupling);

/// Part of a multiplier's edges that must face the other side. Of less, what little gap there is weighs against the
/// whole psi: p at the node would be extrapolated by about 1 / part.
inline constexpr double faced_limit = 0.1;

/// Whether the ends of a curve are one place of neighbouring sectors (Tie::turn).
bool closes_in_the_next_sector(const Mesh& mesh, const Curve& curve);

/// What rows are numbered for.
struct Numbering {
  const Mesh& mesh;
  const ContactInterface& interface;
  const Constraints& constraints;
  InitialGap initial_gap;
};

/// Fills coupling.row, coupling.dropped and the sizes of gap0 and scale. Multipliers without support have no row. Those
/// of nodes where both sides' normal displacements are prescribed, those whose weighted gap says nothing of the gap's
/// sign, and those whose edges hardly face the other side share the row of the nearest free one along the curve (so
/// that constants stay in the space: Wohlmuth 2000, the end edges of a mortar). Where the prescribed displacements
/// leave the sides apart, the pressure is zero. The ends of a sector's curve that goes on in the next one share a row.
/// Throws InputError where they overlap, and where no multiplier is free.
void number_rows(const Numbering& of, const Support& support, Coupling& coupling);

}  // namespace mortise
