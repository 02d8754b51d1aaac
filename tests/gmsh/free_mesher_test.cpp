#include "gmsh/free_mesher.hpp"

#include <gtest/gtest.h>
#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <clocale>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>
#include <sstream>

#include "base/errors.hpp"
#include "base/vectors.hpp"
#include "gmsh/load_mesh.hpp"
#include "gmsh/write_msh.hpp"
#include "support/edge_sizes.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using test::place;
using test::size_ratio;
using test::TemporaryFolder;

// One body of each kind of curve that gmsh's own kernel has. Sizes, counts and fields are to be dropped.
const char* const kAllCurves = R"(
Point(1) = {0, 0, 0, 0.001}; Point(2) = {1, 0, 0}; Point(3) = {2, 1, 0}; Point(4) = {0, 1, 0}; Point(5) = {1, 1, 0};
Line(1) = {1, 2}; Circle(2) = {2, 5, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Point(11) = {3, 0, 0}; Point(12) = {5, 0, 0}; Point(13) = {3, 1, 0};
Line(11) = {11, 12}; Ellipse(12) = {12, 11, 12, 13}; Line(13) = {13, 11};
Curve Loop(11) = {11:13}; Plane Surface(11) = {11};
Point(21) = {6, 0, 0}; Point(22) = {7, 0, 0}; Point(23) = {7, 1, 0}; Point(24) = {6.8, 1.5, 0};
Point(25) = {6.5, 1.2, 0}; Point(26) = {6.2, 1.7, 0}; Point(27) = {6, 1, 0}; Point(28) = {5.5, 0.7, 0}; Point(29) = {5.8, 0.3, 0};
Line(21) = {21, 22}; Point(30) = {7.3, 0.5, 0}; BSpline(22) = {22, 30, 23}; Spline(23) = {23, 24, 25, 26, 27}; Nurbs(24) = {27, 28, 29, 21} Knots {0, 0, 0, 0.3, 1, 1, 1} Order 2;
Curve Loop(21) = {21:24}; Plane Surface(21) = {21};
Point(31) = {9, 0, 0}; Point(32) = {10, 0, 0}; Point(33) = {10, 1, 0}; Point(34) = {9.8, 1.5, 0};
Point(35) = {9.5, 1.2, 0}; Point(36) = {9.2, 1.7, 0}; Point(37) = {9, 1, 0}; Point(38) = {8.5, 0.7, 0}; Point(39) = {8.8, 0.3, 0};
Line(31) = {31, 32}; Point(40) = {10.3, 0.5, 0}; Bezier(32) = {32, 40, 33}; Bezier(33) = {33, 34, 35, 36, 37}; Bezier(34) = {37, 38, 39, 31};
Curve Loop(31) = {31:34}; Plane Surface(31) = {31};
Transfinite Curve {1:34} = 3; Transfinite Surface {1}; Recombine Surface {1, 11, 21};
Field[1] = MathEval; Field[1].F = "0.001"; Background Field = 1; Mesh.MeshSizeMax = 0.001;
Physical Surface("first", 9) = {1}; Physical Surface("others", 4) = {11, 21, 31};
Physical Curve("a \ b") = {-1, 2, 3, 4}; Physical Curve("ellipse") = {11:13};
Physical Curve("splines") = {21:24}; Physical Curve("Bezier") = {31:34};
Physical Point("tip", 7) = {13};
)";

double graded(const Vec2& x) { return 0.02 + 0.03 * std::abs(x.y() - 0.1); }

// Exact for sides that are parabolas.
double free_area(const Mesh& mesh, int body) {
  double sum = 0;
  for (const Cell& cell : mesh.cells)
    for (int side = 0; cell.body == body && side < corner_count(cell.kind); ++side) {
      const Edge edge = side_edge(cell, side);
      const Vec2 a = place(mesh, edge.nodes[0]), b = place(mesh, edge.nodes[1]);
      const Vec2 m = edge.node_count == 3 ? place(mesh, edge.nodes[2]) : Vec2((a + b) / 2);
      sum += (4 * (cross(a, m) + cross(m, b)) - cross(a, b)) / 6;
    }
  return sum;
}

