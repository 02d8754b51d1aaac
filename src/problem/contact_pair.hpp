// The contact pairs of a scene: which curve carries the multipliers, and the coupling.
#pragma once

#include "contact/coupling.hpp"
#include "model/method.hpp"
#include "problem/contact_curves.hpp"
#include "problem/discretisation.hpp"

namespace mortise {

struct ContactPair : ContactInterface {
  ContactSpec spec;
  int first_row = 0;  ///< of its rows, in those of all pairs below one another
};

/// A body more than this many times as stiff as the other does not carry the multipliers by default: where its mesh is
/// the finer one too, the other body hardly feels them (docs/stability.md, inf-sup).
inline constexpr double stiffer_limit = 10;

/// A curve that faces the other on this part of its length or more carries the multipliers by default if the other
/// curve faces it on no more than uncovered_limit: multipliers of the other would face nothing, or stand at the ends of
/// contact with a part of their edges only.
inline constexpr double covered_limit = 0.95, uncovered_limit = 0.9;

/// Edges this many times as long as the other side's carry the multipliers by default if they are straight: on the
/// finer side the pressure would follow their facets (docs/stability.md, mesh ratio).
inline constexpr double facet_limit = 1.5;

/// One a [[contact]] entry. Multipliers lie on the side the scene names, else on the much softer body (stiffer_limit),
/// else, on meshes that [accuracy] makes, on the curve that alone is smooth in direction and curvature, else on that
/// which alone sees no steps (up_to_steps), else on the one that is covered (covered_limit), else on much longer
/// straight edges (facet_limit), else on the side with the shorter edges, the first if equal and on meshes that
/// [accuracy] makes. In domain decomposition, where `dirichlet`
/// says of each body whether it takes the displacement, the default is that body's curve, or the one with the longer
/// edges where both bodies take both.
std::vector<ContactPair> couple_pairs(const Method& method, const Mesh& mesh, const Discretisation& discretisation,
                                      std::vector<ContactCurves> curves, const std::vector<char>& dirichlet = {});

/// Whether both curves are known as they are drawn, not by their meshes alone.
bool is_drawn(const ContactPair& pair);

/// The pair's gap in words for the user: "closed", the one given, or whose gap and with what clearance.
std::string gap_words(const ContactPair& pair);

/// The node of the first multiplier of each row, of all pairs below one another.
std::vector<int> row_nodes(const std::vector<ContactPair>& pairs);

/// Sets the system's rows: those of all pairs below one another.
void set_contact(const std::vector<ContactPair>& pairs, SaddlePointSystem& system);

}  // namespace mortise
