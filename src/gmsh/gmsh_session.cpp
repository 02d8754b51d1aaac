#include "gmsh/gmsh_session.hpp"

#include <fcntl.h>
#include <gmsh.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>

#include "base/errors.hpp"
#include "base/memory_file.hpp"
#include "base/printable.hpp"
#include "gmsh/gmsh_groups.hpp"
#include "gmsh/sandbox.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

/// Also after a .geo has been read, which may set any option. AbortOnError stays off: with it on, gmsh 4.8 throws a
/// string out of an OpenMP region, which ends the process. Errors are found in the log instead.
void set_options() {
  gmsh::option::setNumber("General.Terminal", 1);  // run_in_child keeps it from the terminal, and quotes the last line
  gmsh::option::setNumber("General.Verbosity", 2);
  gmsh::option::setNumber("General.AbortOnError", 0);
  gmsh::option::setNumber("General.NumThreads", 1);
}

/// gmsh's first error since the log began; empty if there was none.
std::string first_error() {
  std::vector<std::string> log;
  gmsh::logger::get(log);
  const std::string mark = "Error: ";
  std::string first;
  int more = 0;
  for (const std::string& line : log) {
    if (line.rfind(mark, 0) != 0) continue;
    if (first.empty()) {
      first = line.substr(mark.size());
    } else {
      ++more;
    }
  }
  if (more > 0) first += " (and " + std::to_string(more) + " more)";
  return first;
}

/// Whether gmsh can be given this text between quotes: its strings know no escapes, and end at 1023 characters.
bool can_be_quoted(const std::string& text) {
  return text.size() < 1000 && text.find_first_of("\"\\") == std::string::npos && printable(text) == text;
}

/// A path to a .geo in words that gmsh can be given. A folder whose name cannot be quoted goes by the number of a
/// descriptor, and the files that the .geo includes are found from there.
class QuotedPath {
 public:
  explicit QuotedPath(const std::string& file) : path_(fs::absolute(file)) {
    const std::string name = path_.filename().string();
    if (!can_be_quoted(name)) {
      throw InputError(file + ": gmsh cannot open a file with quotes, backslashes or control characters in its name");
    }
    if (can_be_quoted(path_.string())) return;
    folder_ = path_.parent_path().string();
    descriptor_ = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor_ < 0) throw InputError(file + ": its folder cannot be opened");
    path_ = number() + "/" + name;
  }
  ~QuotedPath() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  QuotedPath(const QuotedPath&) = delete;
  QuotedPath& operator=(const QuotedPath&) = delete;

  std::string path() const { return path_.string(); }
  /// A message with the folder's own name in it again.
  std::string shown(std::string message) const {
    for (std::size_t i = 0; descriptor_ >= 0 && (i = message.find(number(), i)) != std::string::npos;) {
      message.replace(i, number().size(), folder_);
      i += folder_.size();
    }
    return message;
  }

 private:
  std::string number() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

  fs::path path_;
  std::string folder_;
  int descriptor_ = -1;
};

std::string number_text(double value) {
  std::array<char, 40> digits{};
  std::snprintf(digits.data(), digits.size(), "%.17g", value);
  return digits.data();
}

std::string shortest(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// Assignments, then the .geo itself: DefineConstant leaves a variable alone that exists already.
/// gmsh's own way, -setnumber, cannot be undone: its values outlive gmsh::finalize and would leak into the next mesh.
/// Without parameters too: of a .geo that it opens itself, gmsh 4.8 silently drops the last statement if no newline
/// follows, of an included one it does not.
std::string preamble(const std::string& path, const std::map<std::string, double>& parameters) {
  std::string text;
  for (const auto& [name, value] : parameters) {
    text += name + " = " + number_text(value) + ";\n";
  }
  return text + "Include \"" + path + "\";\n";
}

// gmsh writes beyond its tables at orders that it does not have. Of its options for meshes and geometries one alone
// changes a mesh as it is saved, which is what `gmsh -2` would have made of the same file.
void require_options(const std::string& file) {
  const auto require = [&](const std::string& name, std::initializer_list<double> known, const std::string& expected) {
    double value = 0;
    gmsh::option::getNumber(name, value);
    if (std::ranges::find(known, value) == known.end())
      throw InputError(file + ": " + name + " = " + shortest(value) + ": expected " + expected);
  };
  require("Mesh.ElementOrder", {1, 2}, "1 (linear) or 2 (quadratic)");
  require("Mesh.ScalingFactor", {1},
          "1: gmsh scales a mesh as it saves it, and here it is taken as it is drawn; draw it in the units of the "
          "calculation, scale what is drawn (Dilate), or name the .msh that `gmsh -2` saves");
}

/// The toolkit of gmsh's windows would write its settings to ~/.fltk as gmsh starts: a home where nothing can be made.
class NoHome {
 public:
  NoHome() {
    if (const char* const home = std::getenv("HOME")) home_ = home;
    setenv("HOME", "/dev/null", 1);
  }
  ~NoHome() {
    if (home_)
      setenv("HOME", home_->c_str(), 1);
    else
      unsetenv("HOME");
  }
  NoHome(const NoHome&) = delete;
  NoHome& operator=(const NoHome&) = delete;

 private:
  std::optional<std::string> home_;
};

}  // namespace

GmshSession::GmshSession(ForbiddenBy forbidden) {
  const NoHome no_home;
  std::string name = "mortise";
  std::string option = "-v";
  std::string value = "0";
  std::array<char*, 3> arguments{name.data(), option.data(), value.data()};
  gmsh::initialize(static_cast<int>(arguments.size()), arguments.data(), false);
  set_options();
  gmsh::logger::start();
  if (forbidden) forbid_acts(forbidden);
}

void GmshSession::run(const std::string& file, const std::string& what, const std::function<void()>& step) {
  std::string thrown;
  gmsh::logger::stop();
  gmsh::logger::start();  // of this step alone
  try {
    step();
  } catch (const std::exception& error) {
    thrown = error.what();
  } catch (const std::string& text) {
    thrown = text;
  } catch (...) {
    thrown = "failed without a message";
  }
  const std::string logged = first_error();
  const std::string& message = logged.empty() ? thrown : logged;
  if (!message.empty()) throw InputError(file + ": gmsh, " + what + ": " + printable(message));
}

void GmshSession::read(const std::string& file, const std::map<std::string, double>& parameters) {
  if (fs::path(file).extension() == ".msh") {
    run(file, "reading", [&] { gmsh::open(file); });
    return;
  }
  const QuotedPath quoted(file);
  const MemoryFile script(preamble(quoted.path(), parameters));
  try {
    run(file, "reading", [&] { gmsh::open(script.path()); });
    set_options();
    require_options(file);
    group_by_entity();
  } catch (const InputError& error) {
    throw InputError(quoted.shown(error.what()));
  }
}

void GmshSession::read_text(const std::string& file, const std::string& text) {
  const MemoryFile script(text);
  run(file, "reading its geometry again", [&] { gmsh::open(script.path()); });
}

void GmshSession::reset_options() {
  const MemoryFile script("Delete Options;\n");
  gmsh::merge(script.path());
  set_options();
}

bool GmshSession::has_cells() const {
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, 2);
  return !types.empty();
}

}  // namespace mortise
