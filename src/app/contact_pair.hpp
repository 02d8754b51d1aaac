// The contact pairs of a scene: which curve carries the multipliers, and the coupling.
#pragma once

#include "app/discretisation.hpp"
#include "contact/coupling.hpp"

namespace mortise {

struct ContactPair {
  ContactSpec spec;
  Curve multiplier, opposite;
  std::vector<ContactPoint> points;
  Coupling coupling;
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
/// else on the one that is covered (covered_limit), else on much longer straight edges (facet_limit), else on the side
/// with the shorter edges (the first if equal). Throws InputError for unknown curves, curves that are no chains, and
/// curves with common nodes. In domain decomposition, where `dirichlet` says of each body whether it takes the
/// displacement, the default is that body's curve, or the one with the longer edges where both bodies take both.
std::vector<ContactPair> couple_pairs(const Scene& scene, const Mesh& mesh, const Discretisation& discretisation,
                                      const std::vector<char>& dirichlet = {});

/// The rows of all pairs below one another.
struct StackedCoupling {
  SparseMatrix B;
  VecX gap0, scale;
  std::vector<int> first_row;  ///< of each pair, and the total at the end
};

/// Of the stacked rows: the node of each one's first multiplier; and whether it may open.
std::vector<int> row_nodes(const std::vector<ContactPair>& pairs);
std::vector<char> unilateral_rows(const std::vector<ContactPair>& pairs);

StackedCoupling stack(const std::vector<ContactPair>& pairs, Eigen::Index unknowns);

}  // namespace mortise
