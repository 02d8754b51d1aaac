// What an error of the contact pressure does to other functionals.
#include "error/line_part.hpp"

#include <gtest/gtest.h>

#include "app/solve_scene.hpp"

namespace mortise::test {
namespace {

Results hertz(const char* n_upper) {
  Results r = solve_scene(read_scene(MORTISE_SOURCE_DIR "/geo/hertz.toml",
                                     {{"mesh.parameters.n_upper", n_upper}, {"mesh.parameters.n_lower", "5"}}));
  estimate(r);
  return r;
}

// The body of the multiplier side moved by 1 along y.
MatX moved(const Results& r) {
  MatX z = MatX::Zero(2 * r.problem.mesh.nodes.rows(), 1);
  for (const Cell& cell : r.problem.mesh.cells)
    if (cell.body == r.problem.pairs[0].multiplier.body)
      for (int a = 0; a < node_count(cell.kind); ++a) z(2 * cell.nodes[a] + 1, 0) = 1;
  return z;
}

TEST(LinePart, OpensByTheMotionAlongTheNormal) {
  const Results r = hertz("4");
  const VecX opened = openings(r.problem.pairs[0], moved(r)).col(0);
  for (Eigen::Index i = 0; i < opened.size(); ++i)
    EXPECT_NEAR(opened(i), -r.problem.pairs[0].points[i].normal.y(), 1e-12);
}

// Nothing that keeps the gap as it is lets an error of p in.
TEST(LinePart, IsNothingWhereNothingOpens) {
  const Results r = hertz("4");
  MatX z = MatX::Zero(2 * r.problem.mesh.nodes.rows(), 1);
  for (Eigen::Index i = 1; i < z.rows(); i += 2) z(i, 0) = 1;
  const PressureEstimate& e = r.estimate->pressures[0];
  const double of_unit =
      line_part(r.problem.pairs[0], e.line, e.local, openings(r.problem.pairs[0], moved(r))).sum()(0);
  EXPECT_LE(line_part(r.problem.pairs[0], e.line, e.local, openings(r.problem.pairs[0], z)).sum()(0), 1e-12 * of_unit);
}

// A unit opening does the work of all of p that the border may move: of a contact of two edges all of it.
TEST(LinePart, OfABorderIsTheForceOfTwoEdges) {
  for (const char* n : {"2", "4", "16"}) {
    const Results r = hertz(n);
    const PressureEstimate& e = r.estimate->pressures[0];
    ASSERT_EQ(e.local.borders.size(), 1u);
    const Eigen::Index edge = e.local.borders[0].edge;
    const bool before = e.line.p(edge) > e.line.p(edge + 1);
    const auto force = [&](Eigen::Index k) {
      return (e.line.s(k + 1) - e.line.s(k)) * (e.line.p(k) + e.line.p(k + 1)) / 2;
    };
    const double two = force(edge) + force(before ? edge - 1 : edge + 1);
    const LinePart part = line_part(r.problem.pairs[0], e.line, e.local, openings(r.problem.pairs[0], moved(r)));
    EXPECT_NEAR(part.borders(0, 0), two, 1e-3 * two) << n;  // edges of an arc, and its normals
  }
}

}  // namespace
}  // namespace mortise::test
