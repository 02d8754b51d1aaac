// Runs and load cases as rows of a table.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/run_row.hpp"
#include "results/report.hpp"

namespace mortise {

RunRow row_of(const Results& results, const Json& report);

/// solved, accuracy_not_reached, not_converged or check_failed, as bad input counts.
Status status_of(const RunRow& row);

/// Writes rows by number, each behind its values of the varied keys, atomically. Columns stand in the order in which
/// they first appear; what a run does not have stays empty.
void write_table(const std::filesystem::path& path, const std::vector<std::string>& keys,
                 const std::vector<std::vector<std::string>>& values, const std::map<std::size_t, RunRow>& rows);

}  // namespace mortise
