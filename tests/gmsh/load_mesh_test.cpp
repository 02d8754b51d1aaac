#include "gmsh/load_mesh.hpp"

#include <gmsh.h>
#include <gtest/gtest.h>
#include <omp.h>
#include <sys/resource.h>

#include <algorithm>
#include <clocale>
#include <cmath>
#include <csignal>

#include "../mesh/grid.hpp"
#include "base/errors.hpp"
#include "gmsh/write_msh.hpp"
#include "mesh/curve.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise {
namespace {

using test::message_of;
using test::TemporaryFolder;

/// Two bodies along y = 1; the lower one of two surfaces, the right of which may be recombined, and the upper one
/// upside down (its curve loop runs clockwise). Of the physical point one is far out of the plane, in no body, and to
/// be ignored.
const char* const kTwoPlates = R"(
DefineConstant[ n_upper = 4 ];
DefineConstant[ n_lower = {3, Min 1, Name "Mesh/n_lower"}, quads = 0, order = 1, quad9 = 0 ];
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {2, 0, 0};
Point(4) = {2, 1, 0}; Point(5) = {1, 1, 0}; Point(6) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1};
Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6}; Plane Surface(1) = {1};
Curve Loop(2) = {2, 3, 4, -7}; Plane Surface(2) = {2};
Point(11) = {0, 1, 0}; Point(12) = {2, 1, 0}; Point(13) = {2, 2, 0}; Point(14) = {0, 2, 0}; Point(99) = {7, 7, 7};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(11) = {-11, -14, -13, -12}; Plane Surface(11) = {11};
Transfinite Curve {1:7} = n_lower + 1; Transfinite Curve {11:14} = n_upper + 1; Transfinite Surface {1, 2, 11};
If(quads > 0) Recombine Surface {2}; EndIf
If(quads > 1) Recombine Surface {1, 11}; EndIf
Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = 1 - quad9;
Physical Surface("upper") = {11};
Physical Surface("lower") = {1, 2};
Physical Curve("lower_contact") = {-4, -5}; Physical Curve("upper_contact") = {11}; Physical Curve("base") = {1, 2};
Physical Point("corner") = {1, 99};
)";

using Parameters = std::map<std::string, double>;

