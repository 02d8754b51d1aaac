// Tests keep their meshes in a folder of their own, never in the user's.
#include <cstdlib>
#include <optional>

#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

class OwnCache : public testing::Environment {
 public:
  void SetUp() override {
    folder_.emplace();
    setenv("XDG_CACHE_HOME", folder_->path().c_str(), 1);
  }
  void TearDown() override { folder_.reset(); }

 private:
  std::optional<TemporaryFolder> folder_;
};

[[maybe_unused]] const auto* const own_cache = testing::AddGlobalTestEnvironment(new OwnCache);

}  // namespace
}  // namespace mortise::test
