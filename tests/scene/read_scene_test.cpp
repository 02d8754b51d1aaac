// Expected values: exact, they stand in the scene text of scene_files.hpp.
#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "scene/scene.hpp"
#include "scene_files.hpp"

namespace mortise {
namespace {

using test::TemporaryFolder;

class EveryKey : public testing::Test {
 protected:
  EveryKey() {
    folder_.write("plates.geo", "");
    scene_ = read_scene(folder_.write("scene.toml", test::every_key));
  }
  TemporaryFolder folder_;
  Scene scene_;
};

TEST_F(EveryKey, MeshAndModel) {
  EXPECT_EQ(scene_.path, folder_.path("scene.toml"));
  EXPECT_EQ(scene_.title, "Every key");
  EXPECT_EQ(scene_.mesh_file, folder_.path("plates.geo"));
  EXPECT_EQ(scene_.mesh_parameters, (std::map<std::string, double>{{"height", 0.25}, {"n_upper", 80}}));
  EXPECT_EQ(scene_.model.plane, Plane::stress);
}

TEST_F(EveryKey, MaterialsAndBodiesInTheOrderOfTheFile) {
  ASSERT_EQ(scene_.materials.size(), 2u);
  EXPECT_EQ(scene_.materials["steel"].young, 210e9);
  EXPECT_EQ(scene_.materials["steel"].poisson, 0.3);
  EXPECT_EQ(scene_.materials["steel"].thermal_expansion, 0);
  EXPECT_EQ(scene_.materials["brass"].thermal_expansion, 19e-6);
  ASSERT_EQ(scene_.bodies.size(), 3u);
  EXPECT_EQ(scene_.bodies[0].name, "upper");
  EXPECT_EQ(scene_.bodies[0].material, "steel");
  EXPECT_EQ(scene_.bodies[1].name, "lower");
  EXPECT_EQ(scene_.bodies[1].material, "brass");
  EXPECT_EQ(scene_.bodies[2].name, "base");
}

TEST_F(EveryKey, Boundaries) {
  ASSERT_EQ(scene_.boundaries.size(), 4u);
  const auto& [symmetry, bottom, top, right] =
      std::tie(scene_.boundaries[0], scene_.boundaries[1], scene_.boundaries[2], scene_.boundaries[3]);
  EXPECT_EQ(symmetry.key, "boundary.0 (line 24)");
  EXPECT_EQ(symmetry.on, (std::vector<std::string>{"upper_left", "lower_left"}));
  EXPECT_EQ(std::get<Displacement>(symmetry.what).x, 0);
  EXPECT_FALSE(std::get<Displacement>(symmetry.what).y);
  EXPECT_EQ(bottom.on, std::vector<std::string>{"bottom"});
  EXPECT_EQ(std::get<Displacement>(bottom.what).x, 0.001);
  EXPECT_EQ(std::get<Displacement>(bottom.what).y, -0.002);
  EXPECT_EQ(std::get<Pressure>(top.what).value, 10e6);
  EXPECT_EQ(std::get<SurfaceTraction>(right.what).value, Vec2(1e6, -2e6));
}

TEST_F(EveryKey, BodyForcesAndInitialStrains) {
  ASSERT_EQ(scene_.body_forces.size(), 1u);
  EXPECT_EQ(scene_.body_forces[0].body, "lower");
  EXPECT_EQ(scene_.body_forces[0].force, Vec2(0, -76e3));
  ASSERT_EQ(scene_.initial_strains.size(), 2u);
  EXPECT_EQ(scene_.initial_strains[0].body, "lower");
  EXPECT_EQ(scene_.initial_strains[0].temperature_change, 50);
  EXPECT_EQ(scene_.initial_strains[0].strain, (std::array<Field, 4>{}));
  EXPECT_EQ(scene_.initial_strains[1].body, "upper");
  EXPECT_FALSE(scene_.initial_strains[1].temperature_change);
  EXPECT_EQ(scene_.initial_strains[1].strain, (std::array<Field, 4>{1e-3, 2e-3, 4e-3, 3e-3}));  // 11, 22, 33, 12
}

TEST_F(EveryKey, ContactsAndMethod) {
  ASSERT_EQ(scene_.contacts.size(), 2u);
  EXPECT_EQ(scene_.contacts[0].key, "contact.0 (line 52)");
  EXPECT_EQ(scene_.contacts[0].between, (std::array<std::string, 2>{"upper_contact", "lower_contact"}));
  EXPECT_EQ(scene_.contacts[0].condition, Condition::bilateral);
  EXPECT_EQ(scene_.contacts[0].initial_gap, InitialGap::closed);
  EXPECT_EQ(scene_.contacts[0].multipliers_on, "lower_contact");
  EXPECT_EQ(scene_.contacts[1].condition, Condition::unilateral);
  EXPECT_EQ(scene_.contacts[1].initial_gap, InitialGap::curve);
  EXPECT_EQ(scene_.contacts[1].multipliers_on, "");
  EXPECT_EQ(scene_.method.solver, Solver::ddm);
  EXPECT_EQ(scene_.method.integration, Integration::elements);
  EXPECT_EQ(scene_.method.multipliers, Multipliers::dual);
}

TEST(Materials, OrthotropicOnesAndAnyStiffness) {
  const auto steel = [](const std::string& material) {
    const TemporaryFolder folder;
    folder.write("block.msh", "");
    return read_scene(folder.write("a.toml",
                                   "mesh.file = 'block.msh'\nbodies.block = 'steel'\nboundary = [{ on = 'top', "
                                   "pressure = 2 }]\n[materials.steel]\n" +
                                       material))
        .materials.at("steel");
  };
  const Material wood = steel("young = [12e9, 1e9, 0.8e9]\npoisson = [0.4, 0.35, 0.5]\nshear = 0.7e9\nangle = 30\n");
  EXPECT_EQ(wood.young, 12e9);
  EXPECT_NEAR(wood.moduli->angle, 0.5235987755982988, 1e-15);
  EXPECT_EQ(*wood.stiffness, *orthotropic_stiffness(*wood.moduli));
  const Material any = steel("stiffness = [[4, 1, 1, 0.5], [1, 3, 1, 0], [1, 1, 2, 0], [0.5, 0, 0, 1]]\n");
  EXPECT_EQ((*any.stiffness)(0, 3), 0.5);
  EXPECT_EQ(any.young, 4);
}

TEST(ReadScene, WhatTheFileLeavesOutTakesItsDefault) {
  const TemporaryFolder folder;
  folder.write("block.msh", "");
  const Scene scene = read_scene(folder.write("scene.toml", test::shortest_scene));
  EXPECT_EQ(scene.title, "");
  EXPECT_TRUE(scene.mesh_parameters.empty());
  EXPECT_EQ(scene.model.plane, Plane::strain);
  EXPECT_TRUE(scene.boundaries.empty() && scene.body_forces.empty());
  EXPECT_TRUE(scene.initial_strains.empty() && scene.contacts.empty());
  EXPECT_EQ(scene.method.solver, std::nullopt);
  EXPECT_EQ(scene.method.integration, Method{}.integration);
  EXPECT_EQ(scene.method.multipliers, Method{}.multipliers);
}

TEST(ReadScene, DifferentThingsOnOneCurveAreFine) {
  const TemporaryFolder folder;
  folder.write("block.msh", "");
  const std::string text = test::shortest_scene + R"(
[[boundary]]
on = "top"
displacement = { x = 0 }
[[boundary]]
on = "top"
pressure = 1e6
[[boundary]]
on = "top"
displacement = { y = 0 }
)";
  EXPECT_EQ(read_scene(folder.write("scene.toml", text)).boundaries.size(), 3u);
}

TEST(ReadScene, TomlMayBeWrittenInAnyOfItsForms) {
  const TemporaryFolder folder;
  folder.write("block.msh", "");
  const std::string text =
      "mesh.file = 'block.msh'\r\nmaterials = { steel = { young = 2_000, poisson = 0 } }\r\n"
      "bodies.\"the block\" = \"steel\"\r\nboundary = [{ on = ['a',\r\n 'b'], pressure = -1 }]\r\n";
  const Scene scene = read_scene(folder.write("scene.toml", "\xEF\xBB\xBF" + text));
  EXPECT_EQ(scene.bodies[0].name, "the block");
  EXPECT_EQ(scene.materials.at("steel").young, 2000);
  EXPECT_EQ(std::get<Pressure>(scene.boundaries[0].what).value, -1);
}

TEST(ReadScene, WordsOfTheEnums) {
  EXPECT_EQ(to_string(Plane::strain) + to_string(Plane::stress), "strainstress");
  EXPECT_EQ(to_string(Condition::unilateral) + to_string(Condition::bilateral), "unilateralbilateral");
  EXPECT_EQ(to_string(InitialGap::measured) + to_string(InitialGap::closed), "measuredclosed");
  EXPECT_EQ(to_string(Solver::direct) + to_string(Solver::mssor) + to_string(Solver::ddm), "directmssorddm");
  EXPECT_EQ(to_string(Integration::segments) + to_string(Integration::elements), "segmentselements");
  EXPECT_EQ(to_string(Multipliers::quadratic) + to_string(Multipliers::linear) + to_string(Multipliers::dual),
            "quadraticlineardual");
}

}  // namespace
}  // namespace mortise
