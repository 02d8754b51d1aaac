#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "scene/scene.hpp"
#include "scene_files.hpp"

namespace mortise {
namespace {

using test::TemporaryFolder;

Scene read_with(const std::vector<std::string>& settings, const std::string& text = test::every_key) {
  const TemporaryFolder folder;
  folder.write("plates.geo", "");
  folder.write("block.msh", "");
  std::vector<Override> overrides;
  for (const std::string& setting : settings) overrides.push_back(parse_override(setting));
  return read_scene(folder.write("scene.toml", text), overrides);
}

TEST(ParseOverride, SplitsAtTheFirstEqualsSign) {
  const Override plain = parse_override("method.kind=ddm");
  EXPECT_EQ(plain.key, "method.kind");
  EXPECT_EQ(plain.value, "ddm");
  EXPECT_EQ(parse_override("boundary.0.displacement={x=0}").value, "{x=0}");
  EXPECT_EQ(parse_override("title = a b ").value, "a b");
  EXPECT_EQ(parse_override("title=").value, "");
}

TEST(ParseOverride, RefusesTextThatIsNoPair) {
  EXPECT_THROW(parse_override("method.kind"), InputError);
  EXPECT_THROW(parse_override("=ddm"), InputError);
  EXPECT_THROW(parse_override(" = ddm"), InputError);
  EXPECT_THROW(parse_override(""), InputError);
}

TEST(Overrides, NumbersWordsListsAndTables) {
  const Scene scene = read_with({"method.kind=mortar", "method.multipliers=\"linear\"", "mesh.parameters.n_upper=40",
                                 "materials.steel.young=70e9", "boundary.2.pressure=5e6", "boundary.3.traction=[3, 4]",
                                 "boundary.1.displacement={y=1}", "title=Two plates, bent"});
  EXPECT_EQ(scene.method.solver, std::nullopt);
  EXPECT_EQ(scene.method.multipliers, Multipliers::linear);
  EXPECT_EQ(scene.mesh_parameters.at("n_upper"), 40);
  EXPECT_EQ(scene.mesh_parameters.at("height"), 0.25);
  EXPECT_EQ(scene.materials.at("steel").young, 70e9);
  EXPECT_EQ(std::get<Pressure>(scene.boundaries[2].what).value, 5e6);
  EXPECT_EQ(std::get<SurfaceTraction>(scene.boundaries[3].what).value, Vec2(3, 4));
  EXPECT_FALSE(std::get<Displacement>(scene.boundaries[1].what).x);
  EXPECT_EQ(std::get<Displacement>(scene.boundaries[1].what).y, 1);
  EXPECT_EQ(scene.title, "Two plates, bent");
}

TEST(Overrides, CreateWhatIsMissing) {
  const TemporaryFolder folder;
  const Scene scene = read_with({"model.plane=stress", "method.kind=ddm", "mesh.file=" + folder.write("new.geo", ""),
                                 "mesh.parameters.new=3", "materials.brass.young=1e11", "materials.brass.poisson=0.35",
                                 "bodies.other=brass", "contact=[{between=['a', 'b']}]", "contact.condition=bilateral"},
                                test::shortest_scene);
  EXPECT_EQ(scene.model.plane, Plane::stress);
  EXPECT_EQ(scene.method.solver, Solver::ddm);
  EXPECT_EQ(scene.mesh_parameters.at("new"), 3);
  EXPECT_EQ(scene.bodies.at(1).material, "brass");
  EXPECT_EQ(scene.contacts.at(0).condition, Condition::bilateral);
}

TEST(Overrides, ContactWithoutIndexMeansEveryPair) {
  const Scene scene = read_with({"contact.initial_gap=closed", "contact.1.condition=bilateral"});
  EXPECT_EQ(scene.contacts[0].initial_gap, InitialGap::closed);
  EXPECT_EQ(scene.contacts[1].initial_gap, InitialGap::closed);
  EXPECT_EQ(scene.contacts[0].condition, Condition::bilateral);
  EXPECT_EQ(scene.contacts[1].condition, Condition::bilateral);
  EXPECT_EQ(scene.contacts[1].multipliers_on, "");
}

TEST(Overrides, TheLastOneWins) {
  const Scene scene = read_with({"contact.0.multipliers_on=lower_contact", "contact.0.multipliers_on=upper_contact"});
  EXPECT_EQ(scene.contacts[0].multipliers_on, "upper_contact");
}

TEST(Overrides, QuotedPartsMayHoldDots) {
  EXPECT_EQ(read_with({"bodies.\"plate.2\"=steel"}).bodies.back().name, "plate.2");
}

TEST(Overrides, ALineBreakCannotSetASecondKey) {
  EXPECT_EQ(read_with({"title=1\nmethod.kind='mortar'"}).title, "1\nmethod.kind='mortar'");
}

TEST(Overrides, MeshFileIsRelativeToTheWorkingDirectory) {
  const TemporaryFolder folder;
  const std::string mesh = std::filesystem::relative(folder.write("other.geo", "")).string();
  EXPECT_EQ(read_with({"mesh.file=" + mesh}).mesh_file, mesh);
}

TEST(Overrides, ABodyMayLeaveItsMaterialUnused) {
  EXPECT_EQ(read_with({"bodies.upper=brass", "bodies.base=brass"}).bodies[0].material, "brass");
}

TEST(Overrides, EntriesSetOnTheCommandLineSaySo) {
  const Scene scene = read_with({"boundary=[{on='top', pressure=1}]"});
  EXPECT_EQ(scene.boundaries.at(0).key, "boundary.0 (--set boundary=[{on='top', pressure=1}])");
}

}  // namespace
}  // namespace mortise
