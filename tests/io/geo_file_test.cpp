#include "io/geo_file.hpp"

#include <gtest/gtest.h>

#include "../mesh/grid.hpp"
#include "base/errors.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise {
namespace {

using test::TemporaryFolder;
using Names = std::vector<std::string>;

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
  EXPECT_EQ(geo_parameters(file), (Names{"n_upper", "n_lower", "h", "plain", "angle"}));
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
  EXPECT_EQ(geo_parameters(file), (Names{"a", "b", "c"}));
}

TEST(GeoParameters, OfUnfinishedTextDoNotHang) {
  const TemporaryFolder folder;
  for (const char* text : {"", "DefineConstant", "DefineConstant[", "DefineConstant[ a = {1,", "\"", "/*", "Include \"",
                           "DefineConstant[ a = \"", "//"}) {
    EXPECT_NO_THROW(geo_parameters(folder.write("a.geo", text))) << text;
  }
}

TEST(GeoParameters, RefuseTheExitCommand) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.geo", "// Exit;\nx = \"Exit\";\nExit;\n");
  const std::string message = test::message_of<InputError>([&] { geo_parameters(file); });
  EXPECT_EQ(message, file + ", line 3: the command Exit would end the program; remove it");
}

}  // namespace
}  // namespace mortise