std::vector<std::string> names_of(const std::vector<DrawnCurve>& curves) {
  std::vector<std::string> names;
  for (const DrawnCurve& curve : curves) names.insert(names.end(), curve.names.begin(), curve.names.end());
  std::ranges::sort(names);
  names.erase(std::ranges::unique(names).begin(), names.end());
  return names;
}

TEST(FreeMesher, SizesAreThoseAskedForOnEveryKindOfCurve) {
  const TemporaryFolder folder;
  const Mesh mesh = FreeMesher(folder.write("a.geo", kAllCurves), {}).mesh(graded);
  EXPECT_EQ(mesh.bodies, (std::vector<std::string>{"others", "first"}));  // by tag
  EXPECT_EQ(boundary_names(mesh), (std::vector<std::string>{"a \\ b", "ellipse", "splines", "Bezier"}));
  ASSERT_EQ(mesh.points.size(), 1u);
  EXPECT_EQ(mesh.points[0].name, "tip");
  EXPECT_EQ(place(mesh, mesh.points[0].nodes.at(0)), Vec2(3, 1));
  for (const Boundary& boundary : mesh.boundaries)
    for (const Edge& edge : boundary.edges) {
      EXPECT_EQ(edge.node_count, 3);
      EXPECT_GE(size_ratio(mesh, edge, graded), 0.6) << boundary.name;
      EXPECT_LE(size_ratio(mesh, edge, graded), 1.2) << boundary.name;
    }
  std::vector<double> ratios;
  for (const Cell& cell : mesh.cells) {
    EXPECT_EQ(cell.kind, CellKind::tri6);
    for (int side = 0; side < 3; ++side) ratios.push_back(size_ratio(mesh, side_edge(cell, side), graded));
  }
  std::ranges::sort(ratios);
  EXPECT_GE(ratios.front(), 0.4);
  EXPECT_LE(ratios.back(), 1.8);
  EXPECT_NEAR(ratios[ratios.size() / 2], 1, 0.05);
}

TEST(FreeMesher, CurvesAreKnownBeforeThereIsAMesh) {
  const TemporaryFolder folder;
  FreeMesher mesher(folder.write("a.geo", kAllCurves), {});
  EXPECT_EQ(names_of(mesher.curves()), (std::vector<std::string>{"Bezier", "a \\ b", "ellipse", "splines"}));
  ASSERT_EQ(mesher.curves().size(), 15u);
  const DrawnCurve& arc = mesher.curves()[1];
  EXPECT_EQ(arc.names, std::vector<std::string>{"a \\ b"});
  EXPECT_LE((arc.places.front() - Vec2(1, 0)).norm(), 1e-14);
  EXPECT_LE((arc.places.back() - Vec2(2, 1)).norm(), 1e-14);
  for (const Vec2& x : arc.places) EXPECT_NEAR((x - Vec2(1, 1)).norm(), 1, 1e-14);
}

class EveryScene : public testing::TestWithParam<std::string> {};

std::vector<std::string> scenes() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(MORTISE_SOURCE_DIR "/geo"))
    if (entry.path().extension() == ".geo") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

