// Tests keep their meshes in a folder of their own, never in the user's: the one that all processes of a run share, or
// one of this process. The tests of gmsh/ mesh everything anew.
#include <cstdlib>
#include <optional>
#include <string>

#include "gmsh/mesh_cache.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

class OwnCache : public testing::Environment {
 public:
  void SetUp() override {
    const char* const shared = std::getenv("MORTISE_TESTS_CACHE");
    if (!shared) folder_.emplace();
    setenv("XDG_CACHE_HOME", shared ? shared : folder_->path().c_str(), 1);
  }
  void TearDown() override { folder_.reset(); }

 private:
  std::optional<TemporaryFolder> folder_;
};

class CachesMeshes : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo& test) override {
    set_mesh_cache(std::string(test.file()).find("/gmsh/") == std::string::npos);
  }
};

[[maybe_unused]] const auto* const own_cache = testing::AddGlobalTestEnvironment(new OwnCache);
[[maybe_unused]] const bool listens = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new CachesMeshes);
  return true;
}();

}  // namespace
}  // namespace mortise::test
