#include "output/output_folder.hpp"

#include <fcntl.h>
#include <linux/fs.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/errors.hpp"

namespace mortise {

namespace fs = std::filesystem;

namespace {

/// All that mortise ever writes. Add a new output here: what is not listed is taken for the user's and carried over.
constexpr std::array<std::string_view, 7> own_files{
    "result.vtu", "contact.vtu", "contact.csv", "contact_centres.csv", "iteration.csv", "probes.csv", "summary.json"};
constexpr std::string_view staging_suffix = ".mortise";

bool is_listed(const std::string& name) {
  return std::find(own_files.begin(), own_files.end(), name) != own_files.end();
}

bool is_own(const fs::path& file) { return is_listed(file.filename().string()) && !fs::is_directory(file); }

/// ".run1.1234.mortise" for the target "run1" and process 1234.
fs::path staging_path(const fs::path& target, pid_t process) {
  std::string name = ".";
  name += target.filename().string() + "." + std::to_string(process);
  return target.parent_path() / name.append(staging_suffix);
}

/// The process that a staging folder (or one put aside) of `target` belongs to.
std::optional<pid_t> process_of(const fs::path& staging, const fs::path& target) {
  const std::string name = staging.filename().string();
  const std::string start = std::string(".").append(target.filename().string()).append(".");
  if (name.rfind(start, 0) != 0) return std::nullopt;
  pid_t process = 0;
  const auto [end, error] = std::from_chars(name.data() + start.size(), name.data() + name.size(), process);
  if (error != std::errc() || process <= 0) return std::nullopt;
  const fs::path plain = staging_path(target, process);
  if (staging != plain && staging != aside_of(plain)) return std::nullopt;
  return process;
}

bool is_running(pid_t process) { return process != getpid() && (kill(process, 0) == 0 || errno != ESRCH); }

/// Moves what is not ours from one folder to the other. False if something had to stay because its name is taken.
bool carry_over(const fs::path& from, const fs::path& to) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(from)) {
    if (!is_own(entry.path())) files.push_back(entry.path());
  }
  bool all = true;
  for (const fs::path& file : files) {
    const fs::path place = to / file.filename();
    if (fs::exists(fs::symlink_status(place))) {
      all = false;
    } else {
      fs::rename(file, place);
    }
  }
  return all;
}

/// Killed while writing, a process leaves its staging folder; killed just after the exchange, the old results in it,
/// with the user's files; killed between the steps of an exchange, the target itself under another name.
void tidy_up(const fs::path& target) {
  std::vector<fs::path> left_over;
  for (const fs::directory_entry& entry : fs::directory_iterator(target.parent_path())) {
    const std::optional<pid_t> process = process_of(entry.path(), target);
    if (process && !is_running(*process)) left_over.push_back(entry.path());
  }
  for (const fs::path& folder : left_over) {
    const bool was_target = !folder.filename().string().ends_with(staging_suffix);
    if (was_target && !fs::exists(target)) {
      fs::rename(folder, target);
    } else if (!fs::exists(target) || carry_over(folder, target)) {
      fs::remove_all(folder);
    }
  }
}

/// Absolute, through symbolic links, so that the folder itself is exchanged and not a link to it.
fs::path resolved(const fs::path& target) {
  fs::path path = fs::weakly_canonical(fs::absolute(target));
  return path.has_filename() ? path : path.parent_path();
}

/// A folder of the name of one of our files: we would neither replace nor carry it over.
void check_no_folders(const fs::path& shown, const fs::path& target) {
  for (const std::string_view name : own_files) {
    if (!fs::is_directory(target / name)) continue;
    throw InputError((shown / name).string() +
                     ": is a folder where a file of results goes; expected it to be moved away");
  }
}

void check_folder(const fs::path& shown, const fs::path& target) {
  if (fs::exists(target) && !fs::is_directory(target)) {
    throw InputError(shown.string() + ": cannot write results here: it is a file, expected a folder");
  }
  const fs::path here = fs::current_path();
  const auto differs = std::mismatch(target.begin(), target.end(), here.begin(), here.end());
  if (differs.first == target.end()) {
    throw InputError(shown.string() + ": cannot write results here: it is or holds the current folder; " +
                     "expected a folder of their own");
  }
  check_no_folders(shown, target);
}

[[noreturn]] void fail(const fs::path& target, const fs::filesystem_error& error) {
  throw InputError(target.string() + ": cannot write results here: " + error.code().message());
}

}  // namespace

fs::path aside_of(const fs::path& a) {
  fs::path aside = a;
  aside += "-old";
  return aside;
}

void exchange_folders_in_steps(const fs::path& a, const fs::path& b, const fs::path& aside) {
  fs::rename(b, aside);
  try {
    fs::rename(a, b);
  } catch (const fs::filesystem_error&) {
    fs::rename(aside, b);
    throw;
  }
  fs::rename(aside, a);
}

void exchange_folders(const fs::path& a, const fs::path& b) {
  if (syscall(SYS_renameat2, AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0) return;
  // NFS and some FUSE file systems know no exchange.
  if (errno == EINVAL || errno == ENOSYS || errno == ENOTSUP) {
    exchange_folders_in_steps(a, b, aside_of(a));
    return;
  }
  throw fs::filesystem_error("cannot exchange", a, b, std::error_code(errno, std::generic_category()));
}

void check_output_folder(const fs::path& target) try {
  check_folder(target, resolved(target));
} catch (const fs::filesystem_error& error) {
  fail(target, error);
}

OutputFolder::OutputFolder(fs::path target) : shown_(target) {
  try {
    target_ = resolved(target);
    check_folder(target, target_);
    fs::create_directories(target_.parent_path());
    tidy_up(target_);
    staging_ = staging_path(target_, getpid());
    if (fs::exists(target_)) {
      fs::create_directory(staging_, target_);  // with the same permissions
    } else {
      fs::create_directory(staging_);
    }
  } catch (const fs::filesystem_error& error) {
    fail(target, error);
  }
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!staging_.empty()) fs::remove_all(staging_, ignored);
}

fs::path OutputFolder::path(const std::string& name) const {
  if (!is_listed(name)) throw std::logic_error(name + ": a new output belongs into own_files");
  return staging_ / name;
}

std::string OutputFolder::with_target(std::string message) const {
  const std::string hidden = staging_.string();
  const std::size_t at = hidden.empty() ? std::string::npos : message.find(hidden);
  return at == std::string::npos ? message : message.replace(at, hidden.size(), shown_.string());
}

void OutputFolder::commit() {
  try {
    if (!fs::exists(target_)) {
      fs::rename(staging_, target_);
      staging_.clear();
      return;
    }
    exchange_folders(staging_, target_);
    const fs::path old = std::exchange(staging_, fs::path());  // from here on it holds the user's files
    if (carry_over(old, target_)) fs::remove_all(old);
  } catch (const fs::filesystem_error& error) {
    fail(target_, error);
  }
}

}  // namespace mortise
