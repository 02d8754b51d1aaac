// Which room may enter which (docs/architecture.md), held against the sources themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace mortise {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

const fs::path project = MORTISE_SOURCE_DIR;

// The rooms of src/, and whose headers each may include beside its own.
const std::map<std::string, Names> may_enter{
    {"base", {}},
    {"model", {"base"}},
    {"mesh", {"base", "model"}},
    {"fem", {"base", "model", "mesh"}},
    {"contact", {"base", "model", "mesh", "fem"}},
    {"solve", {"base", "model"}},
    {"ddm", {"base", "model", "solve"}},
    {"preprint_solvers", {"base", "model", "solve", "ddm"}},
    {"scene", {"base", "model"}},
    {"mesh_files", {"base", "model", "mesh"}},
    {"gmsh", {"base", "model", "mesh", "fem", "mesh_files"}},
    {"output", {"base", "mesh"}},
    {"fields", {"base", "mesh", "fem", "scene", "output"}},
    {"problem", {"base", "model", "mesh", "fem", "contact", "solve", "scene"}},
    {"error", {"base", "model", "mesh", "fem", "contact", "solve", "problem"}},
    {"results", {"base", "model", "mesh", "fem", "contact", "solve", "output", "problem", "error"}},
    {"app",
     {"base", "model", "mesh", "fem", "contact", "solve", "ddm", "preprint_solvers", "scene", "mesh_files", "gmsh",
      "output", "fields", "problem", "error", "results"}},
    {"mortise", {"base", "solve", "scene", "gmsh", "results", "app"}},
    {"python", {"mortise", "results"}},
};

// Headers of others, and the rooms that may use them; `sources_only`: not in its headers, so that nobody who
// includes ours needs theirs.
struct Foreign {
  std::string what, header;
  Names rooms;
  bool sources_only;
};
const std::vector<Foreign> foreigners{
    {"Boost", R"(boost/(?!math/).*)", {"mesh"}, true},
    {"Boost.Math", R"(boost/math/.*)", {"contact"}, true},
    {"gmsh", R"(gmsh\..*)", {"gmsh"}, true},
    {"libseccomp", R"(seccomp\.h)", {"gmsh"}, true},
    {"VTK", R"(vtk\w+\.h)", {"output", "fields"}, true},
    {"CHOLMOD", R"((.*/)?cholmod.*)", {"solve"}, true},
    {"AMD", R"((.*/)?amd\.h)", {"solve"}, true},
    {"nlohmann-json", R"(nlohmann/.*)", {"results", "scene"}, false},
    {"CLI11", R"(CLI/.*)", {"app"}, false},
    {"toml++", R"(toml\+\+.*)", {"scene"}, true},
    {"pybind11", R"(pybind11/.*)", {"python"}, true},
    {"muParser", R"(muParser.*)", {"model"}, true},
    {"METIS", R"((.*/)?metis\.h)", {"solve"}, true},
};

const Names top_level{"CMakeLists.txt",
                      "CMakePresets.json",
                      "README.md",
                      "LICENSE",
                      "CHANGELOG.md",
                      "CITATION.cff",
                      "SECURITY.md",
                      "dev",
                      "src",
                      "geo",
                      "freefem",
                      "verification",
                      "tests",
                      "docs",
                      "build",
                      "out"};  // the last two are made by
                               // the presets and by runs;
                               // git ignores them

// What is wrong with one include of `file` (a path below src/); empty if nothing.
std::string trouble(const fs::path& file, const std::string& header, bool quoted) {
  const std::string room = file.begin()->string();
  if (!may_enter.count(room)) return "'" + room + "' is no room of src/";
  const std::string other = fs::path(header).begin()->string();
  if (may_enter.count(other)) {
    if (other == room || may_enter.at(room).count(other)) return "";
    return "the room '" + room + "' may not include \"" + header + "\"";
  }
  if (quoted) return "\"" + header + "\" names no room; expected \"" + room + "/...\", or <...> for headers of others";
  for (const Foreign& f : foreigners) {
    if (!std::regex_match(header, std::regex(f.header))) continue;
    if (!f.rooms.count(room) || (f.sources_only && file.extension() != ".cpp"))
      return "<" + header + ">: " + f.what + " is for src/" + *f.rooms.begin() + "/" + (f.sources_only ? "*.cpp" : "") +
             " only";
  }
  return "";
}

