// How well a solved scene's meshes control its pressures, beside the checks of every run.
#pragma once

#include "results/results.hpp"

namespace mortise {

/// The inf-sup constant of the closed rows; nothing where there are none. Costs another factorisation and the
/// eigenvalues of a dense matrix of the multipliers' size.
std::optional<InfSupReport> inf_sup_report(const Results& results);

/// Below this the pressures are not to be trusted: docs/stability.md shows what happens there.
inline constexpr double inf_sup_limit = 0.1;

/// A line where it is below the limit, else nothing.
std::optional<std::string> inf_sup_warning(const InfSupReport& report);

}  // namespace mortise
