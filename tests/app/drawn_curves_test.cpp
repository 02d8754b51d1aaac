// One line drawn in two bodies as gmsh's curves, at random: it has no gap, whatever the meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "app/solve_scene.hpp"
#include "gmsh/load_mesh.hpp"
#include "gmsh/write_msh.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

using Random = std::mt19937;

double draw(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// What is drawn: a curve of gmsh from (0, .) to (1, .) through or by `heights`, each body's own points.
struct Drawing {
  std::string kind;
  std::vector<double> heights;
  std::vector<double> other{};  // of the upper body, where its curve is another
  int lower = 12, upper = 16, order = 2;
  bool reversed = false;  // the upper body's curve runs the other way
};

std::string geo_of(const Drawing& d) {
  std::ostringstream out;
  out.precision(17);
  const int count = int(d.heights.size());
  const auto curve = [&](int first, const std::vector<double>& heights, bool backwards) {
    for (int i = 0; i < count; ++i)
      out << "Point(" << first + i << ") = {" << i / double(count - 1) << ", " << heights[i] << ", 0};\n";
    out << d.kind << "(" << first << ") = {";
    for (int i = 0; i < count; ++i) out << (i > 0 ? ", " : "") << first + (backwards ? count - 1 - i : i);
    out << "};\n";
  };
  curve(1000, d.heights, false);
  curve(2000, d.other.empty() ? d.heights : d.other, d.reversed);
  const int a = 1000, b = 999 + count, c = 2000, e = 1999 + count;
  out << "Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};\n"
      << "Line(1) = {1, 2}; Line(2) = {2, " << b << "}; Line(3) = {" << a << ", 1};\n"
      << "Line(4) = {" << e << ", 3}; Line(5) = {3, 4}; Line(6) = {4, " << c << "};\n"
      << "Curve Loop(1) = {1, 2, -1000, 3}; Plane Surface(1) = {1};\n"
      << "Curve Loop(2) = {" << (d.reversed ? "-2000" : "2000") << ", 4, 5, 6}; Plane Surface(2) = {2};\n"
      << "Transfinite Curve {1, 1000} = " << d.lower + 1 << "; Transfinite Curve {5, 2000} = " << d.upper + 1 << ";\n"
      << "Transfinite Curve {2, 3, 4, 6} = 4;\n"
      << "Transfinite Surface {1} = {1, 2, " << b << ", " << a << "}; Transfinite Surface {2} = {" << c << ", " << e
      << ", 3, 4};\nRecombine Surface {1, 2};\n"
      << "Mesh.ElementOrder = " << d.order << "; Mesh.SecondOrderIncomplete = 1;\n"
      << "Physical Surface(\"lower\") = {1}; Physical Surface(\"upper\") = {2};\n"
      << "Physical Curve(\"below\") = {1000}; Physical Curve(\"above\") = {2000}; Physical Curve(\"bottom\") = {1};\n"
      << "Physical Curve(\"top\") = {5}; Physical Curve(\"sides\") = {2, 3, 4, 6};\n";
  return out.str();
}

Scene scene_on(const TemporaryFolder& folder, const std::string& mesh) {
  return read_scene(folder.write("a.toml", "[mesh]\nfile = \"" + mesh + R"("
[model]
plane = "strain"
[materials.steel]
young = 210e9
poisson = 0.3
[bodies]
upper = "steel"
lower = "steel"
[[boundary]]
on = ["sides"]
displacement = { x = 0 }
[[boundary]]
on = ["bottom"]
displacement = { y = 0 }
[[boundary]]
on = ["top"]
pressure = 10e6
[[contact]]
between = ["below", "above"]
)"),
                    {});
}

// A line of one or two waves with a step or none.
std::vector<double> heights(Random& random, int count) {
  const double amplitude = draw(random, 0.01, 0.06), waves = draw(random, 2, 7), phase = draw(random, 0, 6),
               step = draw(random, -0.05, 0.05), at = draw(random, 0.3, 0.7);
  std::vector<double> list;
  for (int i = 0; i < count; ++i) {
    const double x = i / double(count - 1);
    list.push_back(0.45 + amplitude * std::sin(waves * x + phase) + step * std::tanh(6 * (x - at)));
  }
  return list;
}

Drawing random_drawing(Random& random) {
  const std::array kinds{"Spline", "BSpline"};
  const std::array counts{5, 9, 21, 40, 81};
  const int edges = int(draw(random, 8, 30));
  return {.kind = kinds[random() % kinds.size()],
          .heights = heights(random, counts[random() % counts.size()]),
          .lower = edges,
          .upper = int(edges * draw(random, 0.6, 1.6)),
          .order = 1 + int(random() % 2),
          .reversed = random() % 2 == 1};
}

TEST(DrawnLines, OneLineHasNoGapWhateverTheMeshes) {
  Random random(11);
  for (int i = 0; i < 30; ++i) {
    const TemporaryFolder folder;
    const Drawing d = random_drawing(random);
    folder.write("a.geo", geo_of(d));
    const Problem checked = check_scene(scene_on(folder, folder.path("a.geo")));
    const std::string name = d.kind + " of " + std::to_string(d.heights.size()) + ", " + std::to_string(d.lower) + ":" +
                             std::to_string(d.upper) + (d.reversed ? " reversed" : "");
    for (const Boundary& boundary : checked.mesh.boundaries) EXPECT_EQ(boundary.undrawn, "") << name;
    EXPECT_EQ(checked.pairs[0].coupling.gap_min, 0) << name;
    EXPECT_EQ(checked.pairs[0].coupling.gap_max, 0) << name;
    // What the lines know of themselves would do without that, too.
    const ContactPair& pair = checked.pairs[0];
    for (std::size_t e = 0; e < pair.multiplier.edges.size(); ++e)
      EXPECT_LE(pair.geometry.multiplier->uncertainty(int(e)), 1e-13) << name;
  }
}

// Both curves have the same points but for one in the middle: a B-spline is changed by it in four intervals only.
TEST(DrawnLines, PartsThatAreOneLineAreClosedAndOthersKeepTheirGap) {
  Random random(3);
  for (int i = 0; i < 5; ++i) {
    const TemporaryFolder folder;
    Drawing d{.kind = "BSpline", .heights = heights(random, 21), .lower = 20, .upper = 27};
    d.other = d.heights;
    d.other[10] += 0.003;
    folder.write("a.geo", geo_of(d));
    const Problem checked = check_scene(scene_on(folder, folder.path("a.geo")));
    double largest = 0;
    for (const ContactPoint& p : checked.pairs[0].points) {
      const Edge& edge = checked.pairs[0].multiplier.edges[p.edge];
      const double x = checked.mesh.nodes(edge.nodes[0], 0);
      if (x < 0.3 || x > 0.7) EXPECT_EQ(p.gap, 0) << x;
      EXPECT_GE(p.gap, -1e-13);
      largest = std::max(largest, p.gap);
    }
    EXPECT_NEAR(largest, 0.003 * 2 / 3, 1e-4);  // the B-spline's value at its knot
  }
}

// The part of the nodes of the multiplier side whose bars hold what the multiplier differs by from another answer on
// the same mesh.
double held_part(const Results& answer, const Results& truth) {
  const std::vector<ContactNode>& nodes = answer.recovery.contacts[0].multiplier.nodes;
  std::size_t held = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    held += !(std::abs(nodes[k].p_multiplier - truth.recovery.contacts[0].multiplier.nodes[k].p_multiplier) >
              nodes[k].p_error);
  return double(held) / double(nodes.size());
}

TEST(DrawnLines, FromTheMeshAloneOneLineHasNoGapOrTheBarSaysWhatItCosts) {
  Random random(7);
  for (int i = 0; i < 12; ++i) {
    const TemporaryFolder folder;
    const Drawing d = random_drawing(random);
    write_msh(load_mesh(folder.write("a.geo", geo_of(d)), {}), folder.path("a.msh"));
    Scene scene = scene_on(folder, folder.path("a.msh"));
    Results open = solve_scene(scene);
    estimate(open);
    scene.contacts[0].initial_gap = InitialGap::closed;
    const Results closed = solve_scene(scene);
    EXPECT_GE(held_part(open, closed), 0.95) << i << " " << d.kind << " of " << d.heights.size();
  }
}

// Eight straight edges round a pin say less of it than its clearance, which a mesh of 60 shows.
TEST(DrawnLines, AGapThatTheNodesCannotTellIsInTheBar) {
  for (const char* n : {"8", "60"}) {
    const TemporaryFolder folder;
    Scene scene = read_scene(std::string(MORTISE_SOURCE_DIR) + "/tests/parts/pin_in_hole.toml",
                             {{"mesh.parameters.n", n}, {"mesh.parameters.order", "1"}});
    const Results drawn = solve_scene(scene);
    write_msh(drawn.problem.mesh, folder.path("a.msh"));
    scene.mesh_file = folder.path("a.msh");
    scene.mesh_parameters.clear();
    Results rebuilt = solve_scene(scene);
    estimate(rebuilt);
    EXPECT_GE(held_part(rebuilt, drawn), 0.95) << n;
    const bool known =
        std::ranges::none_of(rebuilt.problem.pairs[0].geometry.one_line, [](char one) { return one != 0; });
    EXPECT_EQ(known, n[0] == '6');
    if (known)
      EXPECT_NEAR(rebuilt.recovery.contacts[0].p_max, drawn.recovery.contacts[0].p_max,
                  2e-3 * drawn.recovery.contacts[0].p_max);
  }
}

}  // namespace
}  // namespace mortise::test
