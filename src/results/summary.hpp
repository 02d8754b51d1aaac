// summary.json and the terminal's summary: the same facts, once for programs and once for people.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "results/results.hpp"

namespace mortise {

/// The keys of summary.json (docs/files.md). Figures that are not finite become null. `write_seconds`: what writing the
/// other files took.
nlohmann::ordered_json summary_json(const Results& results, double write_seconds);

/// The summary of a run for the terminal: at most one screen, the verdict below the title.
std::string terminal_summary(const Results& results, const std::filesystem::path& folder);

}  // namespace mortise
