// The table of keys: the pages made from it, and the ranges of scenes that no file gave.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>

#include "base/errors.hpp"
#include "scene/check_ranges.hpp"
#include "scene/scene_files.hpp"
#include "scene/schema.hpp"
#include "support/messages.hpp"

namespace mortise::test {
namespace {

std::string page(const std::string& name) {
  std::ifstream file(std::string(MORTISE_SOURCE_DIR) + "/docs/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Where the page is not what the table says, what it should be is left in the folder of the tests.
void expect_page(bool right, const std::string& name, const std::string& text) {
  if (!right) std::ofstream(name) << text;
  EXPECT_TRUE(right) << "docs/" << name << " is not what the table of keys says (src/scene/read_*.cpp); its text is in "
                     << std::filesystem::current_path() / name;
}

TEST(Keys, TheSchemaIsMadeOfThem) {
  const std::string schema = scene_file::scene_schema();
  expect_page(page("scene.schema.json") == schema, "scene.schema.json", schema);
}

TEST(Keys, TheTableOfFilesIsMadeOfThem) {
  const std::string table = "| key | value | default |\n|---|---|---|\n" + scene_file::key_table() + "\n";
  expect_page(page("files.md").find(table) != std::string::npos, "files.md", table);
}

// A number that no scene file can say, written into a scene by a program.
struct Slip {
  std::string key;
  std::function<void(Scene&)> make;
};

TEST(Keys, RangesHoldForScenesOfAProgram) {
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  const std::vector<Slip> slips{
      {"materials.steel.young", [](Scene& s) { s.materials.at("steel").young = 0; }},
      {"materials.steel.young", [=](Scene& s) { s.materials.at("steel").young = infinite; }},
      {"materials.steel.poisson", [](Scene& s) { s.materials.at("steel").poisson = 0.5; }},
      {"materials.steel.poisson", [=](Scene& s) { s.materials.at("steel").poisson = nan; }},
      {"materials.steel.density", [](Scene& s) { s.materials.at("steel").density = -1; }},
      {"materials.steel.thermal_expansion", [=](Scene& s) { s.materials.at("steel").thermal_expansion = nan; }},
      {"mesh.time_limit", [](Scene& s) { s.geo_limits.seconds = 0; }},
      {"model.thickness", [](Scene& s) { s.model.thickness = -1; }},
      {"model.gravity", [=](Scene& s) { s.gravity = Vec2(0, nan); }},
      {"contact.0.within", [](Scene& s) { s.contacts.push_back({.key = "contact.0", .within = 0}); }},
      {"contact.1.within", [](Scene& s) { s.ties.push_back({.key = "contact.1", .within = -1}); }},
      {"probe.0.angle", [=](Scene& s) { s.probes.push_back({.key = "probe.0", .angle = nan}); }},
      {"method.omega", [](Scene& s) { s.method.mssor.omega = 2; }},
      {"method.beta", [](Scene& s) { s.method.ddm.beta = -0.5; }},
      {"method.tolerance",
       [](Scene& s) {
         s.method.solver = Solver::feti;
         s.method.feti.tolerance = 0;
       }},
      {"method.max_iterations",
       [](Scene& s) {
         s.method.solver = Solver::mssor;
         s.method.mssor.max_iterations = 0;
       }},
      {"accuracy.value", [](Scene& s) { s.accuracy = AccuracySpec{}; }},
      {"accuracy.first_edges", [](Scene& s) { s.accuracy = AccuracySpec{.value = 0.01, .first_edges = 1}; }},
  };
  const TemporaryFolder folder;
  folder.write("block.msh", "");
  const Scene right = read_scene(folder.write("scene.toml", shortest_scene));
  EXPECT_NO_THROW(check_ranges(right));
  for (const Slip& slip : slips) {
    Scene scene = right;
    slip.make(scene);
    EXPECT_EQ(message_of([&] { check_ranges(scene); }).find(slip.key + ": expected "), 0u) << slip.key;
    EXPECT_EQ(message_of([&] { check_ranges(scene, &right); }).find(slip.key + ": expected "), 0u) << slip.key;
  }
}

TEST(Keys, ARefusalSaysTheNumberAsItIs) {
  Scene scene;
  for (const auto& [young, words] : std::vector<std::pair<double, std::string>>{
           {-1, "-1"}, {-1e-12, "-1e-12"}, {-1e300, "-1e+300"}, {std::nan(""), "nan"}}) {
    scene.materials["steel"] = {.young = young};
    EXPECT_EQ(message_of([&] { check_ranges(scene); }), "materials.steel.young: expected a number > 0, found " + words);
  }
}

}  // namespace
}  // namespace mortise::test
