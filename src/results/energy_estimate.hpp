// How far the stresses are from those that the problem has, estimated from the solution itself.
#pragma once

#include "results/results.hpp"

namespace mortise {

/// Stress recovered by patches against the elements' own (fem/patch_recovery.hpp), in the energy norm.
/// It does not see where contact ends within an edge, nor what a load does within an element.
EnergyEstimate estimate_energy_error(const Results& results);

/// Estimates above this part are told with their place.
inline constexpr double energy_error_limit = 0.2;

/// The warning where the estimate is above energy_error_limit.
std::optional<std::string> energy_error_warning(const Mesh& mesh, const EnergyEstimate& estimate);

}  // namespace mortise
