#include "gmsh/geo_programs.hpp"

#include <algorithm>
#include <array>
#include <fstream>

#include "base/errors.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

/// gmsh ends a string at 1023 characters and reads what is left of it as commands.
constexpr std::size_t longest_string = 1000;

[[noreturn]] void refuse(const GeoText& geo, std::size_t position, const std::string& what) {
  throw InputError(place_of(geo, position) + ": " + what + "; --no-programs refuses it");
}

char next_of(const GeoText& geo, std::size_t position) {
  const std::size_t next = skip_spaces(geo.code, position);
  return next < geo.code.size() ? geo.code[next] : '\0';
}

void check_commands(const GeoText& geo) {
  constexpr std::array commands{"SystemCall",      "NonBlockingSystemCall",
                                "System",          "OnelabRun",
                                "OnelabAction",    "Save",
                                "Print",           "Plugin",
                                "ExternalProcess", "CreateDir",
                                "Solver",          "SessionFileName",
                                "OptionsFileName", "ErrorFileName"};
  for (const std::string word : commands) {
    for (const std::size_t end : ends_of_word(geo.code, word)) {
      const char next = next_of(geo, end);
      const bool variable = next == '=' && (word == "System" || word == "Save" || word == "Print");
      const bool option = next == '.' && word == "Print";
      if (!variable && !option) refuse(geo, end, "'" + word + "' runs a program or writes a file");
    }
  }
  for (const std::size_t end : ends_of_word(geo.code, "Printf")) {
    const std::size_t open = skip_spaces(geo.code, end);
    if (next_of(geo, skip_brackets(geo.code, open)) == '>') refuse(geo, end, "'Printf' into a file");
  }
  for (const char* word : {"Macro", "Function"}) {
    for (const std::size_t end : ends_of_word(geo.code, word)) {
      if (next_of(geo, end) == '(') refuse(geo, end, "a macro made from a string");
    }
  }
}

bool is_mesh(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string start(11, '\0');
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  return start == "$MeshFormat";
}

void check_includes(const GeoText& geo) {
  for (const GeoInclude& include : includes_of(geo)) {
    if (include.file.empty()) refuse(geo, include.position, "a file whose name is not a plain string");
    const std::string ending = include.file.extension().string();
    constexpr std::array geometry{".geo", ".step", ".stp", ".brep", ".iges", ".igs"};
    if (std::find(geometry.begin(), geometry.end(), ending) != geometry.end()) continue;
    if (ending == ".msh" && is_mesh(include.file)) continue;
    refuse(geo, include.position, "'" + include.file.string() + "' is neither geometry nor a mesh");
  }
}

void check_strings(const GeoText& geo) {
  if (const std::size_t nul = geo.text.find('\0'); nul != std::string::npos) refuse(geo, nul, "a zero byte");
  std::size_t length = 0;
  for (std::size_t i = 0; i < geo.text.size(); ++i) {
    length = geo.code[i] == ' ' && geo.text[i] != '\n' ? length + 1 : 0;
    if (length > longest_string) refuse(geo, i, "a string, comment or row of spaces longer than 1000 characters");
  }
}

}  // namespace

void check_no_programs(const GeoText& geo) {
  check_strings(geo);
  check_commands(geo);
  check_includes(geo);
}

}  // namespace mortise