// As its own mesh has them: bodies, boundaries, areas, drawn curves.
TEST_P(EveryScene, IsMeshedFreely) {
  const std::string file = MORTISE_SOURCE_DIR "/geo/" + GetParam() + ".geo";
  const Mesh own = load_mesh(file, {});
  FreeMesher mesher(file, {});
  const Vec2 centre = mesher.curves().front().places.front();
  const double whole = (own.nodes.colwise().maxCoeff() - own.nodes.colwise().minCoeff()).norm();
  const auto size = [&](const Vec2& x) { return 0.002 * whole + 0.04 * (x - centre).norm(); };
  const Mesh mesh = mesher.mesh(size);
  EXPECT_EQ(mesh.bodies, own.bodies);
  EXPECT_EQ(boundary_names(mesh), boundary_names(own));
  for (int body = 0; body < std::ssize(own.bodies); ++body)
    EXPECT_NEAR(free_area(mesh, body), free_area(own, body), 1e-4 * free_area(own, body)) << own.bodies[body];
  for (std::size_t b = 0; b < own.boundaries.size(); ++b) {
    const Boundary& boundary = mesh.boundaries[b];
    EXPECT_EQ(boundary.undrawn, own.boundaries[b].undrawn) << boundary.name;
    EXPECT_EQ(boundary.samples.size(), own.boundaries[b].samples.empty() ? 0 : boundary.edges.size()) << boundary.name;
    for (const Edge& edge : boundary.edges) {
      if (boundary.edges.size() > 1)
        EXPECT_GE(size_ratio(mesh, edge, size), 0.5) << boundary.name;  // one: a short curve
      EXPECT_LE(size_ratio(mesh, edge, size), 1.2) << boundary.name;
    }
  }
  for (const Cell& cell : mesh.cells) EXPECT_EQ(cell.kind, CellKind::tri6);
}

INSTANTIATE_TEST_SUITE_P(Geo, EveryScene, testing::ValuesIn(scenes()), [](const auto& info) { return info.param; });

// The size function stands for gmsh: it never returns the first time.
TEST(FreeMesher, WhatTakesFarLongerThanEarlierMeshesIsStopped) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.geo", kAllCurves);
  FreeMesher mesher(file, {});
  const Mesh first = mesher.mesh([](const Vec2&) { return 0.3; });
  const fs::path mark = fs::path(file).replace_extension("mark");
  const SizeAt hangs = [&](const Vec2&) {
    if (!fs::exists(mark)) {
      std::ofstream(mark) << "once";
      ::sleep(600);
    }
    return 0.25;
  };
  const auto start = std::chrono::steady_clock::now();
  EXPECT_GT(mesher.mesh(hangs, false, double(first.nodes.rows())).nodes.rows(), first.nodes.rows());
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

TEST(FreeMesher, AGeometryOfOpenCascadeToo) {
  const TemporaryFolder folder;
  const std::string geo = folder.write("a.geo", R"(
    DefineConstant[ radius = 1 ];
    SetFactory("OpenCASCADE"); Disk(1) = {0, radius, 0, radius}; Rectangle(2) = {-1, -1, 0, 2, 1};
    Transfinite Curve {1} = 80; Transfinite Surface {2}; Recombine Surface {2}; Mesh.RecombineAll = 1;
    Field[1] = MathEval; Field[1].F = "0.001"; Background Field = 1; Mesh.MeshSizeFactor = 0.1;
    Mesh.SubdivisionAlgorithm = 1;
    Physical Surface("disc") = {1}; Physical Surface("block") = {2}; Physical Curve("rim") = {1}; Physical Curve("top") = {4};
  )");
  FreeMesher mesher(geo, {{"radius", 0.5}});
  const auto size = [](const Vec2& x) { return 0.01 + 0.1 * x.norm(); };
  const Mesh mesh = mesher.mesh(size);
  EXPECT_EQ(mesh.bodies, (std::vector<std::string>{"disc", "block"}));
  for (const Boundary& boundary : mesh.boundaries) {
    EXPECT_EQ(boundary.samples.size(), boundary.edges.size());
    for (const Edge& edge : boundary.edges) EXPECT_NEAR(size_ratio(mesh, edge, size), 1, 0.2) << boundary.name;
  }
  for (const Cell& cell : mesh.cells) EXPECT_EQ(cell.kind, CellKind::tri6);
  EXPECT_NEAR(free_area(mesh, 0), M_PI / 4, 1e-4);
  EXPECT_NEAR(free_area(mesh, 1), 2, 1e-12);
}

