// The tables of a sweep's parts, put together.
#pragma once

#include "app/sweep_plan.hpp"
#include "results/results.hpp"

namespace mortise {

/// Puts the tables of so many parts together: the table of the whole. Returns the worst status. Throws InputError that
/// names the part that is missing, not complete or of another sweep.
Status join_sweep(const SweepPlan& plan, const std::filesystem::path& csv, std::size_t parts);

}  // namespace mortise
