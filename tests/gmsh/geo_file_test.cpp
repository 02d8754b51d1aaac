#include "gmsh/geo_file.hpp"

#include <gtest/gtest.h>

#include "../mesh/grid.hpp"
#include "base/errors.hpp"
#include "gmsh/load_mesh.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise {
namespace {

using test::expect_contains;
using test::message_of;
using test::TemporaryFolder;
using Names = std::vector<std::string>;

Names names_of(const std::string& file) {
  Names names;
  for (const GeoParameter& parameter : geo_parameters(file)) names.push_back(parameter.name);
  return names;
}

TEST(GeoParameters, AreTheNumbersInDefineConstant) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.geo", R"(
    DefineConstant[ n_upper = 80 ];
    DefineConstant [ n_lower = {60, Min 1, Max 99, Name "Mesh/n, [lower"}, h = f(1, 2), plain ];
    DefineConstant( angle=0.5 );
    DefineConstant[ n_upper = 7 ];
    x = 3;  // DefineConstant[ commented = 1 ];
    /* DefineConstant[ old = 1 ]; */
    text = "DefineConstant[ quoted = 1 ];";
    DefineConstant[ word = "a", choice = {"b", Name "c"}, joined = Str("d") ];
    MyDefineConstant[ other = 1 ];
  )");
  EXPECT_EQ(names_of(file), (Names{"n_upper", "n_lower", "h", "plain", "angle"}));
}

TEST(GeoParameters, ComeFromIncludedFilesToo) {
  const TemporaryFolder folder;
  folder.write("part/b.geo", "DefineConstant[ b = 1 ];\nInclude \"c.geo\";\nInclude \"../a.geo\";");
  folder.write("part/c.geo", "DefineConstant[ c = 1 ];");
  const std::string file = folder.write("a.geo", R"(
    DefineConstant[ a = 1 ];
    Include "part/b.geo";
    // Include "part/none.geo";
    Include "missing.geo";
  )");
  EXPECT_EQ(names_of(file), (Names{"a", "b", "c"}));
}

TEST(GeoParameters, OfUnfinishedTextDoNotHang) {
  const TemporaryFolder folder;
  for (const char* text : {"", "DefineConstant", "DefineConstant[", "DefineConstant[ a = {1,", "\"", "/*", "Include \"",
                           "DefineConstant[ a = \"", "//"}) {
    EXPECT_NO_THROW(geo_parameters(folder.write("a.geo", text))) << text;
  }
}

TEST(GeoParameters, HaveTheRangesThatTheGeoGives) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.geo", R"(
    DefineConstant[ n = {7, Min 1, Max 2e2, Step 1, Name "Max 5"}, h = {1, Min 0.5*x, Max -y}, free = 3,
                    kind = {0, Choices{0="quads", 1="triangles"}}, order = {2, Choices{1, 2}} ];
  )");
  const std::vector<GeoParameter> parameters = geo_parameters(file);
  ASSERT_EQ(parameters.size(), 5U);
  EXPECT_EQ(parameters[0].min, 1.0);
  EXPECT_EQ(parameters[0].max, 200.0);
  for (const int i : {1, 2}) EXPECT_FALSE(parameters[i].min || parameters[i].max) << parameters[i].name;
  EXPECT_EQ(parameters[3].choices, (std::vector<double>{0, 1}));
  EXPECT_EQ(parameters[4].choices, (std::vector<double>{1, 2}));
}

TEST(GeoParameters, OutsideTheirRangeAreRefused) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.geo", "DefineConstant[ n = {7, Min 1, Max 9}, kind = {0, Choices{0, 1}} ];");
  const auto message = [&](const std::string& name, double value) {
    return message_of([&] { check_geo(file, {{name, value}}); });
  };
  EXPECT_EQ(message("n", -3), file + ": parameter 'n' = -3: expected at least 1, as its DefineConstant says");
  test::expect_contains(message("n", 10), "expected at most 9");
  test::expect_contains(message("kind", 2), "expected 0 or 1");
  for (const double good : {1.0, 9.0}) EXPECT_NO_THROW(check_geo(file, {{"n", good}}));
}

TEST(GeoParameters, EveryGeoOfOursRefusesANumberOfElementsThatCannotBe) {
  const std::string geo = std::string(MORTISE_SOURCE_DIR) + "/geo/";
  for (const auto& entry : std::filesystem::directory_iterator(geo)) {
    if (entry.path().extension() != ".geo") continue;
    for (const GeoParameter& parameter : geo_parameters(entry.path())) {
      if (!parameter.name.starts_with("n_")) continue;
      for (const double count : {-3.0, 0.0, 7.5})
        expect_contains(message_of([&] {
                          load_mesh(entry.path().string(), {{parameter.name, count}});
                        }),
                        "expected a whole number of elements, at least 1");
    }
  }
}

TEST(GeoInputs, AreAllFilesThatItReads) {
  const TemporaryFolder folder;
  folder.write("part/b.geo", "Merge \"c.msh\";");
  const std::string file = folder.write("a.geo", "Include 'part/b.geo';\nMerge StrCat(\"x\", \"y\");");
  EXPECT_EQ(geo_inputs(file),
            (std::vector<std::filesystem::path>{file, folder.path("part/b.geo"), folder.path("part/c.msh")}));
}

}  // namespace
}  // namespace mortise
