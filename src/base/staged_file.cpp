#include "base/staged_file.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <system_error>

#include "base/errors.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_write(const fs::path& target, const std::string& why) {
  throw InputError(target.string() + ": cannot be written: " + why);
}

/// Its beginning, at most 64 KiB of it.
std::string first_line(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text(64 * 1024, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(stream.gcount());
  return text.substr(0, text.find_first_of("\r\n"));
}

/// ".NAME.1234.mortise.csv" for NAME.csv and process 1234.
fs::path staging_of(const fs::path& target, pid_t process) {
  std::string name = ".";
  name += target.stem().string() + "." + std::to_string(process) + ".mortise";
  return target.parent_path() / name.append(target.extension().string());
}

bool has_ended(pid_t process) { return process != ::getpid() && ::kill(process, 0) != 0 && errno == ESRCH; }

void remove_leftovers(const fs::path& target) {
  const std::string start = "." + target.stem().string() + ".";
  std::error_code error;
  std::vector<fs::path> left;
  for (const fs::directory_entry& entry : fs::directory_iterator(target.parent_path(), error)) {
    const std::string name = entry.path().filename().string();
    pid_t process = 0;
    if (!name.starts_with(start)) continue;
    std::from_chars(name.data() + start.size(), name.data() + name.size(), process);
    if (process > 0 && entry.path() == staging_of(target, process) && has_ended(process)) left.push_back(entry.path());
  }
  for (const fs::path& file : left) fs::remove(file, error);
}

void check_place(const fs::path& target, const fs::file_status& status) {
  if (fs::is_directory(status)) fail_write(target, "it is a folder; expected a file");
  if (fs::exists(status) && !fs::is_regular_file(status)) fail_write(target, "it is a device or a pipe");
  if (!target.has_filename()) fail_write(target, "expected the name of a file");
}

}  // namespace

void check_target(const fs::path& target, const std::vector<fs::path>& inputs, const IsOurs& ours) try {
  const fs::file_status status = fs::status(target);
  check_place(target, status);
  if (!fs::exists(status)) return;
  std::error_code ignored;
  for (const fs::path& input : inputs) {
    if (fs::equivalent(target, input, ignored)) fail_write(target, "it is the input " + input.string());
  }
  if (fs::file_size(target) > 0 && !ours(first_line(target))) {
    fail_write(target, "a file of this name is there that mortise did not write; choose another name or remove it");
  }
} catch (const fs::filesystem_error& error) {
  fail_write(target, error.code().message());
}

StagedFile::StagedFile(const fs::path& target) : shown_(target) {
  std::error_code error;
  target_ = fs::weakly_canonical(fs::absolute(target, error), error);
  if (error) fail_write(shown_, error.message());
  staging_ = staging_of(target_, ::getpid());
  constexpr int flags = O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC;
  int descriptor = ::open(staging_.c_str(), flags, 0666);
  if (descriptor < 0 && errno == EEXIST) {  // of a process that was killed and had our number
    ::unlink(staging_.c_str());
    descriptor = ::open(staging_.c_str(), flags, 0666);
  }
  if (descriptor < 0) {
    staging_.clear();
    fail(errno);
  }
  ::close(descriptor);
  remove_leftovers(target_);  // after there is another, so that there is one at all times
}

StagedFile::~StagedFile() {
  if (!staging_.empty()) ::unlink(staging_.c_str());
}

void StagedFile::fail(int error) const { fail_write(shown_, std::strerror(error)); }

void StagedFile::commit(bool on_disk) {
  const int descriptor = ::open(staging_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail(errno);
  const bool written = !on_disk || ::fsync(descriptor) == 0 || errno == EINVAL;  // not every file system can
  const int error = errno;
  if (::close(descriptor) != 0) fail(errno);
  if (!written) fail(error);
  if (::rename(staging_.c_str(), target_.c_str()) != 0) fail(errno);
  staging_.clear();
}

}  // namespace mortise
