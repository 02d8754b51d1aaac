// A folder of results that appears whole or not at all.
#pragma once

#include <filesystem>
#include <string>

namespace mortise {

/// Files are written into a hidden folder beside the target; commit() puts it in the target's place in one atomic
/// step (renameat2 with RENAME_EXCHANGE where the target exists). Killed before that, the old results stand.
/// Files in the old folder that mortise did not write are carried over, never deleted.
class OutputFolder {
 public:
  /// Throws InputError if the folder cannot be made or `target` is a file.
  explicit OutputFolder(std::filesystem::path target);
  /// Removes what was not committed.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where to write the file `name` before commit().
  std::filesystem::path path(const std::string& name) const;
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path staging_;
};

}  // namespace mortise
