#include "output/vtu.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "../mesh/grid.hpp"
#include "base/errors.hpp"
#include "mesh/curve.hpp"
#include "support/temporary_folder.hpp"

namespace mortise {
namespace {

using test::TemporaryFolder;
using testing_meshes::plate;

/// Runs a script that has `mesh`, read by meshio, and numpy as `np`; true if all its assertions hold.
bool meshio_says(const TemporaryFolder& folder, const std::string& file, const std::string& assertions) {
  const std::string script =
      folder.write("check.py", "import sys, meshio, numpy as np\nmesh = meshio.read('" + file +
                                   "')\nkinds = {b.type: len(b.data) for b in mesh.cells}\n" + assertions);
  return std::system(("/usr/bin/python3 " + script).c_str()) == 0;
}

class Vtu : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("/usr/bin/python3 -c 'import meshio' 2> /dev/null") == 0) return;
    std::cerr << "\n*** /usr/bin/python3 has no meshio: NOBODY HAS READ OUR VTU FILES. apt-get install "
                 "python3-meshio ***\n\n";
    GTEST_SKIP() << "meshio is missing";
  }
  const TemporaryFolder folder_;
  const std::string file_ = (folder_.path() / "a.vtu").string();
};

/// x + 2 y, (x, y), (x, y, x + y), (1, x, y, x y) at the points; the number of the cell at the cells.
VtuGrid with_fields(const Mesh& mesh) {
  VtuGrid grid{mesh.nodes, mesh.cells, {}, {}, {}};
  const VecX x = mesh.nodes.col(0);
  const VecX y = mesh.nodes.col(1);
  MatX three(x.size(), 3);
  three << x, y, x + y;
  MatX four(x.size(), 4);
  four << VecX::Ones(x.size()), x, y, x.cwiseProduct(y);
  grid.point_fields = {
      {"one", x + 2 * y, {}}, {"two", mesh.nodes, {}}, {"three", three, {}}, {"four", four, {"11", "22", "33", "12"}}};
  const auto cells = static_cast<Eigen::Index>(mesh.cells.size());
  grid.cell_fields = {{"number", VecX::LinSpaced(cells, 0, static_cast<double>(cells - 1)), {}}};
  return grid;
}

const char* const kFieldsHold = R"(
x, y, z = mesh.points.T
assert not z.any()
f = mesh.point_data
assert (f['one'] == x + 2 * y).all()
assert (f['two'] == np.c_[x, y, 0 * x]).all()
assert (f['three'] == np.c_[x, y, x + y]).all()
assert (f['four'] == np.c_[0 * x + 1, x, y, x * y]).all()
assert (np.concatenate(mesh.cell_data['number']) == np.arange(sum(kinds.values()))).all()
for block in mesh.cells:  # counter-clockwise corners, and each middle between its corners
    n = 3 if block.type.startswith('tri') else 4
    p = mesh.points[block.data][:, :, :2]
    area = sum(p[:, i, 0] * p[:, (i + 1) % n, 1] - p[:, i, 1] * p[:, (i + 1) % n, 0] for i in range(n)) / 2
    assert np.allclose(area, 1 if n == 4 else 0.5, rtol=0, atol=1e-15)
    if p.shape[1] > n:
        for i in range(n):
            assert (p[:, n + i] == (p[:, i] + p[:, (i + 1) % n]) / 2).all()
    if block.type == 'quad9':
        assert (p[:, 8] == (p[:, 0] + p[:, 2]) / 2).all()
)";

TEST_F(Vtu, CellsOfEveryKindAreReadByMeshio) {
  const std::vector<std::pair<CellKind, std::string>> kinds{{CellKind::tri3, "{'triangle': 12}"},
                                                            {CellKind::tri6, "{'triangle6': 12}"},
                                                            {CellKind::quad4, "{'quad': 6}"},
                                                            {CellKind::quad8, "{'quad8': 6}"},
                                                            {CellKind::quad9, "{'quad9': 6}"}};
  for (const auto& [kind, counts] : kinds) {
    write_vtu(file_, with_fields(plate(kind, 3, 2)));
    EXPECT_TRUE(meshio_says(folder_, file_, "assert kinds == " + counts + ", kinds\n" + kFieldsHold)) << counts;
  }
}

TEST_F(Vtu, MixedCellsAreReadByMeshio) {
  Mesh mesh = plate(CellKind::quad8, 3, 1);
  Mesh triangles = plate(CellKind::tri6, 2, 1);
  const int shift = static_cast<int>(mesh.nodes.rows());
  for (Cell cell : triangles.cells) {
    for (int i = 0; i < node_count(cell.kind); ++i) cell.nodes[i] += shift;
    mesh.cells.push_back(cell);
  }
  mesh.nodes.conservativeResize(shift + triangles.nodes.rows(), 2);
  mesh.nodes.bottomRows(triangles.nodes.rows()) = triangles.nodes;
  write_vtu(file_, with_fields(mesh));
  EXPECT_TRUE(meshio_says(folder_, file_, std::string("assert kinds == {'quad8': 3, 'triangle6': 4}") + kFieldsHold));
}

TEST_F(Vtu, EdgesAreReadByMeshio) {
  for (const CellKind kind : {CellKind::quad4, CellKind::quad8}) {
    const Mesh mesh = plate(kind, 4, 1);
    VtuGrid grid = with_fields(mesh);
    grid.cells.clear();
    grid.edges = contact_curve(mesh, 0).edges;
    write_vtu(file_, grid);
    EXPECT_TRUE(meshio_says(folder_, file_, R"(
(block,) = mesh.cells
assert kinds == ({'line': 4} if block.data.shape[1] == 2 else {'line3': 4}), kinds
p = mesh.points[block.data]
assert (p[:, 1, 0] - p[:, 0, 0] == 1).all() and not p[:, :, 1].any()
if p.shape[1] == 3:
    assert (p[:, 2] == (p[:, 0] + p[:, 1]) / 2).all()
assert (mesh.cell_data['number'][0] == np.arange(4)).all()
)"));
  }
}

TEST_F(Vtu, NotANumberSurvives) {
  VtuGrid grid = with_fields(plate(CellKind::quad4, 1, 1));
  grid.point_fields[0].values(2, 0) = std::nan("");
  write_vtu(file_, grid);
  EXPECT_TRUE(meshio_says(folder_, file_, "assert list(np.isnan(mesh.point_data['one'])) == [0, 0, 1, 0]"));
}

TEST(VtuFile, SaysWhatCannotBeWritten) {
  const VtuGrid grid = with_fields(plate(CellKind::quad8, 2, 2));
  EXPECT_THROW(write_vtu("/nowhere/a.vtu", grid), InputError);
  EXPECT_THROW(write_vtu("/dev/full", grid), InputError);
}

TEST(VtuFile, WithoutCellsIsWrittenAllTheSame) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(write_vtu(folder.path() / "a.vtu", VtuGrid{}));
}

}  // namespace
}  // namespace mortise
