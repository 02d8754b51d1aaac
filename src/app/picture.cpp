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

int run_script(const std::string& name, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{python(), script(name).string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t process = 0;
  if (::posix_spawnp(&process, argv[0], nullptr, nullptr, argv.data(), environ) != 0)
    throw InputError(name + " is run by Python, which is not there (" + words[0] +
                     "): apt-get install python3-matplotlib python3-meshio");
  int status = 0;
  ::waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
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

int draw_picture(const std::vector<std::string>& arguments) {
  return run_script("pictures/picture.py", arguments) == 0 ? 0 : 1;
}

int run_with_program(const std::string& script, const std::vector<std::string>& arguments) {
  ::setenv("MORTISE_PROGRAM", fs::read_symlink("/proc/self/exe").c_str(), 1);
  return run_script(script, arguments);
}

int run_on_geometry(const std::string& name, const Mesh& mesh, std::vector<std::string> arguments) {
  const TemporaryFile file;
  write_geometry(mesh, file.path);
  arguments.insert(arguments.begin(), file.path);
  return run_script("scenes/" + name + ".py", arguments) == 0 ? 0 : 1;
}

int draw_setup(const Problem& problem, const fs::path& picture) {
  const TemporaryFile file;
  write_setup(problem, file.path);
  return run_script("pictures/setup.py", {file.path, picture.string()}) == 0 ? 0 : 1;
}

}  // namespace mortise
