#include "mesh/copy_bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../mesh/grid.hpp"
#include "support/messages.hpp"
#include "support/patches.hpp"

namespace mortise {
namespace {

BodyCopy copy_of(const std::string& body, const std::string& name, const Vec2& shift = {0, 0}, double degrees = 0) {
  return {.key = "copies.0 (line 3)", .body = body, .name = name, .degrees = degrees, .shift = shift};
}

Vec2 place(const Mesh& mesh, int node) { return mesh.nodes.row(node).transpose(); }

TEST(CopyBodies, NoCopiesAreTheMeshItself) {
  const Mesh plate = testing_meshes::plate(CellKind::tri3, 2, 1), same = copy_bodies(plate, {});
  EXPECT_EQ(same.bodies, plate.bodies);
  EXPECT_EQ(same.nodes, plate.nodes);
}

TEST(CopyBodies, StandInThePlaceOfTheirOriginal) {
  for (const CellKind kind : testing_meshes::all_kinds()) {
    const Mesh plate = testing_meshes::plate(kind, 3, 2);
    const Mesh mesh = copy_bodies(plate, {copy_of("plate", "p_0"), copy_of("plate", "p_1", {10, 0.5})});
    const int n = int(plate.nodes.rows()), m = int(plate.cells.size());
    EXPECT_EQ(mesh.source, plate.source);
    EXPECT_EQ(mesh.bodies, (std::vector<std::string>{"p_0", "p_1"}));
    ASSERT_EQ(mesh.nodes.rows(), 2 * n);
    EXPECT_EQ(mesh.nodes.topRows(n), plate.nodes);
    EXPECT_EQ(mesh.nodes.bottomRows(n), plate.nodes.rowwise() + Eigen::RowVector2d(10, 0.5));
    ASSERT_EQ(int(mesh.cells.size()), 2 * m);
    for (int c = 0; c < 2 * m; ++c) {
      EXPECT_EQ(mesh.cells[c].kind, kind);
      EXPECT_EQ(mesh.cells[c].body, c / m);
      for (int i = 0; i < 9; ++i) {
        const int node = plate.cells[c % m].nodes[i];
        EXPECT_EQ(mesh.cells[c].nodes[i], node < 0 ? -1 : node + c / m * n);
      }
    }
    ASSERT_EQ(mesh.boundaries.size(), 10u);
    EXPECT_EQ(mesh.boundaries[0].name, "p_0_bottom");
    EXPECT_EQ(mesh.boundaries[7].name, "p_1_top");
    for (std::size_t e = 0; e < 3; ++e)
      for (const int k : {0, 1})
        EXPECT_EQ(place(mesh, mesh.boundaries[7].edges[e].nodes[k]),
                  place(plate, plate.boundaries[2].edges[e].nodes[k]) + Vec2(10, 0.5));
  }
}

TEST(CopyBodies, TurnAboutTheCentreThenMove) {
  const Mesh plate = testing_meshes::plate(CellKind::quad8, 2, 1);
  BodyCopy copy = copy_of("plate", "turned", {5, 7}, 30);
  copy.centre = {1, 2};
  const Mesh mesh = copy_bodies(plate, {copy});
  const double c = std::sqrt(3) / 2, s = 0.5;  // of 30 degrees
  for (int i = 0; i < mesh.nodes.rows(); ++i) {
    const Vec2 arm = place(plate, i) - Vec2(1, 2);
    EXPECT_LE((place(mesh, i) - Vec2(6 + c * arm.x() - s * arm.y(), 9 + s * arm.x() + c * arm.y())).norm(), 1e-14);
  }
}

TEST(CopyBodies, PointsAreNamedAsCurvesAre) {
  Mesh plate = testing_meshes::plate(CellKind::tri3, 2, 1);
  plate.points = {{"plate_tip", {1}}, {"eye", {0, 3}}};
  const Mesh mesh = copy_bodies(plate, {copy_of("plate", "a"), copy_of("plate", "b", {1, 0})});
  const int n = int(plate.nodes.rows());
  ASSERT_EQ(mesh.points.size(), 4u);
  EXPECT_EQ(mesh.points[0].name, "a_tip");
  EXPECT_EQ(mesh.points[1].name, "a_eye");
  EXPECT_EQ(mesh.points[2].name, "b_tip");
  EXPECT_EQ(mesh.points[3].nodes, (std::vector<int>{n, n + 3}));
}

TEST(CopyBodies, QuarterTurnsAreExact) {
  const Mesh plate = testing_meshes::plate(CellKind::tri6, 3, 2);
  for (const auto& [degrees, x, y] : std::vector<std::tuple<double, Vec2, Vec2>>{{90, {0, 1}, {-1, 0}},
                                                                                 {-90, {0, -1}, {1, 0}},
                                                                                 {180, {-1, 0}, {0, -1}},
                                                                                 {450, {0, 1}, {-1, 0}},
                                                                                 {-360, {1, 0}, {0, 1}}}) {
    const Mesh mesh = copy_bodies(plate, {copy_of("plate", "turned", {0, 0}, degrees)});
    for (int i = 0; i < mesh.nodes.rows(); ++i)
      EXPECT_EQ(place(mesh, i), plate.nodes(i, 0) * x + plate.nodes(i, 1) * y) << degrees;
  }
}

TEST(CopyBodies, DrawnCurvesGoWithThem) {
  Mesh plate = testing_meshes::plate(CellKind::quad8, 1, 1);
  EdgeSamples samples{.pieces = {{.end = 0.25, .places = {}}, {.end = 1, .places = {}}}, .misfit = 1e-14};
  for (int k = 0; k < 9; ++k) samples.pieces[1].places[k] = Vec2(k / 8.0, 0.01 * k);
  plate.boundaries[0].samples = {samples};
  plate.boundaries[1].undrawn = "it is not";
  const Mesh mesh = copy_bodies(plate, {copy_of("plate", "p_0"), copy_of("plate", "p_1", {0, 3}, 180)});
  ASSERT_EQ(mesh.boundaries[5].samples.size(), 1u);
  const EdgeSamples& moved = mesh.boundaries[5].samples[0];
  ASSERT_EQ(moved.pieces.size(), 2u);
  EXPECT_EQ(moved.pieces[0].end, 0.25);
  EXPECT_EQ(moved.misfit, 1e-14);
  for (int k = 0; k < 9; ++k) EXPECT_EQ(moved.pieces[1].places[k], Vec2(-k / 8.0, 3 - 0.01 * k));
  EXPECT_EQ(mesh.boundaries[6].undrawn, "it is not");
}

TEST(CopyBodies, OthersStayAndCurvesOfSeveralBodiesAreParted) {
  Mesh mesh = test::mesh_of({test::block(
                                 "a", 2, 1, 0, 1, [](double) { return 0; }, [](double) { return 1; }),
                             test::block(
                                 "b", 3, 1, 2, 3, [](double) { return 0; }, [](double) { return 1; })},
                            CellKind::quad4);
  Boundary both{"both", {}};
  for (const std::string& side : {"a_north", "b_north"})
    for (const Edge& edge : mesh.boundaries[boundary_index(mesh, side)].edges) both.edges.push_back(edge);
  mesh.boundaries.push_back(both);
  const Mesh copied = copy_bodies(mesh, {copy_of("a", "a_0", {0, 5}), copy_of("a", "a_1", {0, 7})});
  EXPECT_EQ(copied.bodies, (std::vector<std::string>{"b", "a_0", "a_1"}));
  for (const auto& [name, count] : std::map<std::string, std::size_t>{
           {"both", 3}, {"b_north", 3}, {"a_0_both", 2}, {"a_1_both", 2}, {"a_0_north", 2}, {"a_1_south", 2}})
    EXPECT_EQ(copied.boundaries[boundary_index(copied, name)].edges.size(), count) << name;
  EXPECT_EQ(test::message_of([&] { boundary_index(copied, "a_north"); }).find("unknown boundary"),
            copied.source.size() + 2);
  for (const Edge& edge : copied.boundaries[boundary_index(copied, "a_1_both")].edges)
    EXPECT_EQ(place(copied, edge.nodes[0]).y(), 8);
}

TEST(CopyBodies, RefuseWhatCannotBeMeant) {
  Mesh plate = testing_meshes::plate(CellKind::tri3, 2, 1);
  const auto refusal = [&](const std::vector<BodyCopy>& copies) {
    return test::message_of<SceneError>([&] { copy_bodies(plate, copies); });
  };
  EXPECT_EQ(refusal({copy_of("plat", "p")}),
            "copies.0 (line 3): unknown body 'plat'; did you mean 'plate'? known: plate (plate.msh)");
  EXPECT_EQ(refusal({copy_of("plate", "p"), copy_of("plate", "p")}),
            "copies.0 (line 3): the copy 'p' of 'plate' has a body 'p', as another has; expected a name of its own");
  plate.boundaries.push_back(plate.boundaries[0]);
  plate.boundaries.back().name = "plate_bottom";
  EXPECT_EQ(refusal({copy_of("plate", "p")}),
            "copies.0 (line 3): the copy 'p' of 'plate' has a curve 'p_bottom', as another has; expected a name of its "
            "own");
  plate.bodies.push_back("rest");
  plate.cells.back().body = 1;
  EXPECT_EQ(refusal({copy_of("plate", "p")}).find("copies.0 (line 3): body 'plate' shares nodes with 'rest' near ("),
            0u);
}

}  // namespace
}  // namespace mortise