// Round bodies with holes in them, at random: each rim one closed curve, which is a loop by itself, or two.
TEST(FreeMesher, LoopsOfOneClosedCurve) {
  const TemporaryFolder folder;
  std::mt19937 random(5);
  const auto one_of = [&](int count) { return int(random() % unsigned(count)); };
  for (int variant = 0; variant < 15; ++variant) {
    const bool opencascade = variant % 5 == 4;
    std::ostringstream geo;
    geo << (opencascade ? "SetFactory(\"OpenCASCADE\");\n" : "") << "Mesh.ElementOrder = 2; Mesh.MeshSizeMax = 0.15;\n";
    int points = one_of(50), curves = one_of(50), loops = 0;
    std::string list;
    const auto draw = [&](const Vec2& centre, double radius) {
      const bool whole = one_of(3) > 0;
      std::string kind = one_of(2) == 0 ? "Spline" : "BSpline";
      if (whole && !opencascade && kind == "BSpline") kind = "Spline";  // gmsh 4.8 has it pass beside its own end
      points += 10;                                                     // OpenCASCADE adds some
      const int first = points + 1, turn = one_of(2) == 0 ? 1 : -1;
      for (int i = 0; i < 8; ++i) {
        const double angle = turn * std::numbers::pi * i / 4;
        geo << "Point(" << ++points << ") = {" << centre.x() + radius * std::cos(angle) << ", "
            << centre.y() + radius * std::sin(angle) << ", 0};\n";
      }
      const auto add = [&](int from, int to) {
        geo << kind << "(" << ++curves << ") = {" << from << ":" << to
            << (to == points ? ", " + std::to_string(first) : "") << "};\n";
      };
      const int from = curves + 1;
      if (whole) {
        add(first, points);
      } else {
        add(first, first + 4);
        add(first + 4, points);
      }
      geo << "Curve Loop(" << ++loops << ") = {" << from << ":" << curves << "}; Physical Curve(" << loops << ") = {"
          << from << ":" << curves << "};\n";
      list += (list.empty() ? "" : ", ") + std::to_string(loops);
    };
    for (int body = 1; body <= 2; ++body) {
      const int holes = one_of(4);
      list.clear();
      const Vec2 centre(10. * body, -2);
      draw(centre, 1.7);
      for (int i = 0; i < holes; ++i) draw(centre + Vec2(0.8 * (i - 1), 0.1 * i), 0.35);
      geo << "Plane Surface(" << body << ") = {" << list << "}; Physical Surface(" << body << ") = {" << body << "};\n";
    }
    const std::string file = folder.write("a.geo", geo.str());
    SCOPED_TRACE(geo.str());
    const Mesh own = load_mesh(file, {}), mesh = FreeMesher(file, {}).mesh([](const Vec2&) { return 0.15; });
    ASSERT_EQ(mesh.bodies, own.bodies);
    EXPECT_EQ(boundary_names(mesh), boundary_names(own));
    for (int body = 0; body < 2; ++body)
      EXPECT_NEAR(free_area(mesh, body), free_area(own, body), 1e-3 * free_area(own, body));
  }
}

TEST(FreeMesher, QuadrilateralsOnRequest) {
  const Mesh mesh = FreeMesher(MORTISE_SOURCE_DIR "/geo/parabola_1.geo", {})
                        .mesh([](const Vec2& x) { return 0.01 + 0.05 * x.x(); }, true);
  const auto quads = std::ranges::count(mesh.cells, CellKind::quad8, &Cell::kind);
  EXPECT_GE(quads, 0.8 * std::ssize(mesh.cells));
  EXPECT_EQ(quads + std::ranges::count(mesh.cells, CellKind::tri6, &Cell::kind), std::ssize(mesh.cells));
}

