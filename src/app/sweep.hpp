// Many runs of one scene, a row of a table each.
#pragma once

#include <filesystem>
#include <functional>

#include "app/solve_scene.hpp"

namespace mortise {

/// `--vary KEY=V1,V2,...`
struct Variation {
  std::string key;
  std::vector<std::string> values;
};

/// Throws InputError if there is no '=' or no value.
Variation parse_variation(const std::string& text);

/// Runs every combination (the last variation fastest) and writes one CSV row a run after each, atomically. Throws
/// InputError if `csv` is a file of the scene's, or one that is there and no such table.
/// A run on the same mesh as the one before starts from its active set.
/// `diagnosed`: with the inf-sup constant (diagnose). A run that is bad input gets a row that says so; `report` is
/// called after each run. Returns the worst status of all runs (bad input counts as check_failed).
Status sweep(const std::string& scene_path, const std::vector<Override>& overrides,
             const std::vector<Variation>& variations, const std::filesystem::path& csv, bool diagnosed,
             const std::function<void(const std::string& line)>& report);

}  // namespace mortise
