#include "app/picture.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "base/errors.hpp"
#include "results/setup_json.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

// Installed, or in the build folder.
fs::path script(const std::string& name) {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  for (const fs::path& share : {folder / MORTISE_BIN_TO_SHARE, folder / "share/mortise"})
    if (const fs::path found = share / name; fs::exists(found)) return found;
  throw InputError(name + " (Debian package mortise-python) is not there: expected in " +
                   (folder / MORTISE_BIN_TO_SHARE).string());
}

// The system's Python has the packages of the distribution; MORTISE_PYTHON names another.
std::string python() {
  if (const char* own = std::getenv("MORTISE_PYTHON")) return own;
  return fs::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3";
}

std::vector<std::string> words_of(const std::string& name, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{python(), script(name).string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

std::vector<char*> argv_of(std::vector<std::string>& words) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  return argv;
}

[[noreturn]] void fail_without_python(const std::string& name) {
  throw InputError(name + " is run by Python, which is not there (" + python() +
                   "): apt-get install python3-matplotlib python3-meshio");
}

// 0, or 1 where it did nothing and said why on the standard error.
int run_script(const std::string& name, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = words_of(name, arguments);
  pid_t process = 0;
  if (::posix_spawnp(&process, words[0].c_str(), nullptr, nullptr, argv_of(words).data(), environ) != 0)
    fail_without_python(name);
  int status = 0;
  ::waitpid(process, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? 0 : 1;
}

struct TemporaryFile {
  TemporaryFile() {
    const int file = ::mkstemp(path.data());
    if (file < 0) throw InputError(path + ": cannot be written");
    ::close(file);
  }
  ~TemporaryFile() { ::unlink(path.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  std::string path = (fs::temp_directory_path() / "mortise_setup_XXXXXX").string();
};

}  // namespace

void become_script(const std::string& name, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = words_of(name, arguments);
  ::setenv("MORTISE_PROGRAM", fs::read_symlink("/proc/self/exe").c_str(), 1);
  ::execvp(words[0].c_str(), argv_of(words).data());
  fail_without_python(name);
}

int run_on_geometry(const std::string& name, const Mesh& mesh, std::vector<std::string> arguments) {
  const TemporaryFile file;
  write_geometry(mesh, file.path);
  arguments.insert(arguments.begin(), file.path);
  return run_script("scenes/" + name + ".py", arguments);
}

int draw_setup(const Problem& problem, const fs::path& picture) {
  const TemporaryFile file;
  write_setup(problem, file.path);
  return run_script("pictures/setup.py", {file.path, picture.string()});
}

}  // namespace mortise
