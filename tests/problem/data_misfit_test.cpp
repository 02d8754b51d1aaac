#include "problem/data_misfit.hpp"

#include <gtest/gtest.h>

#include "support/two_plates.hpp"

namespace mortise::test {
namespace {

Field field_of(const std::string& text) { return {text, {.key = "boundary.0", .on_curve = true}}; }

DataMisfits on_top(BoundaryCondition what) {
  const Mesh mesh = mesh_of({});
  Entries entries;
  entries.boundaries = boundary_entries({{.key = "boundary.0", .on = {"top"}, .what = std::move(what)}}, mesh,
                                        SideTable(mesh), SceneNames(mesh));
  entries.body_force_of = entries.initial_strain_of = std::vector<int>(mesh.bodies.size(), -1);
  return data_misfits(entries, mesh, {});
}

DataMisfits of_pressure(const std::string& text) { return on_top(Pressure{field_of(text)}); }

TEST(DataMisfits, AreNoneOfWhatTheMeshResolves) {
  EXPECT_TRUE(of_pressure("1 + x - x^2").parts.empty());
  EXPECT_TRUE(of_pressure("1 + x - x^2").entries.empty());
}

// Plates of seven edges, 0.8 / 7 = 0.114 each: the step lies 0.82 along the fourth.
TEST(DataMisfits, NameEntryPlaceAndSizeOfAStep) {
  const DataMisfits found = of_pressure("x < 0.437 ? 1 : 3");
  ASSERT_EQ(found.parts.size(), 1u);
  ASSERT_EQ(found.entries.size(), 1u);
  const EntryMisfit& entry = found.entries[0];
  EXPECT_EQ(entry.key, "boundary.0.pressure");
  EXPECT_NEAR(entry.at.x(), 0.437, 1e-3);
  EXPECT_NEAR(entry.at.y(), 0.6, 1e-12);
  EXPECT_NEAR(entry.size, 0.8 / 7, 1e-12);
  EXPECT_LT(entry.finest, 1e-6);
  // At most the step's 2 on a part of the edge of 0.8 / 7, of a mean of about 2 over 0.8.
  EXPECT_GT(entry.part, 0.005);
  EXPECT_LT(entry.part, 2. / 7 / 2);
}

TEST(DataMisfits, OfADisplacementHaveNoMean) {
  const DataMisfits found = on_top(Displacement{{}, field_of("x < 0.437 ? 1 : 3")});
  ASSERT_EQ(found.parts.size(), 1u);
  EXPECT_LT(found.parts[0].mean.norm(), 1e-8);
  EXPECT_GT(found.parts[0].size, 0.01);
}

}  // namespace
}  // namespace mortise::test
