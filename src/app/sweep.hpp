// Many runs of one scene, a row of a table each.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "app/run_row.hpp"
#include "app/solve_scene.hpp"
#include "app/sweep_plan.hpp"

namespace mortise {

/// One run: solved, to its accuracy where it asks for one, estimated and judged. Bad input is a row that says so.
RunRow solve_run(const std::string& path, const std::vector<Override>& overrides, bool diagnosed, CaseSolver& solver,
                 const Progress& progress = {});

/// Called after each run.
using SweepReport = std::function<void(const std::string& line)>;

/// Runs a part in `jobs` processes and writes its table, one row a run in the order of the runs, after each; with more
/// than one job, before anything else has started threads. Runs go in fours: within one, a run on the same mesh as the
/// one before starts from its active set; so a row does not hang on jobs and parts. Complete fours are kept beside the
/// table until it is complete: the same sweep, killed and started again, takes them from there. A run that is bad input
/// gets a row that says so. Returns the worst status of the part's runs (bad input counts as check_failed). Throws
/// InputError if the table is a file of the scene's, or one that is there and no such table; if a process ends.
Status sweep(const SweepPlan& plan, const std::filesystem::path& csv, const SweepPart& part, int jobs,
             const SweepReport& report);

}  // namespace mortise
