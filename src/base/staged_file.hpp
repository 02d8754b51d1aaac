// A file that appears whole or not at all, and never in the place of somebody else's.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace mortise {

/// Whether a file that begins like this is of our own making.
using IsOurs = std::function<bool(const std::string& first_line)>;

/// Throws InputError unless `target` may be written: it is not there yet, or empty, or `ours`, and it is none of the
/// `inputs` (under whatever name), a folder or a device.
void check_target(const std::filesystem::path& target, const std::vector<std::filesystem::path>& inputs,
                  const IsOurs& ours);

/// Written under a hidden name beside the target, then put in its place in one step.
class StagedFile {
 public:
  /// Makes the hidden file, which has the ending of `target`, and removes those that processes left beside it which
  /// were killed as they wrote `target`. Throws InputError if it cannot.
  explicit StagedFile(const std::filesystem::path& target);
  /// Removes what was not committed.
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  /// The path to write to before commit().
  const std::filesystem::path& path() const { return staging_; }
  /// Once, when the file is written and closed. `on_disk`: waits until the disk has it, so that a full one is noticed
  /// here. Throws InputError.
  void commit(bool on_disk = true);

 private:
  [[noreturn]] void fail(int error) const;

  std::filesystem::path shown_;    // the target as the user named it
  std::filesystem::path target_;   // through symbolic links
  std::filesystem::path staging_;  // empty after commit()
};

}  // namespace mortise
