// What functions that the mesh does not follow do to the bars of p.
#include <gtest/gtest.h>

#include "app/solve_scene.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// Two blocks 2 wide, the upper one strained in a square 0.1 wide that stands on the line; its edges are vertices of
// meshes of 80 edges.
Results strained_blocks(int lower, int upper) {
  const TemporaryFolder folder;
  const auto edges = [](int count) { return std::to_string(count + 1); };
  folder.write("blocks.geo", R"(SetFactory("OpenCASCADE"); Mesh.ElementOrder = 2;
Rectangle(1) = {0, 0, 0, 2, 1}; Rectangle(2) = {0, 1, 0, 2, 0.6};
Transfinite Curve{1, 3} = )" + edges(lower) +
                                 "; Transfinite Curve{2, 4} = " + edges(lower / 2) + "; Transfinite Curve{5, 7} = " +
                                 edges(upper) + "; Transfinite Curve{6, 8} = " + edges(3 * upper / 10) + R"(;
Transfinite Surface{1, 2};
Physical Surface("lower") = {1}; Physical Surface("upper") = {2}; Physical Curve("bottom") = {1};
Physical Curve("sides") = {2, 4, 6, 8}; Physical Curve("lower_contact") = {3}; Physical Curve("upper_contact") = {5};
Physical Curve("top") = {7};)");
  Results r = solve_scene(read_scene(folder.write("scene.toml", R"(mesh.file = "blocks.geo"
materials.m = { young = 1000, poisson = 0.3 }
bodies = { lower = "m", upper = "m" }
boundary = [{ on = "bottom", displacement = { y = 0 } }, { on = "sides", displacement = { x = 0 } },
  { on = "top", pressure = 1 }]
initial_strain = [{ body = "upper", strain = { yy = "abs(x - 1) < 0.05 && y < 1.1 ? 1e-3 : 0", xx = 0, zz = 0, xy = 0 } }]
contact = [{ between = ["upper_contact", "lower_contact"], multipliers_on = "lower_contact" }]
)")));
  estimate(r);
  return r;
}

double pressure_at(const std::vector<ContactNode>& nodes, double x) {
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    const double a = nodes[i].position.x(), b = nodes[i + 1].position.x();
    if ((a - x) * (b - x) <= 0) return nodes[i].p + (x - a) / (b - a) * (nodes[i + 1].p - nodes[i].p);
  }
  ADD_FAILURE() << x;
  return 0;
}

TEST(DataEstimate, AStrainWithinACellOnTheLineIsInTheBarsBesideIt) {
  const Results fine = strained_blocks(60, 80);
  for (const int edges : {5, 7, 9, 13}) {
    const Results coarse = strained_blocks(edges, 2 * edges);
    for (const ContactNode& node : coarse.recovery.contacts[0].multiplier.nodes) {
      const double off = std::abs(node.p - pressure_at(fine.recovery.contacts[0].multiplier.nodes, node.position.x()));
      EXPECT_LE(off, node.p_error) << edges << " edges, x = " << node.position.x();
    }
  }
}

}  // namespace
}  // namespace mortise::test
