#include "gmsh/mesh_cache.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>

#include "gmsh/load_mesh.hpp"
#include "support/temporary_folder.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;
using test::text_of;

const std::string disc_geo = R"(
DefineConstant[ r = 1 ];
Include "size.geo";
Point(1) = {0, 0, 0}; Point(2) = {r, 0, 0, h}; Point(3) = {-r, 0, 0, h};
Point(4) = {0.2 * r, -0.8 * r, 0, h}; Circle(1) = {2, 1, 3}; Spline(2) = {3, 4, 2};  // one has a knot
Curve Loop(1) = {1, 2}; Plane Surface(1) = {1};
Mesh.ElementOrder = 2;
Physical Surface("disc", 5) = {1}; Physical Curve("upper", 6) = {1}; Physical Curve("lower", 7) = {2};
)";

/// With the cache on and in a folder of its own.
class MeshCache : public testing::Test {
 protected:
  MeshCache() {
    setenv("XDG_CACHE_HOME", cache_.path().c_str(), 1);
    set_mesh_cache(true);
    folder_.write("size.geo", "h = 0.3;\n");
    folder_.write("disc.geo", disc_geo);
  }
  ~MeshCache() override {
    set_mesh_cache(false);
    setenv("XDG_CACHE_HOME", before_.c_str(), 1);
  }

  /// Whether the mesh was a kept one.
  bool kept(const std::map<std::string, double>& parameters = {}, const std::string& file = "disc.geo") {
    bool cached = false;
    mesh_ = load_mesh(folder_.path(file), parameters, {}, &cached);
    return cached;
  }
  std::vector<fs::path> entries() const {
    std::vector<fs::path> found;
    if (fs::exists(cache_.path() / "mortise"))
      for (const auto& entry : fs::directory_iterator(cache_.path() / "mortise")) found.push_back(entry.path());
    return found;
  }

  const std::string before_ = std::getenv("XDG_CACHE_HOME");
  const TemporaryFolder folder_, cache_;
  Mesh mesh_;
};

bool same(const EdgeSamples& a, const EdgeSamples& b) {
  const auto same_piece = [](const SamplePiece& p, const SamplePiece& q) {
    return p.end == q.end && p.places == q.places;
  };
  return a.misfit == b.misfit && std::ranges::equal(a.pieces, b.pieces, same_piece);
}

void expect_same(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.nodes, b.nodes);
  ASSERT_EQ(a.cells.size(), b.cells.size());
  for (std::size_t e = 0; e < a.cells.size(); ++e) EXPECT_EQ(a.cells[e].nodes, b.cells[e].nodes);
  EXPECT_EQ(a.bodies, b.bodies);
  ASSERT_EQ(a.boundaries.size(), b.boundaries.size());
  for (std::size_t k = 0; k < a.boundaries.size(); ++k) {
    EXPECT_EQ(a.boundaries[k].name, b.boundaries[k].name);
    EXPECT_TRUE(std::ranges::equal(a.boundaries[k].samples, b.boundaries[k].samples, same));
    EXPECT_FALSE(a.boundaries[k].samples.empty()) << "an arc is drawn";
  }
  EXPECT_EQ(a.source, b.source);
}

TEST_F(MeshCache, KeepsMeshAndDrawnCurves) {
  EXPECT_FALSE(kept());
  const Mesh made = mesh_;
  EXPECT_TRUE(kept());
  expect_same(made, mesh_);
  EXPECT_EQ(entries().size(), 1U);
}

TEST_F(MeshCache, KnowsParametersAndIncludedFiles) {
  EXPECT_FALSE(kept());
  EXPECT_FALSE(kept({{"r", 2}}));
  EXPECT_TRUE(kept({{"r", 2}}));
  EXPECT_TRUE(kept());
  folder_.write("size.geo", "h = 0.2;\n");
  const auto nodes = mesh_.nodes.rows();
  EXPECT_FALSE(kept());
  EXPECT_GT(mesh_.nodes.rows(), nodes);
  folder_.write("disc.geo", disc_geo + "Mesh.ElementOrder = 1;\n");
  EXPECT_FALSE(kept());
}

TEST_F(MeshCache, SwitchedOffNeitherReadsNorWrites) {
  EXPECT_FALSE(kept());
  set_mesh_cache(false);
  EXPECT_FALSE(kept());
  EXPECT_FALSE(kept({{"r", 2}}));
  EXPECT_EQ(entries().size(), 1U);
}

