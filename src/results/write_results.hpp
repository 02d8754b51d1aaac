// The files of a run.
#pragma once

#include <filesystem>

#include "results/results.hpp"

namespace mortise {

/// Writes result.vtu, contact.vtu, contact.csv, contact_centres.csv, iteration.csv, probes.csv and summary.json into
/// `folder`, atomically (output/output_folder.hpp); what a run does not have is left out, and the .vtu files where VTK
/// cannot be loaded, of which a warning tells. Throws InputError if the folder cannot be written.
void write_results(const Results& results, const std::filesystem::path& folder);

}  // namespace mortise
