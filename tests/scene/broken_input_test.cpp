// One row a mistake that a user can make: every message is one line that names the file, the place and the remedy.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <regex>

#include "base/errors.hpp"
#include "broken_rows.hpp"
#include "scene/scene.hpp"
#include "scene_files.hpp"
#include "support/messages.hpp"

namespace mortise {
namespace {

using test::Row;
using test::TemporaryFolder;

std::string one_line(std::string text) {
  const std::size_t at = text.find('\n');
  return at == std::string::npos ? text : text.replace(at, 1, "\\n");
}

std::string message_of(const std::string& path, const std::vector<Override>& overrides) {
  return test::message_of([&] { read_scene(path, overrides); });
}

// FILE:LINE:COLUMN: as FILE:LINE:.
std::string without_column(const std::string& text) {
  static const std::regex column(R"((\.toml:\d+):\d+: )");
  return std::regex_replace(text, column, "$1: ");
}

class BrokenInput : public testing::TestWithParam<Row> {
 protected:
  BrokenInput() {
    folder_.write("plates.geo", "");
    folder_.write("plates.msh", "");
    std::filesystem::create_directory(folder_.path("folder.geo"));
  }

  /// The message, and in `place` how it must start.
  std::string message(const Row& row, std::string& place) const {
    place = folder_.path("scene.toml");
    if (row.good.empty()) {
      place += ": --set " + one_line(row.bad) + ": ";
      return message_of(folder_.write("scene.toml", test::every_key), {parse_override(row.bad)});
    }
    std::string text = test::every_key;
    const std::size_t at = text.find(row.good);
    if (at == std::string::npos) return "no such text in the scene: " + row.good;
    text.replace(at, row.good.size(), row.bad);
    const auto line = 1 + row.line + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    place += row.line < 0 ? ":" : ":" + std::to_string(line) + ": ";
    return message_of(folder_.write("scene.toml", text), {});
  }

