// The cases of a scene, one after another.
#pragma once

#include <filesystem>
#include <functional>
#include <map>

#include "app/run_row.hpp"
#include "app/solve_scene.hpp"

namespace mortise {

struct CaseOptions {
  bool estimated = true, diagnosed = false;
};

/// What all cases say: a row a case, in their order.
struct CaseTable {
  std::vector<std::string> keys;                 ///< "case", "scale" where there is one, the keys that cases change
  std::vector<std::vector<std::string>> values;  ///< of the keys, by case; empty: as in the scene
  std::map<std::size_t, RunRow> rows;
  std::vector<std::vector<std::string>> warnings;  ///< by case
  int shared = 0;                                  ///< cases that had the factor of one before
  double seconds = 0;

  Status worst() const;
};

/// Called with the results of each case, which may be taken. Of an accuracy the last call for a case counts: a mesh
/// that turns out not to be good enough for all is followed by another.
using TakeCase = std::function<void(const LoadCase& load, Results& results)>;

/// Solves, checks and estimates each case, as CaseSolver does: from the closed rows of the one before. One that has no
/// solution gets a row that says so. Throws InputError where the scene, or a case, asks for an accuracy.
CaseTable solve_cases(const Scene& scene, const CaseOptions& options, const Progress& progress,
                      const TakeCase& take = {});

/// The scene of one case. Throws InputError if there is none of that name.
Scene case_of(const Scene& scene, const std::string& name);

/// The same into a folder: cases.csv, what scene.case_files says of each case, and summary.json.
CaseTable write_cases(const Scene& scene, const CaseOptions& options, const Progress& progress,
                      const std::filesystem::path& folder);

/// What the terminal says of them, at most one screen.
std::string cases_text(const std::string& title, const CaseTable& table, const std::filesystem::path& folder);

}  // namespace mortise