TEST_F(MeshCache, WhatIsDamagedIsMadeAgain) {
  EXPECT_FALSE(kept());
  const Mesh made = mesh_;
  const fs::path entry = entries().at(0);
  const std::string whole = text_of(entry);
  const auto expect_made_again = [&](const std::string& text) {
    std::ofstream(entry, std::ios::binary) << text;
    EXPECT_FALSE(kept());
    expect_same(made, mesh_);
    EXPECT_TRUE(kept());
  };
  for (const std::size_t size : {std::size_t(0), std::size_t(5), std::size_t(8), whole.size() / 2, whole.size() - 1})
    expect_made_again(whole.substr(0, size));
  for (const std::size_t at : {std::size_t(0), std::size_t(9), whole.size() / 2, whole.size() - 1}) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    expect_made_again(changed);
  }
}

TEST_F(MeshCache, AnEntryIsKnownByItsKeyNotByItsName) {
  EXPECT_FALSE(kept());
  const fs::path entry = entries().at(0), moved = folder_.path("moved.mesh");
  fs::rename(entry, moved);
  EXPECT_FALSE(kept({{"r", 2}}));
  const Mesh made = mesh_;
  fs::rename(moved, entries().at(0));  // as of two keys with one hash
  EXPECT_FALSE(kept({{"r", 2}}));
  expect_same(made, mesh_);
}

TEST_F(MeshCache, WithoutAFolderThereIsNone) {
  setenv("XDG_CACHE_HOME", "/proc/no/such", 1);
  EXPECT_FALSE(kept());
  EXPECT_FALSE(kept());
  setenv("XDG_CACHE_HOME", folder_.write("a file", "").c_str(), 1);
  EXPECT_FALSE(kept());
  EXPECT_FALSE(kept());
}

TEST_F(MeshCache, AGeometryThatLooksOutsideIsNotKept) {
  for (const std::string line : {"x = Rand(1);", "Printf(Today);", "x = GetEnv(\"HOME\");",
                                 "name = \"size.geo\"; Include Str(name);", "x() = ListFromFile(\"size.geo\");"}) {
    folder_.write("disc.geo", disc_geo + line + "\n");
    EXPECT_FALSE(mesh_key(folder_.path("disc.geo"), {})) << line;
  }
  EXPECT_FALSE(mesh_key(folder_.path("none.geo"), {}));
}

TEST_F(MeshCache, AGeometryThatRunsAProgramIsNotKept) {
  for (const std::string line : {"SystemCall \"true\";", "If (0)\n x = Str(\" EndIf System 'true'; //\");\nEndIf"}) {
    folder_.write("disc.geo", disc_geo + line + "\n");
    EXPECT_FALSE(kept()) << line;
    EXPECT_FALSE(kept()) << line;
    EXPECT_TRUE(entries().empty()) << line;
  }
}

TEST_F(MeshCache, AnEntryThatIsNoFileOfOnesOwnIsNotRead) {
  EXPECT_FALSE(kept());
  const fs::path entry = entries().at(0), moved = folder_.path("moved.mesh");
  fs::rename(entry, moved);
  fs::create_symlink(moved, entry);
  EXPECT_FALSE(kept()) << "a link";
  EXPECT_TRUE(kept()) << "which is replaced";
  fs::remove(entry);
  ASSERT_EQ(mkfifo(entry.c_str(), 0600), 0);
  EXPECT_FALSE(kept()) << "a pipe would never end";
  EXPECT_TRUE(kept());
  fs::remove(entry);
  fs::create_directory(entry);
  EXPECT_FALSE(kept()) << "a folder";
  EXPECT_EQ(entries().size(), 1U) << "nothing is left beside it";
}

TEST_F(MeshCache, TheOldestGoFirst) {
  EXPECT_FALSE(kept());
  EXPECT_FALSE(kept({{"r", 2}}));
  fs::create_directory(cache_.path() / "mortise" / "no file");
  const fs::path large = cache_.path() / "mortise" / "large.mesh";
  std::ofstream(large) << "";
  fs::resize_file(large, 511 << 20);
  fs::last_write_time(large, fs::file_time_type::clock::now() - std::chrono::hours(2));
  EXPECT_TRUE(kept());
  EXPECT_FALSE(kept({{"r", 3}}));
  EXPECT_TRUE(fs::exists(large)) << "512 MB are not full yet";
  fs::resize_file(large, 512 << 20);
  fs::last_write_time(large, fs::file_time_type::clock::now() - std::chrono::hours(2));
  EXPECT_FALSE(kept({{"r", 4}}));
  EXPECT_FALSE(fs::exists(large));
  EXPECT_TRUE(kept({{"r", 2}}));
}

}  // namespace
}  // namespace mortise
