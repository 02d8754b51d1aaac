// Singular points of curves that gmsh draws are their kinks.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "contact/contact_line.hpp"
#include "contact/curvature_jumps.hpp"
#include "gmsh/load_mesh.hpp"
#include "support/drawn_foot.hpp"
#include "support/points_of_pair.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

// Of the foot, without its ends.
std::vector<Vec2> kinks_of(const FootFile& file, const DrawnFoot& foot) {
  const TemporaryFolder folder;
  const Mesh mesh = load_mesh(folder.write("a.geo", file.geo), {});
  const std::vector<ElasticLaw> laws(2, elastic_law(210e9, 0.3, {Plane::strain}));
  TipTable tips;
  const Curve upper = contact_curve(mesh, boundary_index(mesh, "foot")),
              lower = contact_curve(mesh, boundary_index(mesh, "flat"));
  EXPECT_EQ(upper.samples.size(), upper.edges.size()) << mesh.boundaries[upper.boundary].undrawn;
  ContactReach reach = reached_everywhere(upper, lower);
  reach[0].front() = reach[0].back() = {false, false};
  std::vector<Vec2> found;
  for (const SingularPoint& p :
       points_of_pair({mesh, SideTable(mesh), TiedVertices(), no_constraints(mesh), laws, tips}, upper, lower, reach))
    found.push_back(p.position);
  // Smooth within an edge, too: a circle is one polynomial to round-off of its centre.
  for (std::size_t e = 0; e < upper.samples.size() && foot.pieces.size() == 1; ++e)
    if (foot.pieces[0].kind == "Circle") EXPECT_EQ(upper.samples[e].pieces.size(), 1u);
  EXPECT_TRUE(curvature_jumps(mesh.nodes, upper, ContactLine(mesh.nodes, upper)).empty() || foot.pieces.size() > 1 ||
              foot.pieces[0].kind.ends_with("pline"));
  return found;
}

// Arcs of radii up to 1e6 times their half width, whose places are known no better than those of their centres.
TEST(DrawnKinks, AreNoneWithinOneCurve) {
  std::mt19937 random(8);
  for (int i = 0; i < 25; ++i) {
    const DrawnFoot foot = random_foot(random, 1, -4);
    for (const Vec2& x : kinks_of(file_of(foot), foot))
      ADD_FAILURE() << i << ": (" << x.transpose() << ") of " << name_of(foot);
  }
}

TEST(DrawnKinks, AreFoundWhereCurvesMeetAtAnyAngle) {
  std::mt19937 random(9);
  for (int i = 0; i < 25; ++i) {
    const DrawnFoot foot = random_foot(random, 2 + int(random() % 2), -3);
    const FootFile file = file_of(foot);
    const std::vector<Vec2> found = kinks_of(file, foot);
    EXPECT_EQ(found.size(), foot.pieces.size() - 1) << i << ": " << name_of(foot);
    for (std::size_t k = 1; k < foot.pieces.size(); ++k)
      EXPECT_TRUE(
          std::ranges::any_of(found, [&](const Vec2& x) { return (x - file.vertices[k]).norm() < 1e-9 * foot.width; }))
          << i << ": " << name_of(foot);
  }
}

// At its kinks and at vertices of smooth pieces, each part a contact of its own.
TEST(DrawnKinks, AreThoseOfTheWholeCurveHoweverManyNamesItHas) {
  std::mt19937 random(10);
  int kinks = 0;
  for (int i = 0; i < 25; ++i) {
    const DrawnFoot foot = random_foot(random, 1 + int(random() % 3), -3);
    const TemporaryFolder folder;
    const Mesh mesh = load_mesh(folder.write("a.geo", file_of(foot).geo), {});
    const std::vector<ElasticLaw> laws(2, elastic_law(210e9, 0.3, {Plane::strain}));
    const Constraints free = no_constraints(mesh);
    const SideTable table(mesh);
    const TiedVertices ties;
    TipTable tips;
    const Surroundings around{mesh, table, ties, free, laws, tips};
    const Curve upper = contact_curve(mesh, boundary_index(mesh, "foot")),
                lower = contact_curve(mesh, boundary_index(mesh, "flat"));
    ContactReach reach = reached_everywhere(upper, lower);
    reach[0].front() = reach[0].back() = {false, false};
    const auto whole = singular_points({contact_places(around, upper, lower, reach)}, tips)[0];
    std::set<std::size_t> cuts{0, upper.edges.size()};
    for (std::size_t e = 1; e < upper.edges.size(); ++e) {
      const Vec2 x = mesh.nodes.row(upper.edges[e].nodes[0]).transpose();
      const bool is_kink = std::ranges::any_of(whole, [&](const SingularPoint& p) { return p.position == x; });
      if (random() % (is_kink ? 2 : 8) == 0) cuts.insert(e);
    }
    std::vector<std::vector<ContactPlace>> places;
    for (auto from = cuts.begin(), to = std::next(from); to != cuts.end(); from = to++) {
      Curve part = upper;
      part.edges = {upper.edges.begin() + *from, upper.edges.begin() + *to};
      part.samples = {upper.samples.begin() + *from, upper.samples.begin() + *to};
      ContactReach of_part = reached_everywhere(part, lower);
      if (*from == 0) of_part[0].front() = {false, false};
      if (*to == upper.edges.size()) of_part[0].back() = {false, false};
      places.push_back(contact_places(around, part, lower, of_part));
    }
    std::vector<SingularPoint> found;
    for (const auto& points : singular_points(places, tips))
      for (const SingularPoint& point : points)
        if (std::ranges::none_of(found, [&](const auto& p) { return p.position == point.position; }))
          found.push_back(point);
    ASSERT_EQ(found.size(), whole.size()) << i << ": " << name_of(foot);
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_NEAR(found[k].pressure_exponent, whole[k].pressure_exponent, 1e-6) << i;
      EXPECT_NEAR(found[k].log_pressure, whole[k].log_pressure, 1e-6 * whole[k].log_pressure) << i;
    }
    kinks += int(whole.size());
  }
  EXPECT_GE(kinks, 12);
}

}  // namespace
}  // namespace mortise::test