// One "src/FILE:LINE: what" for every include that breaks a rule.
std::vector<std::string> violations(const fs::path& file, std::istream& text) {
  static const std::regex include(R"(\s*#\s*include\s*([<"])([^>"]+)[>"].*)");
  std::vector<std::string> found;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    std::smatch match;
    if (!std::regex_match(line, match, include)) continue;
    const std::string what = trouble(file, match[2], match[1] == "\"");
    if (!what.empty()) found.push_back("src/" + file.generic_string() + ":" + std::to_string(number) + ": " + what);
  }
  return found;
}

std::vector<std::string> violations_of(const std::string& file, const std::string& text) {
  std::istringstream stream(text);
  return violations(file, stream);
}

TEST(IncludeRules, HoldInAllOfSrc) {
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(project / "src")) {
    const fs::path extension = entry.path().extension();
    if (!entry.is_regular_file() || (extension != ".hpp" && extension != ".cpp")) continue;
    ++files;
    std::ifstream text(entry.path());
    ASSERT_TRUE(text) << entry.path();
    for (const std::string& what : violations(entry.path().lexically_relative(project / "src"), text))
      ADD_FAILURE() << what;
  }
  EXPECT_GT(files, 50) << "not the source tree? " << project;
}

// Units of src/ (a header, or headers and sources, of one name) that the page on the architecture does not name.
std::vector<std::string> unnamed_units(const std::string& page) {
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(project / "src")) {
    if (entry.path().extension() != ".hpp") continue;
    const std::string unit = entry.path().stem().string();
    const std::string room = entry.path().parent_path().filename().string();
    // "`mesh/mesh.hpp`" names a unit as "`mesh`" does.
    if (!std::regex_search(page, std::regex("`(" + room + "/)?" + unit + "(\\.hpp)?`")))
      found.push_back(room + "/" + unit);
  }
  return found;
}

std::string text_of(const fs::path& file) {
  std::ifstream text(file);
  return {std::istreambuf_iterator<char>(text), {}};
}

TEST(IncludeRules, ThePageNamesEveryUnit) {
  const std::string page = text_of(project / "docs/architecture.md");
  for (const std::string& unit : unnamed_units(page))
    ADD_FAILURE() << "docs/architecture.md does not name src/" << unit;
  EXPECT_GT(unnamed_units("`coupling`").size(), 100u);
}

// "room (thousands of lines)", to half a thousand.
TEST(IncludeRules, ThePageKnowsTheSizesOfTheRooms) {
  const std::string page = text_of(project / "docs/architecture.md");
  for (const auto& [room, others] : may_enter) {
    double lines = 0;
    for (const auto& entry : fs::recursive_directory_iterator(project / "src" / room))
      if (entry.path().extension() == ".cpp" || entry.path().extension() == ".hpp")
        lines += double(std::ranges::count(text_of(entry.path()), '\n'));
    std::smatch size;
    if (std::regex_search(page, size, std::regex("\\b" + room + R"( \(([0-9.]+)\))")))
      EXPECT_NEAR(std::stod(size[1]), lines / 1000, 0.5) << room;
    else
      EXPECT_LT(lines, 500) << room << ": no size on docs/architecture.md";
  }
}

TEST(IncludeRules, NameFileAndLineOfAForbiddenInclude) {
  EXPECT_EQ(
      violations_of("mesh/mesh.cpp", "#include <vector>\n\n#include \"solve/saddle_point.hpp\"\n"),
      std::vector<std::string>{"src/mesh/mesh.cpp:3: the room 'mesh' may not include \"solve/saddle_point.hpp\""});
  for (const auto& [file, text] : std::vector<std::pair<std::string, std::string>>{
           {"solve/a.cpp", "#include \"mesh/mesh.hpp\""},
           {"gmsh/a.hpp", "#  include <gmsh.h>  // for the model"},
           {"output/a.hpp", "#include <vtkPoints.h>"},
           {"fem/a.cpp", "#include <vtkPoints.h>"},
           {"mesh/a.hpp", "#include <boost/geometry.hpp>"},
           {"solve/a.hpp", "#include <suitesparse/cholmod.h>"},
           {"ddm/a.cpp", "#include <amd.h>"},
           {"fem/a.cpp", "#include <nlohmann/json.hpp>"},
           {"app/a.cpp", "#include <toml++/toml.h>"},
           {"scene/a.hpp", "#include <toml++/toml.h>"},
           {"model/a.hpp", "#include <muParser.h>"},
           {"scene/a.cpp", "#include <muParser.h>"},
           {"scene/a.cpp", "#include <app/solve_scene.hpp>"},
           {"fem/a.cpp", "#include \"assembly.hpp\""},
           {"attic/a.cpp", "#include <vector>"},
       })
    EXPECT_EQ(violations_of(file, text).size(), 1u) << file << ": " << text;
}

