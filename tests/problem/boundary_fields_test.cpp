#include "problem/boundary_fields.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "fem/resolved_loads.hpp"
#include "support/two_plates.hpp"

namespace mortise::test {
namespace {

Field function(const std::string& text) { return {text, {.key = "boundary.0", .on_curve = true}}; }

NamedBoundary curve(const Mesh& mesh, const std::string& name) {
  const int boundary = boundary_index(mesh, name);
  return {boundary, sides_of(mesh, mesh.boundaries[boundary]), {}};
}

// int f over the top, 0 < x < 0.8, as the load of a traction.
double load_of(const std::string& text) {
  const Mesh mesh = mesh_of({});
  const NamedBoundary top = curve(mesh, "top");
  const Field field = function(text);
  const BoundaryFields fields(mesh, {top}, {&field});
  VecX load = VecX::Zero(2 * mesh.nodes.rows());
  const auto traction = [&](const Vec2& x, const Vec2&) { return Vec2(field(x), 0); };
  const auto cuts = [&](const Edge& edge) { return fields.cuts(top, 0, edge); };
  const double sum = add_traction(mesh, {}, CutSides{top.sides, cuts}, traction, load).force.x();
  EXPECT_NEAR(load.sum(), sum, 1e-12 * std::abs(sum));
  return sum;
}

TEST(BoundaryFields, MakeSumsOfLoadsExactOnAnyMesh) {
  EXPECT_NEAR(load_of("x < 0.437 ? 10 : 1"), 10 * 0.437 + 0.363, 1e-8);
  EXPECT_NEAR(load_of("1 + 40 * exp(-((x - 0.4137) / 0.0004)^2)"), 0.8 + 40 * 0.0004 * std::sqrt(std::numbers::pi),
              1e-8);
  EXPECT_NEAR(load_of("x^2"), 0.512 / 3, 1e-14);
}

TEST(PrescribedValues, HaveTheMeanOfTheFieldOnEachEdge) {
  const Mesh mesh = mesh_of({});
  const NamedBoundary top = curve(mesh, "top");
  for (const auto& [text, jump] : {std::pair("x < 0.437 ? 1 : 3", 0.437), std::pair("x^2", -1.0)}) {
    const std::map<int, double> values = prescribed_values(mesh, {top}, function(text));
    for (const Edge& edge : edges_of(mesh, top)) {
      const auto x = [&](int a) { return mesh.nodes(edge.nodes[a], 0); };
      const double low = std::min(x(0), x(1)), high = std::max(x(0), x(1));
      const double part = std::clamp((jump - low) / (high - low), 0.0, 1.0);
      const double mean = jump > 0 ? part + 3 * (1 - part) : (high * high + high * low + low * low) / 3;
      const auto value = [&](int a) { return values.at(edge.nodes[a]); };
      EXPECT_NEAR((value(0) + 4 * value(2) + value(1)) / 6, mean, 1e-8);
      EXPECT_EQ(value(0), function(text)(mesh.nodes.row(edge.nodes[0]).transpose()));
    }
  }
  EXPECT_TRUE(prescribed_values(mesh, {top}, Field(2)).empty());
}

}  // namespace
}  // namespace mortise::test
