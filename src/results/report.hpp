// The report of a run: one document, from which the terminal's summary (results/report_text), a sweep's row, Python and
// the picture of a set-up are made.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "results/results.hpp"

namespace mortise {

using Json = nlohmann::ordered_json;

/// summary.json, but for the seconds of writing; docs/files.md has its keys. Figures that are not finite are null in
/// the file.
Json report_of(const Results& results);

/// Its "model": plane, materials, supports, loads, ties, fields. With the reactions (times depth, model/model.hpp)
/// where they are known. Of forces what is round-off of their parts is 0.
Json model_report(const Problem& problem, const Reactions* reactions = nullptr);

/// Writes all files of a run into `folder`, without result.vtu if `bodies` is false, and into `report` how long that
/// took. Throws InputError where it cannot.
void write_results(const Results& results, Json& report, const std::filesystem::path& folder, bool bodies = true);

}  // namespace mortise