/// Cells and edges told by their coordinates, sorted: the same for the same mesh however it is numbered.
std::vector<std::vector<long>> shape(const Mesh& mesh) {
  std::vector<std::vector<long>> rows;
  const auto add_point = [&](int node) {
    // The offset keeps coordinates with few digits off the limit of rounding.
    for (int axis = 0; axis < 2; ++axis) rows.back().push_back(std::lround(1e7 * mesh.nodes(node, axis) + 0.123));
  };
  for (const Cell& cell : mesh.cells) {
    rows.push_back({static_cast<long>(cell.kind), cell.body});
    for (int i = 0; i < node_count(cell.kind); ++i) add_point(cell.nodes[i]);
  }
  for (int b = 0; b < static_cast<int>(mesh.boundaries.size()); ++b) {
    for (const Edge& edge : mesh.boundaries[b].edges) {
      rows.push_back({100, b, edge.node_count});
      const auto before = [&](int p, int q) { return mesh.nodes.row(p).sum() < mesh.nodes.row(q).sum(); };
      const auto [start, end] = std::minmax(edge.nodes[0], edge.nodes[1], before);  // a 2.2 file turns some round
      for (const int node : {start, end, edge.nodes[2]}) {
        if (node >= 0) add_point(node);
      }
    }
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

double area(const Mesh& mesh, int body) {
  double sum = 0;
  for (const Cell& cell : mesh.cells) {
    if (cell.body != body) continue;
    for (int side = 0; side < corner_count(cell.kind); ++side) {
      const Edge edge = side_edge(cell, side);
      const auto a = mesh.nodes.row(edge.nodes[0]);
      const auto b = mesh.nodes.row(edge.nodes[1]);
      sum += 0.5 * (a(0) * b(1) - a(1) * b(0));
    }
  }
  return sum;
}

/// Meshes a .geo and writes it by gmsh's own hand.
void write_by_gmsh(const std::string& geo, const std::string& msh, double version, bool binary) {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::open(geo);
  gmsh::model::mesh::generate(2);
  gmsh::option::setNumber("Mesh.MshFileVersion", version);
  gmsh::option::setNumber("Mesh.Binary", binary ? 1 : 0);
  gmsh::write(msh);
  gmsh::finalize();
}

struct Variety {
  const char* name;
  int quads, order, quad9;
  std::vector<CellKind> kinds;  // in "lower" and "upper" together, sorted
  friend void PrintTo(const Variety& variety, std::ostream* out) { *out << variety.name; }
};

const std::vector<Variety>& varieties() {
  using enum CellKind;
  static const std::vector<Variety> all{
      {"triangles", 0, 1, 0, {tri3}},     {"triangles6", 0, 2, 0, {tri6}},    {"quads", 2, 1, 0, {quad4}},
      {"quads8", 2, 2, 0, {quad8}},       {"quads9", 2, 2, 1, {quad9}},       {"mixed", 1, 1, 0, {tri3, quad4}},
      {"mixed8", 1, 2, 0, {tri6, quad8}}, {"mixed9", 1, 2, 1, {tri6, quad9}},
  };
  return all;
}

std::vector<CellKind> kinds_of(const Mesh& mesh) {
  std::vector<CellKind> kinds;
  for (const Cell& cell : mesh.cells) kinds.push_back(cell.kind);
  std::sort(kinds.begin(), kinds.end());
  kinds.erase(std::unique(kinds.begin(), kinds.end()), kinds.end());
  return kinds;
}

class GmshMesh : public testing::TestWithParam<Variety> {};

TEST_P(GmshMesh, GeoIsMeshed) {
  const Variety& variety = GetParam();
  const TemporaryFolder folder;
  const std::string geo = folder.write("two.geo", kTwoPlates);
  const Mesh mesh = load_mesh(geo, {{"quads", variety.quads}, {"order", variety.order}, {"quad9", variety.quad9}});
  EXPECT_EQ(mesh.source, geo);
  EXPECT_EQ(mesh.bodies, (std::vector<std::string>{"upper", "lower"}));
  EXPECT_EQ(boundary_names(mesh), (std::vector<std::string>{"lower_contact", "upper_contact", "base"}));
  EXPECT_EQ(kinds_of(mesh), variety.kinds);
  for (int body = 0; body < 2; ++body) EXPECT_NEAR(area(mesh, body), 2.0, 1e-12);  // exact, counter-clockwise
  EXPECT_TRUE(std::is_sorted(mesh.cells.begin(), mesh.cells.end(),
                             [](const Cell& a, const Cell& b) { return a.body < b.body; }));

  std::vector<char> used(mesh.nodes.rows(), 0);
  for (const Cell& cell : mesh.cells) {
    for (int i = 0; i < node_count(cell.kind); ++i) used[cell.nodes[i]] = 1;
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);

  EXPECT_EQ(contact_curve(mesh, 0).edges.size(), 6U);
  EXPECT_EQ(contact_curve(mesh, 1).edges.size(), 4U);
  EXPECT_NEAR(mesh.nodes(contact_curve(mesh, 0).edges.front().nodes[0], 0), 2.0,
              1e-12);  // body on the left: from x = 2
  EXPECT_NEAR(mesh.nodes(contact_curve(mesh, 1).edges.front().nodes[0], 0), 0.0, 1e-12);
}

/// Names and coordinates of all points.
std::vector<std::tuple<std::string, double, double>> places(const Mesh& mesh) {
  std::vector<std::tuple<std::string, double, double>> places;
  for (const NamedPoint& point : mesh.points)
    for (const int node : point.nodes) places.emplace_back(point.name, mesh.nodes(node, 0), mesh.nodes(node, 1));
  return places;
}

TEST_P(GmshMesh, MshOfEveryFormatIsTheSame) {
  const Variety& variety = GetParam();
  const TemporaryFolder folder;
  const Parameters parameters{{"quads", variety.quads}, {"order", variety.order}, {"quad9", variety.quad9}};
  std::string values;
  for (const auto& [name, value] : parameters) values += name + " = " + std::to_string(value) + ";\n";
  const std::string geo = folder.write("two.geo", values + kTwoPlates);
  const auto expected = shape(load_mesh(folder.write("plain.geo", kTwoPlates), parameters));
  const std::string msh = (folder.path() / "two.msh").string();
  for (const double version : {2.2, 4.1}) {
    for (const bool binary : {false, true}) {
      write_by_gmsh(geo, msh, version, binary);
      const Mesh mesh = load_mesh(msh, {});
      EXPECT_TRUE(shape(mesh) == expected) << "version " << version << " binary " << binary;
      EXPECT_EQ(places(mesh), (decltype(places(mesh)){{"corner", 0, 0}}));  // as drawn
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, GmshMesh, testing::ValuesIn(varieties()),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

/// Upper and lower contact edges with these parameters.
std::pair<std::size_t, std::size_t> edge_counts(const std::string& geo, const Parameters& parameters) {
  const Mesh mesh = load_mesh(geo, parameters);
  return {mesh.boundaries[1].edges.size(), mesh.boundaries[0].edges.size()};
}

TEST(GmshParameters, OverrideBothFormsOfDefineConstant) {
  const TemporaryFolder folder;
  const std::string geo = folder.write("two plates.geo", kTwoPlates);
  EXPECT_EQ(edge_counts(geo, {}), std::pair(std::size_t{4}, std::size_t{6}));
  EXPECT_EQ(edge_counts(geo, {{"n_upper", 7}}), std::pair(std::size_t{7}, std::size_t{6}));
  EXPECT_EQ(edge_counts(geo, {{"n_lower", 5}}), std::pair(std::size_t{4}, std::size_t{10}));
}

TEST(GmshParameters, DoNotLeakIntoTheNextMesh) {
  // gmsh's -setnumber does: its values outlive gmsh::finalize.
  const TemporaryFolder folder;
  const std::string geo = folder.write("two.geo", kTwoPlates);
  EXPECT_EQ(edge_counts(geo, {{"n_upper", 7}, {"n_lower", 2}}), std::pair(std::size_t{7}, std::size_t{4}));
  EXPECT_EQ(edge_counts(geo, {}), std::pair(std::size_t{4}, std::size_t{6}));
}

TEST(GmshParameters, ReachIncludedFilesToTheLastDigit) {
  const TemporaryFolder folder;
  folder.write("part/size.geo", "DefineConstant[ a = 1 ];\n");
  const std::string geo = folder.write("a.geo", R"(
    Include "part/size.geo";
    Point(1) = {0, 0, 0}; Point(2) = {a, 0, 0}; Point(3) = {0, 1, 0};
    Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 1}; Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};
    Transfinite Curve {1:3} = 2; Physical Surface("body") = {1};
  )");
  EXPECT_EQ(load_mesh(geo, {{"a", 1.0 / 3}}).nodes.col(0).maxCoeff(), 1.0 / 3);
  EXPECT_EQ(load_mesh(geo, {{"a", 3e-5}}).nodes.col(0).maxCoeff(), 3e-5);
}

TEST(GmshSession, LeavesTheProcessAsItWas) {
  const TemporaryFolder folder;
  const std::string good = folder.write("good.geo", kTwoPlates);
  const std::string bad = folder.write("bad.geo", "Point(1) = {0;");
  omp_set_num_threads(3);
  const std::string locale = std::setlocale(LC_ALL, nullptr);
  load_mesh(good, {});
  EXPECT_THROW(load_mesh(bad, {}), InputError);
  EXPECT_EQ(omp_get_max_threads(), 3);
  EXPECT_EQ(std::setlocale(LC_ALL, nullptr), locale);
  EXPECT_NO_THROW(load_mesh(good, {}));  // and gmsh can be started again
}

TEST(GmshMeshFile, AGeoMayMeshItself) {
  const TemporaryFolder folder;
  const std::string geo = folder.write("two.geo", std::string(kTwoPlates) + "Mesh 2;\nMesh.ElementOrder = 2;\n");
  EXPECT_EQ(kinds_of(load_mesh(geo, {})), std::vector<CellKind>{CellKind::tri3});
}

TEST(GmshMeshFile, PointsKeepTheirNames) {
  const TemporaryFolder folder;
  const std::string geo = folder.write("two.geo", std::string(kTwoPlates) +
                                                      "Physical Point(\"tips\") = {3, 14, 1};\n"
                                                      "Physical Point(\"nowhere\") = {99};\n");
  const Mesh mesh = load_mesh(geo, {});
  ASSERT_EQ(mesh.points.size(), 2u);  // a point of no body is none
  EXPECT_EQ(mesh.points[1].nodes.size(), 3u);
  auto found = places(mesh);
  std::ranges::sort(found);
  const decltype(found) drawn{{"corner", 0, 0}, {"tips", 0, 0}, {"tips", 0, 2}, {"tips", 2, 0}};
  EXPECT_EQ(found, drawn);
  write_msh(mesh, folder.path("a.msh"));
  EXPECT_EQ(places(load_mesh(folder.path("a.msh"), {})), places(mesh));
}

TEST(GmshMeshFile, LastStatementCountsWithoutANewlineToo) {
  // gmsh 4.8 drops it without a word from a .geo that it opens directly.
  const TemporaryFolder folder;
  const std::string geo = folder.write("two.geo", std::string(kTwoPlates) + "Physical Curve(\"last\") = {13};");
  EXPECT_EQ(boundary_names(load_mesh(geo, {})).back(), "last");
}

TEST(WriteMsh, CanBeReadBack) {
  const TemporaryFolder folder;
  const std::string geo = folder.write("two.geo", kTwoPlates);
  const std::string msh = (folder.path() / "a.msh").string();
  const Parameters parameters{{"quads", 1}, {"order", 2}, {"n_upper", 5}};
  write_msh(load_mesh(geo, parameters), msh);
  EXPECT_EQ(shape(load_mesh(msh, {})), shape(load_mesh(geo, parameters)));
  EXPECT_EQ(test::text_of(msh).substr(0, 16), "$MeshFormat\n4.1 ");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);  // nothing half-written
}

TEST(GmshMeshFile, AFoldersNameIsNoCode) {
  const TemporaryFolder folder;
  const std::string proof = folder.path("proof");
  const std::string name = "a\"; SystemCall \"touch " + std::string("proof") + "\"; x=\"\n\\b";
  folder.write(name + "/part/plates.geo", kTwoPlates);
  const std::string geo = folder.write(name + "/two.geo", "Include \"part/plates.geo\";\n");
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  EXPECT_EQ(kinds_of(load_mesh(geo, {{"n_upper", 5}})), std::vector<CellKind>{CellKind::tri3});
  folder.write(name + "/bad.geo", "\n\nx = y;\n");
  const std::string message = message_of([&] { load_mesh(folder.path(name + "/bad.geo"), {}); });
  std::filesystem::current_path(before);
  EXPECT_FALSE(std::filesystem::exists(proof));
  EXPECT_NE(message.find("line 3: Unknown variable 'y'"), std::string::npos) << message;
  EXPECT_EQ(message.find("/proc/"), std::string::npos) << message;
}

TEST(GmshMeshFile, AFileNameThatGmshCannotBeGivenIsRefused) {
  const TemporaryFolder folder;
  const std::string geo = folder.write("a\"b.geo", kTwoPlates);
  test::expect_contains(message_of([&] { load_mesh(geo, {}); }), "quotes, backslashes");
}

TEST(WriteMsh, NeverReplacesAnInputOrAFileOfAnotherKind) {
  const TemporaryFolder folder;
  const std::string geo = folder.write("two.geo", std::string(kTwoPlates) + "If(0) Merge \"part.msh\"; EndIf\n");
  const std::string part = folder.write("part.msh", "$MeshFormat\n");
  const std::string link = folder.path("link.msh");
  std::filesystem::create_hard_link(part, link);
  const std::string notes = folder.write("notes.msh", "my notes\n");
  test::expect_contains(message_of([&] { check_msh_target(link, {geo}); }), "it is the input");
  test::expect_contains(message_of([&] { check_msh_target(notes, {geo}); }), "mortise did not write");
  std::filesystem::create_directory(folder.path("folder.msh"));
  test::expect_contains(message_of([&] { check_msh_target(folder.path("folder.msh"), {geo}); }), "it is a folder");
  EXPECT_EQ(test::text_of(part), "$MeshFormat\n");
  EXPECT_EQ(test::text_of(notes), "my notes\n");
}

TEST(WriteMsh, OnAFullDiskTheOldMeshStands) {
  const TemporaryFolder folder;
  const std::string geo = folder.write("two.geo", kTwoPlates);
  const std::string msh = folder.path("a.msh");
  write_msh(load_mesh(geo, {}), msh);
  const std::string old = test::text_of(msh);
  const Mesh finer = load_mesh(geo, {{"n_upper", 30}});
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small{1500, limit.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);  // then a write beyond the limit fails, as on a full disk
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = message_of([&] { write_msh(finer, msh); });
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, handler);
  EXPECT_TRUE(message.starts_with(msh + ": cannot be written: ")) << message;
  EXPECT_EQ(test::text_of(msh), old);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
}

TEST(WriteMsh, SaysWhatCannotBeWritten) {
  const TemporaryFolder folder;
  const std::string geo = folder.write("two.geo", kTwoPlates);
  EXPECT_EQ(message_of<InputError>([&] { check_msh_target("a.vtk", {}); }),
            "a.vtk: the name of a mesh to write ends in .msh");
  const std::string message = message_of<InputError>([&] { write_msh(load_mesh(geo, {}), "/nowhere/a.msh"); });
  EXPECT_NE(message.find("/nowhere/a.msh: "), std::string::npos) << message;
}

// ---- Far from the origin ----

// Part of a disc: arcs, a transfinite one, sizes at points; or sizes by a field, a function of place. And a disc of two
// halves that touches it.
TEST(LoadMesh, MeshesFarFromTheOriginAsNearIt) {
  const TemporaryFolder folder;
  const std::string file = folder.write("disc.geo", R"geo(DefineConstant[ X = 0, by_field = 0 ];
Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;
Point(1) = {X, -X, 0}; Point(2) = {X + 3, -X, 0, 0.3}; Point(3) = {X, 3 - X, 0, 0.6}; Point(4) = {X, -3 - X, 0, 0.6};
Circle(1) = {2, 1, 3}; Circle(2) = {4, 1, 2}; Line(3) = {3, 4}; Transfinite Curve {1} = 12;
Curve Loop(1) = {1, 3, 2}; Plane Surface(1) = {1}; Physical Surface("disc") = {1}; Physical Curve("rim") = {1, 2};
Point(11) = {X + 3, -X, 0, 0.3}; Point(12) = {X + 4, -X, 0}; Point(13) = {X + 5, -X, 0, 0.3};
Circle(11) = {11, 12, 13}; Circle(12) = {13, 12, 11};
Curve Loop(11) = {11, 12}; Plane Surface(11) = {11}; Physical Surface("ball") = {11};
If(by_field)
Field[1] = MathEval; Field[1].F = Sprintf("0.1 + 0.2 * abs(x - %.10g)",
                                        X + 3);
  Background Field = 1;
  Mesh.MeshSizeFromPoints = 0;
EndIf
)geo");
  for (const double by_field : {0.0, 1.0}) {
    const Mesh near = load_mesh(file, {{"by_field", by_field}});
    for (const double x : by_field > 0 ? std::vector<double>{20} : std::vector<double>{1e3, 1e5, 3e7}) {
      const Mesh far = load_mesh(file, {{"by_field", by_field}, {"X", x}});
      EXPECT_EQ(far.bodies.size(), 2u) << x;
      EXPECT_EQ(far.boundaries.at(0).edges.size(), near.boundaries.at(0).edges.size()) << x;
      EXPECT_NEAR(double(far.cells.size()), double(near.cells.size()), 0.03 * double(near.cells.size())) << x;
      for (const Edge& edge : far.boundaries[0].edges)
        for (const int node : edge.nodes)
          EXPECT_NEAR((Vec2(far.nodes.row(node).transpose()) - Vec2(x, -x)).norm(), 3, 4e-16 * x + 1e-12);
    }
  }
}

}  // namespace
}  // namespace mortise
