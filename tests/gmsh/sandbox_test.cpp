// mesh.programs = false: a .geo reaches for nothing beyond its mesh, however it is written.
#include "gmsh/sandbox.hpp"

#include <gtest/gtest.h>

#include <set>

#include "base/errors.hpp"
#include "gmsh/free_mesher.hpp"
#include "gmsh/load_mesh.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using test::TemporaryFolder;

const std::string drawing =
    "Point(1)={0,0,0};Point(2)={1,0,0};Point(3)={0,1,0};Line(1)={1,2};Line(2)={2,3};Line(3)={3,1};\n"
    "Curve Loop(1)={1:3};Plane Surface(1)={1};Physical Surface(\"a\")={1};\n";

// What runs a program or writes a file. PROOF is a path at which there is nothing yet.
const std::vector<std::string> acts{
    "SystemCall \"touch PROOF\";",
    "System 'touch PROOF';",
    "SystemCall Str(\"touch PROOF\");",
    "SystemCall StrCat(\"touch\", \" PROOF\");",
    "SystemCall \"(touch PROOF &) ; exec true\";",
    "NonBlockingSystemCall \"touch PROOF\";",
    "OnelabRun(\"name\", \"touch PROOF\");",
    "Save \"PROOF.msh\";",
    "Save 'PROOF.geo_unrolled';",
    "Print \"PROOF.msh\";",
    "Printf(\"%g\", 1) > \"PROOF\";",
    "Printf(\"a)\", 1) /* */ >> \"PROOF\";",
    "CreateDir \"PROOF\";",
    "Field[1] = ExternalProcess; Field[1].CommandLine = \"touch PROOF\"; Background Field = 1; Mesh 2;",
};

// Ways to write it that a reader of the text may miss.
struct Disguise {
  const char* what;
  std::string (*text)(const TemporaryFolder& folder, const std::string& act);
};
std::string doubled(std::string text) {  // for a string in quotes
  std::string out;
  for (const char c : text) out += c == '"' ? '\'' : c;
  return out;
}
const std::vector<Disguise> disguises{
    {"plain", [](const TemporaryFolder&, const std::string& act) { return act; }},
    {"in a branch behind a string that ends another",
     [](const TemporaryFolder&, const std::string& act) {
       return "If (0)\n x = Str(\" EndIf " + doubled(act) + " //\");\nEndIf\n";
     }},
    {"in an included file",
     [](const TemporaryFolder& folder, const std::string& act) {
       folder.write("part/b.geo", act + "\n");
       return std::string("Include \"part/b.geo\";");
     }},
    {"in an included file of a computed name",
     [](const TemporaryFolder& folder, const std::string& act) {
       folder.write("c.geo", act + "\n");
       return std::string("Include StrCat(\"c\", \".geo\");");
     }},
    {"in what calls itself a mesh",
     [](const TemporaryFolder& folder, const std::string& act) {
       folder.write("d.msh", "$MeshFormat;\n" + act + "\n");
       return std::string("Include \"d.msh\";");
     }},
    {"in a macro",
     [](const TemporaryFolder&, const std::string& act) { return "Macro M\n" + act + "\nReturn\nCall M;"; }},
    {"behind a string that gmsh ends early",
     [](const TemporaryFolder&, const std::string& act) { return "a = \"" + std::string(1100, 'x') + "\"; " + act; }},
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t i = 0; (i = text.find(what, i)) != std::string::npos; i += by.size())
    text.replace(i, what.size(), by);
  return text;
}

/// Meshes a .geo with that line; whether anything new is in the folder then, and what was thrown.
struct Outcome {
  bool acted;
  std::string thrown;
};
Outcome mesh(const Disguise& disguise, const std::string& act, bool programs) {
  const TemporaryFolder folder;
  const std::string text = disguise.text(folder, replaced(act, "PROOF", folder.path("proof")));
  const std::string file = folder.write("a.geo", drawing + text + "\n");
  const auto files = [&] {
    std::set<std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path())) all.insert(entry.path());
    return all;
  };
  const std::set<std::string> before = files();
  // gmsh waits for the sizes of an external process without an end.
  const double seconds = programs && act.find("ExternalProcess") != std::string::npos ? 0.5 : 100;
  const std::string thrown = message_of([&] { load_mesh(file, {}, {.seconds = seconds, .programs = programs}); });
  return {files() != before, thrown};
}

TEST(Sandbox, NoSpellingOfAProgramRunsInIt) {
  int acted = 0;
  for (const Disguise& disguise : disguises)
    for (const std::string& act : acts) {
      const Outcome inside = mesh(disguise, act, false);
      EXPECT_FALSE(inside.acted) << disguise.what << ": " << act;
      if (!mesh(disguise, act, true).acted) continue;
      ++acted;
      test::expect_contains(inside.thrown, "; --no-programs (mesh.programs = false) forbids that");
    }
  EXPECT_GE(acted, 60) << "too few of these do anything where they may";
}

TEST(Sandbox, SaysWhatWasAboutToHappen) {
  const auto said = [](const char* act) { return mesh(disguises.front(), act, false).thrown; };
  test::expect_contains(said("SystemCall \"touch PROOF\";"), "a.geo: it runs a program; ");
  test::expect_contains(said("Printf(\"x\") > \"PROOF\";"), "a.geo: it writes a file or changes a folder; ");
}

TEST(Sandbox, EveryGeometryOfOursIsMeshedInIt) {
  for (const auto& entry : fs::directory_iterator(std::string(MORTISE_SOURCE_DIR) + "/geo")) {
    if (entry.path().extension() != ".geo") continue;
    const std::string file = entry.path();
    const Mesh inside = load_mesh(file, {}, {.programs = false});
    EXPECT_EQ(inside.nodes, load_mesh(file, {}).nodes) << file;
    FreeMesher mesher(file, {}, {.programs = false});
    EXPECT_FALSE(mesher.curves().empty()) << file;
  }
}

}  // namespace
}  // namespace mortise