TEST(FreeMesher, TheSameSizesGiveTheSameMeshInAProcessLeftAsItWas) {
  omp_set_num_threads(3);
  const std::string locale = std::setlocale(LC_ALL, nullptr);
  FreeMesher mesher(MORTISE_SOURCE_DIR "/geo/parabola_1.geo", {});
  const Mesh first = mesher.mesh(graded);
  const Mesh finer = mesher.mesh([](const Vec2& x) { return graded(x) / 2; });
  FreeMesher other(MORTISE_SOURCE_DIR "/geo/rings.geo", {});  // two may live at a time
  const Mesh second = mesher.mesh(graded);
  EXPECT_EQ(first.nodes, second.nodes);
  EXPECT_EQ(first.cells.size(), second.cells.size());
  EXPECT_GE(finer.cells.size(), 3 * first.cells.size());
  EXPECT_EQ(omp_get_max_threads(), 3);
  EXPECT_EQ(std::setlocale(LC_ALL, nullptr), locale);
}

TEST(FreeMesher, WhatTheSizesThrowComesThrough) {
  FreeMesher mesher(MORTISE_SOURCE_DIR "/geo/rings.geo", {});
  int calls = 0;
  const auto fails = [&](const Vec2&) -> double {
    if (++calls == 300) throw InputError("no size at the call number " + std::to_string(calls));
    if (calls > 300) ADD_FAILURE() << "called again";
    return 0.1;
  };
  EXPECT_EQ(message_of([&] { mesher.mesh(fails); }), "no size at the call number 300");
  for (const double size : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(mesher.mesh([&](const Vec2& x) { return x.x() > 1.5 ? size : 0.1; }), std::domain_error);
  EXPECT_NO_THROW(mesher.mesh([](const Vec2&) { return 0.1; }));
}

TEST(FreeMesher, AGeoThatMeshesItselfIsMeshedAnew) {
  const TemporaryFolder folder;
  const std::string geo = folder.write("a.geo", "Include \"" MORTISE_SOURCE_DIR "/geo/rings.geo\";\nMesh 2;\n");
  const auto size = [](const Vec2&) { return 0.1; };
  const Mesh expected = FreeMesher(MORTISE_SOURCE_DIR "/geo/rings.geo", {}).mesh(size);
  EXPECT_EQ(FreeMesher(geo, {}).mesh(size).nodes, expected.nodes);
}

TEST(FreeMesher, RefusesWhatHasNoGeometry) {
  const TemporaryFolder folder;
  const std::string rings = MORTISE_SOURCE_DIR "/geo/rings.geo";
  const std::string msh = folder.path("a.msh");
  write_msh(load_mesh(rings, {}), msh);
  const auto refusal = [](const std::string& file) { return message_of<InputError>([&] { FreeMesher(file, {}); }); };
  EXPECT_EQ(refusal(msh), msh + ": a mesh has no geometry to refine; expected a .geo");
  const std::string merged = folder.write("merged.geo", "Merge \"a.msh\";\n");
  EXPECT_TRUE(refusal(merged).starts_with(merged + ": has no geometry to refine: surface ")) << refusal(merged);
  const std::string line = folder.write("line.geo", "Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Line(1) = {1, 2};\n");
  EXPECT_EQ(refusal(line), line + ": has no geometry to refine: it draws no surface");
  const std::string both =
      folder.write("both.geo", "Include \"" + rings + "\";\nSetFactory(\"OpenCASCADE\");\nDisk(77) = {9, 9, 0, 1};\n");
  test::expect_contains(refusal(both), "expected one of them");
  test::expect_contains(refusal(folder.path("none.geo")), "no such file");
  test::expect_contains(refusal(folder.write("bad.geo", "x = y;\n")), "line 1: Unknown variable 'y'");
  test::expect_contains(message_of<InputError>([&] { FreeMesher(rings, {{"m", 1}}); }), "unknown parameter");
  const std::string program = folder.write("program.geo", "Include \"" + rings + "\";\nSystemCall \"true\";\n");
  test::expect_contains(message_of<InputError>([&] { FreeMesher(program, {}, {.programs = false}); }),
                        "it runs a program; --no-programs");
}

// Curves and points inside a surface; a long list; a name that gmsh could not be given between quotes.
TEST(FreeMesher, WhatLiesWithinASurfaceIsKept) {
  const TemporaryFolder folder;
  std::string knots;
  for (int i = 1; i < 400; ++i)
    knots += "Point(" + std::to_string(100 + i) + ") = {" + std::to_string(i / 400.) + ", 1, 0};\n";
  const std::string geo = folder.write("a.geo", knots + R"(
    Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};
    Point(5) = {0.3, 0.31, 0}; Point(6) = {0.7, 0.31, 0};
    Line(1) = {1, 2}; Line(2) = {2, 3}; Spline(3) = {4, 101:499, 3}; Line(4) = {4, 1}; Line(5) = {5, 6};
    Curve Loop(1) = {1, 2, -3, 4}; Plane Surface(1) = {1}; Line{5} In Surface{1};
    Physical Surface("body") = {1}; Physical Curve("base") = {1};
  )");
  const Mesh mesh = FreeMesher(geo, {}).mesh([](const Vec2&) { return 0.08; });
  EXPECT_NEAR(free_area(mesh, 0), 1, 1e-12);
  int on_line = 0;
  for (int node = 0; node < mesh.nodes.rows(); ++node) {
    const Vec2 x = place(mesh, node);
    on_line += std::abs(x.y() - 0.31) < 1e-12 && x.x() > 0.29 && x.x() < 0.71;
  }
  EXPECT_EQ(on_line, 11);  // five edges of 0.08
}

