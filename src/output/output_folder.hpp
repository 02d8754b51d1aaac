// A folder of results that appears whole or not at all.
#pragma once

#include <filesystem>
#include <string>

namespace mortise {

/// Two folders change places, in one atomic step where the file system can; else in three. Throws
/// std::filesystem::filesystem_error.
void exchange_folders(const std::filesystem::path& a, const std::filesystem::path& b);

/// By way of `aside`, a third name in the same folder, which must be free. Killed half-way, `b` is found at `aside`.
void exchange_folders_in_steps(const std::filesystem::path& a, const std::filesystem::path& b,
                               const std::filesystem::path& aside);

/// The name that exchange_folders moves `b` to when it needs one.
std::filesystem::path aside_of(const std::filesystem::path& a);

/// Throws InputError where results cannot be put, as far as can be told before they are written: `target` is a file, or
/// holds the current folder, or a folder with the name of one of our files.
void check_output_folder(const std::filesystem::path& target);

/// Files are written into a hidden folder beside the target; commit() puts it in the target's place in one atomic
/// step (renameat2 with RENAME_EXCHANGE where the target exists). Killed before that, the old results stand.
/// Files in the old folder that mortise did not write are carried over, never deleted. What mortise writes is listed
/// in output_folder.cpp.
class OutputFolder {
 public:
  /// Makes the hidden folder, and the target's parents; tidies up after processes that died while writing here.
  /// Throws InputError if the folder cannot be made, `target` is a file, a folder in it has the name of a file of ours,
  /// or the work goes on inside `target` (the current folder would be exchanged under our feet).
  explicit OutputFolder(std::filesystem::path target);
  /// Removes what was not committed.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where to write the file `name`, one of those listed, before commit().
  std::filesystem::path path(const std::string& name) const;
  /// A message with the target's name, as it was given, for the hidden folder's.
  std::string with_target(std::string message) const;
  /// Once, after all files are written and closed. Throws InputError if the file system refuses.
  void commit();

 private:
  std::filesystem::path shown_;  ///< the target as it was given
  std::filesystem::path target_;
  std::filesystem::path staging_;  ///< empty after commit()
};

}  // namespace mortise
