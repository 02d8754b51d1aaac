#include "output/output_folder.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "base/errors.hpp"

namespace mortise {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view summary = "summary.json";

/// All that mortise ever writes. Add a new output here: what is not listed is the user's and stays.
constexpr std::array<std::string_view, 9> own_files{"result.vtu",          "contact.vtu",   "contact.csv",
                                                    "contact_centres.csv", "iteration.csv", "probes.csv",
                                                    "cases.csv",           "cases.pvd",     summary};

[[noreturn]] void fail(const fs::path& target, const std::string& why) {
  throw InputError(target.string() + ": cannot write results here: " + why);
}

/// Whether a run of ours has written here: its summary, or the hidden one of a run that was killed as it put its files
/// in their places.
bool holds_results(const fs::path& target) {
  std::string start(16 * 1024, '\0');
  std::ifstream(target / summary).read(start.data(), std::ssize(start));
  if (start.find("\"dense_kernel\"") != std::string::npos) return true;
  return std::ranges::any_of(fs::directory_iterator(target), [](const fs::directory_entry& entry) {
    const std::string name = entry.path().filename().string();
    return name.starts_with(".summary.") && name.ends_with(".mortise.json");
  });
}

/// Files in a folder with the sticky bit can be replaced by their owner and the folder's only.
bool may_replace(const fs::path& target, const fs::path& file) {
  struct stat of_folder {
  }, of_file{};
  if (::stat(target.c_str(), &of_folder) != 0 || ::lstat(file.c_str(), &of_file) != 0) return true;
  const uid_t me = ::geteuid();
  return !(of_folder.st_mode & S_ISVTX) || me == 0 || me == of_file.st_uid || me == of_folder.st_uid;
}

void check_files(const fs::path& target) {
  const bool ours = holds_results(target);
  for (const std::string_view name : own_files) {
    const fs::path file = target / name;
    const fs::file_status status = fs::symlink_status(file);
    if (!fs::exists(status)) continue;
    if (fs::is_directory(status))
      throw InputError(file.string() + ": is a folder where a file of results goes; expected it to be moved away");
    if (!ours)
      throw InputError(file.string() +
                       ": a file of this name is there that mortise did not write; expected -o another folder");
    if (!may_replace(target, file)) throw InputError(file.string() + ": is another user's; expected -o another folder");
  }
}

/// The folder itself, or the nearest above it that is there.
fs::path nearest_folder(fs::path target) {
  target = fs::absolute(target);
  while (!fs::exists(fs::symlink_status(target)) && target.has_relative_path()) target = target.parent_path();
  return target;
}

// What a run of ours has written into a folder, and the folder where nothing else is in it.
void remove_results(const fs::path& target) {
  std::error_code ignored;
  if (fs::is_symlink(target, ignored) || !fs::is_directory(target, ignored) || !holds_results(target)) return;
  for (const std::string_view name : own_files) fs::remove(target / name, ignored);
  fs::remove(target, ignored);  // if nothing else is in it
}

// Results in folders of cases, but for those of the names in `kept`.
void remove_older_cases(const fs::path& folder, const std::set<std::string>& kept) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    if (!kept.contains(entry.path().filename().string())) remove_results(entry.path());
  fs::remove(folder, ignored);  // if nothing is left in it
}

}  // namespace

void check_output_folder(const fs::path& target) try {
  const fs::path there = nearest_folder(target);
  if (!fs::is_directory(there)) fail(target, there.string() + " is a file, expected a folder");
  if (::access(there.c_str(), W_OK | X_OK) != 0)
    fail(target, std::error_code(errno, std::generic_category()).message());
  if (fs::is_directory(target)) check_files(target);
} catch (const fs::filesystem_error& error) {
  fail(target, error.code().message());
}

OutputFolder::OutputFolder(fs::path target) : target_(std::move(target)) {
  check_output_folder(target_);
  std::error_code error;
  fs::create_directories(target_, error);
  if (!fs::is_directory(target_)) fail(target_, error.message());
}

fs::path OutputFolder::path(const std::string& name) {
  if (std::ranges::find(own_files, name) == own_files.end())
    throw std::logic_error(name + ": a new output belongs into own_files");
  return files_.emplace_back(target_ / name).staged.path();
}

std::string OutputFolder::with_target(std::string message) const {
  for (const File& file : files_)
    if (const std::size_t at = message.find(file.staged.path().string()); at != std::string::npos)
      message.replace(at, file.staged.path().string().size(), file.place.string());
  return message;
}

void OutputFolder::commit(const std::optional<std::set<std::string>>& cases) {
  // Without a table of cases, folders of that name are results that the user has put there.
  const bool had_cases = fs::exists(target_ / "cases.csv");
  const auto written = [&](std::string_view name) {
    return std::ranges::any_of(files_, [&](const File& file) { return file.place.filename() == name; });
  };
  try {
    fs::remove(target_ / summary);
    for (const std::string_view name : own_files)
      if (!written(name)) fs::remove(target_ / name);
  } catch (const fs::filesystem_error& error) {
    fail(target_, error.code().message());
  }
  if (cases || had_cases) remove_older_cases(target_ / case_folder, cases.value_or(std::set<std::string>()));
  for (const bool last : {false, true})
    for (File& file : files_)
      if ((file.place.filename() == summary) == last) file.staged.commit(false);
}

}  // namespace mortise
