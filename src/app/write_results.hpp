// The files of a run.
#pragma once

#include <filesystem>

#include "app/solve_scene.hpp"

namespace mortise {

/// Writes result.vtu, contact.vtu, contact.csv, contact_centres.csv and summary.json into `folder`, atomically
/// (io/output_folder.hpp); sets results.seconds.write. Throws InputError if the folder cannot be written.
void write_results(const Scene& scene, Results& results, const std::filesystem::path& folder);

/// The summary of a run for the terminal: at most one screen.
std::string terminal_summary(const Scene& scene, const Results& results, const std::filesystem::path& folder);

}  // namespace mortise