// gmsh's tolerances are parts of the coordinates: at 1000 times the size it finds points in one place.
TEST(FreeMesher, MeshesFarFromTheOriginAsNearIt) {
  const TemporaryFolder folder;
  const std::string file = folder.write("far.geo", R"(DefineConstant[X = 0];
Point(1) = {X, -X, 0}; Point(2) = {X + 1, -X, 0}; Point(3) = {X, 1 - X, 0};
Line(1) = {1, 2}; Circle(2) = {2, 1, 3}; Line(3) = {3, 1}; Curve Loop(1) = {1:3}; Plane Surface(1) = {1};
Physical Surface("quarter") = {1}; Physical Curve("arc") = {2};)");
  const auto mesh_at = [&](double x) {
    const Vec2 corner(x, -x);
    return FreeMesher(file, {{"X", x}}).mesh([=](const Vec2& at) {
      return 1e-3 + 0.2 * (at - corner - Vec2(1, 0)).norm();
    });
  };
  const Mesh near = mesh_at(0);
  for (const double x : {1e3, 1e6}) {
    const Vec2 corner(x, -x);
    const double round_off = 1e-14 * x;
    const Mesh mesh = mesh_at(x);
    EXPECT_NEAR(double(mesh.cells.size()), double(near.cells.size()), 0.03 * double(near.cells.size()));
    EXPECT_NEAR((mesh.nodes.colwise().minCoeff().transpose() - corner).norm(), 0, round_off);
    ASSERT_EQ(mesh.boundaries.size(), 1u);
    for (const Edge& edge : mesh.boundaries[0].edges)
      EXPECT_NEAR((place(mesh, edge.nodes[0]) - corner).norm(), 1, round_off);
    for (const EdgeSamples& edge : mesh.boundaries[0].samples)
      EXPECT_NEAR((edge.pieces.front().places[4] - corner).norm(), 1, round_off);
  }
}

// Edges of 1e-8 of the geometry, as contacts that are found late ask for: quadrilaterals come out inverted at many
// sizes.
TEST(FreeMesher, MakesTrianglesWhereQuadrilateralsAreInverted) {
  FreeMesher mesher(MORTISE_SOURCE_DIR "/geo/rollers.geo", {{"rollers", 6}});
  for (const auto& [least, growth] :
       {std::pair(1.20481e-06, 0.49331), {1.10031e-06, 0.210613}, {2.39388e-06, 0.662866}}) {
    const auto size = [&](const Vec2& x) {
      return std::min(5.0, least + growth * std::min((x - Vec2(0, 40)).norm(), (x - Vec2(0, -40)).norm()));
    };
    EXPECT_NO_THROW(mesher.mesh(size, true)) << least;
  }
}

}  // namespace
}  // namespace mortise