TEST(IncludeRules, AllowWhatTheTableAllows) {
  for (const auto& [file, text] : std::vector<std::pair<std::string, std::string>>{
           {"app/a.cpp", "#include \"ddm/a.hpp\"\n#include <CLI/CLI.hpp>"},
           {"results/a.hpp", "#include \"problem/a.hpp\"\n#include <nlohmann/json.hpp>"},
           {"gmsh/a.cpp", "#include <gmsh.h>\n#include \"fem/elements.hpp\""},
           {"fields/a.cpp", "#include <vtkPoints.h>"},
           {"solve/a.cpp", "#include <amd.h>\n#include <cholmod.h>\n#include <Eigen/LU>"},
           {"scene/a.cpp", "#include <toml++/toml.h>\n// #include \"app/a.hpp\""},
       })
    EXPECT_EQ(violations_of(file, text), std::vector<std::string>{}) << file << ": " << text;
}

// ---- Units: a .hpp and the .cpp of its name ----

using Graph = std::map<std::string, Names>;

// The units that each unit includes, by the texts of all files (paths below src/ without their extension).
Graph units_of(const std::vector<std::pair<std::string, std::string>>& files) {
  static const std::regex include(R"(\s*#\s*include\s*"([^"]+)\.hpp".*)");
  Graph graph;
  for (const auto& [unit, text] : files) {
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
      if (std::smatch match; std::regex_match(line, match, include) && match[1] != unit) graph[unit].insert(match[1]);
  }
  return graph;
}

// A way from a unit back to itself, "a -> b -> a"; empty if there is none.
std::string loop_through(const Graph& graph, const std::string& start) {
  std::map<std::string, std::string> from;  // how a unit was reached
  std::vector<std::string> open{start};
  while (!open.empty()) {
    const std::string unit = open.back();
    open.pop_back();
    if (!graph.count(unit)) continue;
    for (const std::string& next : graph.at(unit)) {
      if (!from.emplace(next, unit).second) continue;
      open.push_back(next);
    }
  }
  if (!from.count(start)) return "";
  std::string way = start;
  for (std::string at = from.at(start); at != start; at = from.at(at)) way = at + " -> " + way;
  return start + " -> " + way;
}

TEST(IncludeRules, NoLoopBetweenUnits) {
  std::vector<std::pair<std::string, std::string>> files;
  for (const auto& entry : fs::recursive_directory_iterator(project / "src")) {
    const fs::path extension = entry.path().extension();
    if (!entry.is_regular_file() || (extension != ".hpp" && extension != ".cpp")) continue;
    std::ifstream file(entry.path());
    std::ostringstream text;
    text << file.rdbuf();
    files.emplace_back(entry.path().lexically_relative(project / "src").replace_extension().generic_string(),
                       text.str());
  }
  const Graph graph = units_of(files);
  EXPECT_GT(graph.size(), 50U);
  for (const auto& [unit, included] : graph) EXPECT_EQ(loop_through(graph, unit), "");
}

TEST(IncludeRules, ALoopBetweenUnitsIsNamed) {
  const Graph graph = units_of({{"a/one", "#include \"a/two.hpp\"\n#include \"a/one.hpp\""},
                                {"a/two", "#include \"b/three.hpp\""},
                                {"b/three", "#include <vector>\n#include \"a/one.hpp\""}});
  EXPECT_EQ(loop_through(graph, "a/one"), "a/one -> a/two -> b/three -> a/one");
  EXPECT_EQ(loop_through(units_of({{"a/one", "#include \"a/one.hpp\""}}), "a/one"), "");
}

TEST(TopLevel, HoldsTheListedEntriesOnly) {
  for (const auto& entry : fs::directory_iterator(project)) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(name.front() == '.' || top_level.count(name)) << entry.path().string() << ": not a place for this";
  }
}

}  // namespace
}  // namespace mortise
