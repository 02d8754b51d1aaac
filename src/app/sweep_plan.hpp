// The runs of a sweep, their groups and parts.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/overrides.hpp"

namespace mortise {

/// `--vary KEY=V1,V2,...`
struct Variation {
  std::string key;
  std::vector<std::string> values;
};

/// Throws InputError if there is no '=' or no value.
Variation parse_variation(const std::string& text);

/// All runs of a sweep: every combination of the values, the last variation fastest.
struct SweepPlan {
  std::string scene;
  std::vector<Override> overrides;  ///< of every run
  std::vector<std::string> keys;
  std::vector<std::vector<std::string>> values;  ///< of the keys, by run
  bool diagnosed = false;                        ///< with the inf-sup constant (diagnose)

  /// Those of a run.
  std::vector<Override> overrides_of(std::size_t run) const;
};
SweepPlan plan_sweep(const std::string& scene, const std::vector<Override>& overrides,
                     const std::vector<Variation>& variations, bool diagnosed);

/// So many parts of a sweep, of which one is run: `part` from 1 to `of`.
struct SweepPart {
  std::size_t part = 1;
  std::size_t of = 1;
};

/// `--part K/N`. Throws InputError unless 1 <= K <= N <= 10000.
SweepPart parse_part(const std::string& text);

/// FILE.csv, or FILE.2_of_8.csv of the second of eight parts.
std::filesystem::path table_of(const std::filesystem::path& csv, const SweepPart& part);

/// Numbers from the first to before the second.
using Range = std::array<std::size_t, 2>;

/// Runs go in groups of four, whole ones to each part.
Range groups_of(const SweepPlan& plan, const SweepPart& part);
Range runs_of_group(const SweepPlan& plan, std::size_t group);
std::size_t group_of(std::size_t run);
Range runs_of(const SweepPlan& plan, const SweepPart& part);

/// Whether a file with that header is a table of ours.
bool is_sweep_table(const std::string& header);

}  // namespace mortise
