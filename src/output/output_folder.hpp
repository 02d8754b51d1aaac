// A folder of results, whole where summary.json is.
#pragma once

#include <filesystem>
#include <list>
#include <optional>
#include <set>
#include <string>

#include "base/staged_file.hpp"

namespace mortise {

/// Throws InputError if results cannot be put there, as far as is known before they are written: `target` is a file, or
/// a folder that may not be written to, or holds a file or folder of the name of one of ours that no run of ours has
/// written.
void check_output_folder(const std::filesystem::path& target);

/// The folder within one of results that has a folder of results for each case.
constexpr const char* case_folder = "cases";

/// Files are written under hidden names in the folder; commit() removes the old summary.json, puts them in their places
/// and the new summary.json last: a folder that has one is the whole of one run, whenever a process was killed. The
/// folder itself stays as it is (owner, modes, the user's files). What mortise writes is listed in output_folder.cpp.
class OutputFolder {
 public:
  /// Makes the folder if there is none. Throws InputError as check_output_folder does, or if it cannot be made.
  explicit OutputFolder(std::filesystem::path target);

  /// Where to write the file `name`, one of those listed, before commit(). Throws InputError if it cannot be made.
  std::filesystem::path path(const std::string& name);
  /// A message with the file's name in the target, as it was given, for its hidden one.
  std::string with_target(std::string message) const;
  /// Once, after all files are written and closed. Removes files of ours that this run does not have, and of a run with
  /// cases (in either run) the results of those that are not among `cases`. Throws InputError if the file system
  /// refuses.
  void commit(const std::optional<std::set<std::string>>& cases = {});

 private:
  struct File {
    explicit File(const std::filesystem::path& at) : place(at), staged(at) {}
    std::filesystem::path place;
    StagedFile staged;
  };

  std::filesystem::path target_;
  std::list<File> files_;  // a StagedFile does not move
};

}  // namespace mortise