  TemporaryFolder folder_;
};

TEST_P(BrokenInput, IsRefusedInOneLineThatSaysWhereAndWhy) {
  std::string place;
  const std::string text = message(GetParam(), place);
  EXPECT_TRUE(without_column(text).starts_with(place)) << text << "\nexpected it to start with " << place;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  for (const std::string& part : GetParam().expect) EXPECT_NE(text.find(part), std::string::npos) << text;
}

INSTANTIATE_TEST_SUITE_P(Scene, BrokenInput, testing::ValuesIn(test::all_rows()),
                         [](const auto& row) { return row.param.name; });

TEST(BrokenSceneFile, AnExpressionIsToldWithItsColumn) {
  const TemporaryFolder folder;
  folder.write("block.msh", "");
  const std::string entry = "[[boundary]]\non = 'top'\n";
  const auto place = [&](const std::string& line) {
    const std::string path = folder.write("scene.toml", test::shortest_scene + entry + line + "\n");
    const std::string text = message_of(path, {});
    return text.substr(path.size(), text.find(": ") - path.size());
  };
  EXPECT_EQ(place("pressure = \"2 * z\""), ":10:17");
  EXPECT_EQ(place("traction = [\"x\", '2 * z']"), ":10:23");
  EXPECT_EQ(place("pressure = \"2\\t* z\""), ":10");          // escaped: not where it would be
  EXPECT_EQ(place("pressure = \"\"\"\n2 * z\"\"\""), ":10");  // of several lines
}

TEST(BrokenSceneFile, NotThere) {
  const TemporaryFolder folder;
  folder.write("parabola_1.toml", "");
  const std::string text = message_of(folder.path("parabola1.toml"), {});
  EXPECT_EQ(text, folder.path("parabola1.toml") + ": no such file; did you mean 'parabola_1.toml'?");
}

TEST(BrokenSceneFile, IsAFolder) {
  const TemporaryFolder folder;
  EXPECT_EQ(message_of(folder.path(""), {}), folder.path("") + ": is a folder; expected a file");
}

TEST(BrokenSceneFile, IsADeviceOrAPipe) {
  const TemporaryFolder folder;
  const std::string pipe = folder.path("pipe.toml");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& path : {pipe, std::string("/dev/zero")})
    EXPECT_EQ(message_of(path, {}), path + ": is a device or a pipe; expected a file");
  const std::string geo = folder.path("pipe.geo");
  ASSERT_EQ(mkfifo(geo.c_str(), 0600), 0);
  const std::string text = message_of(folder.write("scene.toml", "mesh.file = 'pipe.geo'\n"), {});
  EXPECT_NE(text.find("pipe.geo': is a device or a pipe"), std::string::npos) << text;
}

TEST(BrokenSceneFile, IsTooLarge) {
  const TemporaryFolder folder;
  const std::string path = folder.write("scene.toml", std::string(5'000'000, '#'));
  EXPECT_EQ(message_of(path, {}).find(path + ": is larger than 4 MB"), 0u);
}

std::string dotted(int parts) {
  std::string key = "a";
  for (int i = 1; i < parts; ++i) key += i % 2 ? ".b" : " . \"c d\"";
  return key;
}

TEST(BrokenSceneFile, HasAKeyOfTwentyThousandParts) {
  const TemporaryFolder folder;
  for (const std::string& text :
       {dotted(20000) + " = 1", "[" + dotted(20000) + "]", "a = { " + dotted(20000) + " = 1 }"}) {
    const std::string path = folder.write("scene.toml", text);
    EXPECT_EQ(message_of(path, {}).find(path + ": a key of more than 32 parts"), 0u);
  }
  const std::string path = folder.write("scene.toml", test::every_key);
  for (const Override& change : {Override{dotted(20000), "1"}, Override{"title", "{" + dotted(20000) + "=1}"}}) {
    const std::string text = message_of(path, {change});
    EXPECT_EQ(text.find(path + ": --set "), 0u) << text;
    EXPECT_LT(text.size(), 2000u);
  }
}

TEST(BrokenSceneFile, HasListsInOneAnotherWithoutEnd) {
  const TemporaryFolder folder;
  const std::string path = folder.write("scene.toml", "a = " + std::string(20000, '[') + std::string(20000, ']'));
  EXPECT_EQ(message_of(path, {}).find(path + ":1: not valid TOML"), 0u);
}

TEST(BrokenSceneFile, DotsInProseAreNoKey) {
  const TemporaryFolder folder;
  std::string prose = "# " + std::string(300, '.') + "\n#";
  for (int i = 0; i < 60; ++i) prose += " One sentence.";
  const std::string path = folder.write("scene.toml", prose + "\n" + std::string(test::every_key));
  EXPECT_EQ(message_of(path, {}).find("32 parts"), std::string::npos);
}

TEST(BrokenSceneFile, HasDomainDecompositionWithoutAPair) {
  const TemporaryFolder folder;
  folder.write("block.msh", "");
  const std::string path = folder.write("scene.toml", test::shortest_scene);
  EXPECT_EQ(message_of(path, {{"method.kind", "ddm"}})
                .find(path + ": --set method.kind=ddm: method.kind: domain decomposition needs a [[contact]]"),
            0u);
}

TEST(BrokenSceneFile, IsAMesh) {
  const TemporaryFolder folder;
  const std::string path = folder.write("plates.geo", "Point(1) = {0, 0, 0};");
  EXPECT_EQ(message_of(path, {}).find(path + ": this is a geometry or a mesh; expected a scene file"), 0u);
}

TEST(BrokenSceneFile, IsEmpty) {
  const TemporaryFolder folder;
  const std::string path = folder.write("scene.toml", "");
  EXPECT_EQ(message_of(path, {}).find(path + ": 'mesh' is missing; expected a table [mesh]"), 0u);
}

TEST(BrokenSceneFile, IsBinary) {
  const TemporaryFolder folder;
  const std::string path = folder.write("scene.toml", std::string("\x7f"
                                                                  "ELF\0\0\xff\xfe",
                                                                  8));
  EXPECT_EQ(message_of(path, {}).find(path + ":1: not valid TOML"), 0u);
}

TEST(BrokenSceneFile, HasParametersThatAnOverrideMakesUseless) {
  const TemporaryFolder folder;
  const std::string msh = folder.write("plates.msh", "");
  const std::string path = folder.write("scene.toml", test::every_key);
  EXPECT_EQ(message_of(path, {{"mesh.file", msh}}).find(path + ": --set mesh.file=" + msh + ": mesh.parameters"), 0u);
}

TEST(BrokenSceneFile, HasNoMaterialsOrBodies) {
  const TemporaryFolder folder;
  folder.write("block.msh", "");
  const std::string mesh = "mesh.file = 'block.msh'\n";
  EXPECT_NE(message_of(folder.write("a.toml", mesh), {}).find("'materials' is missing"), std::string::npos);
  const std::string material = "materials.steel = { young = 1, poisson = 0 }\n";
  EXPECT_NE(message_of(folder.write("b.toml", mesh + material), {}).find("'bodies' is missing"), std::string::npos);
}

TEST(BrokenSceneFile, HasNoEntriesForAnOverride) {
  const TemporaryFolder folder;
  folder.write("block.msh", "");
  const std::string path = folder.write("scene.toml", test::shortest_scene);
  EXPECT_EQ(message_of(path, {{"boundary.0.pressure", "1"}}),
            path + ": --set boundary.0.pressure=1: boundary: no entry with index 0; there are 0 entries");
  EXPECT_EQ(message_of(path, {{"contact.condition", "bilateral"}}),
            path +
                ": --set contact.condition=bilateral: contact: expected an index, found 'condition'; "
                "there are 0 entries");
}

}  // namespace
}  // namespace mortise
