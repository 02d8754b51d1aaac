// --no-programs: what of a .geo reaches beyond the mesh.
#include "gmsh/geo_programs.hpp"

#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "gmsh/geo_file.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise {
namespace {

using test::message_of;
using test::TemporaryFolder;

TEST(GeoPrograms, CommandsThatReachBeyondTheMeshAreRefused) {
  const TemporaryFolder folder;
  for (const char* command :
       {"SystemCall \"touch proof\";", "System 'touch proof';", "NonBlockingSystemCall \"touch proof\";",
        "OnelabRun(\"a\", \"touch proof\");", "Save \"proof.msh\";", "Print \"proof.png\";",
        "Printf(\"%g\", 1) > \"proof\";", "Printf(\"a)\", 1) /* */ >> \"proof\";", "Plugin(NewView).Run;",
        "Field[1] = ExternalProcess;", "Field[1].CommandLine = \"x\"; Field[2] = ExternalProcess;",
        "Macro (\"m\", \"SystemCall 'touch proof';\")", "CreateDir \"proof\";", "Solver.Executable0 = \"x\";",
        "a = '\"'; SystemCall \"touch proof\"; b = '\"';", "Include StrCat(\"b\", \".geo\");", "Merge \"b.pos\";"}) {
    const std::string file = folder.write("a.geo", std::string("x = 1;\n") + command + "\n");
    const std::string message = message_of([&] { check_geo(file, {}, false); });
    EXPECT_TRUE(message.starts_with(file + ", line 2: ")) << command << ": " << message;
    EXPECT_TRUE(message.ends_with("--no-programs refuses it")) << command << ": " << message;
    EXPECT_NO_THROW(check_geo(file, {}, true)) << command;
  }
}

TEST(GeoPrograms, AreFoundInIncludedFilesToo) {
  const TemporaryFolder folder;
  const std::string part = folder.write("part/b.geo", "\n\nSave \"x.msh\";\n");
  const std::string file = folder.write("a.geo", "Include \"part/b.geo\";\n");
  test::expect_contains(message_of([&] { check_geo(file, {}, false); }), part + ", line 3: 'Save'");
}

TEST(GeoPrograms, AMeshThatIsNoneMayHideThem) {
  const TemporaryFolder folder;
  folder.write("b.msh", "SystemCall \"touch proof\";\n");
  folder.write("c.msh", "$MeshFormat\n");
  test::expect_contains(message_of([&] { check_geo(folder.write("a.geo", "Merge \"b.msh\";"), {}, false); }),
                        "neither");
  EXPECT_NO_THROW(check_geo(folder.write("a.geo", "Merge \"c.msh\";"), {}, false));
}

TEST(GeoPrograms, AStringThatGmshEndsEarlyIsRefused) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.geo", "a = \"" + std::string(1100, 'x') + "; SystemCall 'x'; \";");
  test::expect_contains(message_of([&] { check_geo(file, {}, false); }), "longer than 1000");
}

TEST(GeoPrograms, PlainGeometryPasses) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.geo", R"(
    // SystemCall "in a comment";
    Print.Background = 1; Save = 3; Printf("%g", 1); text = "Save SystemCall";
    Macro Body
    Return
    Mesh.SaveAll = 0;
  )");
  EXPECT_NO_THROW(check_geo(file, {}, false));
  for (const auto& entry : std::filesystem::directory_iterator(std::string(MORTISE_SOURCE_DIR) + "/geo")) {
    if (entry.path().extension() != ".geo") continue;
    EXPECT_NO_THROW(check_geo(entry.path(), {}, false)) << entry.path();
  }
}

}  // namespace
}  // namespace mortise
