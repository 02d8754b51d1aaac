// What a mesh misses at a corner, from the fields that are there.
#include <gtest/gtest.h>

#include <numbers>

#include "error/tail_shares.hpp"
#include "fem/assembly.hpp"

namespace mortise {
namespace {

const ElasticLaw law = elastic_law(1, 0.3, {Plane::strain});

// An L of squares, n to a side of each arm's width, the corner at the origin.
Mesh l_shape(int n, CellKind kind) {
  const int m = is_quadratic(kind) ? 2 : 1;  // nodes a cell's side
  const int side = 2 * n * m + 1;
  Mesh mesh;
  mesh.bodies = {"l"};
  std::vector<int> number(side * side, -1);
  std::vector<Vec2> nodes;
  const auto node = [&](int i, int j) {
    int& k = number[j * side + i];
    if (k < 0) {
      k = int(nodes.size());
      nodes.emplace_back(double(i) / (n * m) - 1, double(j) / (n * m) - 1);
    }
    return k;
  };
  for (int j = 0; j < 2 * n; ++j)
    for (int i = 0; i < 2 * n; ++i) {
      if (i >= n && j < n) continue;
      Cell cell{kind, 0, {}};
      if (m == 1)
        cell.nodes = {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
      else
        cell.nodes = {node(2 * i, 2 * j),         node(2 * i + 2, 2 * j), node(2 * i + 2, 2 * j + 2),
                      node(2 * i, 2 * j + 2),     node(2 * i + 1, 2 * j), node(2 * i + 2, 2 * j + 1),
                      node(2 * i + 1, 2 * j + 2), node(2 * i, 2 * j + 1)};
      mesh.cells.push_back(cell);
    }
  mesh.nodes.resize(Eigen::Index(nodes.size()), 2);
  for (std::size_t i = 0; i < nodes.size(); ++i) mesh.nodes.row(Eigen::Index(i)) = nodes[i].transpose();
  return mesh;
}

// The first mode of the free corner of 270 degrees (Williams 1952), symmetric about its bisector, by Airy's function
// r^(lambda + 1) (cos(lambda + 1) t + c cos(lambda - 1) t).
Vec2 mode(const Vec2& x) {
  constexpr double lambda = 0.5444837367, half = 0.75 * std::numbers::pi, kappa = 3 - 4 * 0.3;
  const double bisector = std::numbers::pi * 3 / 4, r = x.norm();
  double t = std::atan2(x.y(), x.x()) - bisector;
  if (t < -std::numbers::pi) t += 2 * std::numbers::pi;
  const double p = lambda + 1, m = lambda - 1, c = -std::cos(p * half) / std::cos(m * half);
  const double F = std::cos(p * t) + c * std::cos(m * t), dF = -p * std::sin(p * t) - m * c * std::sin(m * t);
  const double ur = (kappa + 1) * c * std::cos(m * t) - p * F, ut = (kappa + 1) * c * std::sin(m * t) - dF;
  const double angle = t + bisector;
  return std::pow(r, lambda) *
         Vec2(ur * std::cos(angle) - ut * std::sin(angle), ur * std::sin(angle) + ut * std::cos(angle));
}

VecX nodal(const Mesh& mesh, const std::function<Vec2(const Vec2&)>& u) {
  VecX values(2 * mesh.nodes.rows());
  for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i)
    values.segment<2>(2 * i) = mesh.nodes.row(i).norm() > 0 ? u(mesh.nodes.row(i).transpose()) : Vec2::Zero();
  return values;
}

MatX tails_of(const Mesh& mesh, const MatX& fields) {
  const SideTable table(mesh);
  TipTable tips;
  const std::vector<CornerRings> rings =
      corner_rings(mesh, table, body_corners({mesh, table, TiedVertices(), no_constraints(mesh), {law}, tips}));
  EXPECT_EQ(rings.size(), 1u);
  const std::vector<ElasticLaw> laws{law};
  CornerProducts products(mesh, laws, rings);
  const MatX identity = MatX::Identity(fields.cols(), fields.cols());
  products.add(fields.col(0), DualSums({{fields, identity}}));
  return products.tails();
}

TEST(CornerTails, PolynomialsMissWhatMuentzSays) {
  EXPECT_NEAR(missed_energy(0.5, 0), 1.0 / 9, 1e-15);
  EXPECT_NEAR(missed_energy(0.5, 1), 1.0 / 9 * 0.36, 1e-15);
  EXPECT_EQ(missed_energy(1, 1), 0);
}

// A stress without limit in u and in the dual: h^(2 lambda).
TEST(CornerTails, FallAsTheSizeToTwiceTheExponent) {
  for (const CellKind kind : {CellKind::quad4, CellKind::quad8}) {
    double before = 0;
    for (const int n : {2, 4, 8}) {
      const Mesh mesh = l_shape(n, kind);
      const VecX u = nodal(mesh, mode);
      MatX fields(u.size(), 2);
      fields << u, 3 * u;
      const MatX tails = tails_of(mesh, fields);
      EXPECT_GT(tails(0, 0), 0);
      EXPECT_NEAR(tails(0, 1), 3 * tails(0, 0), 1e-12 * tails(0, 1));
      if (before > 0) EXPECT_NEAR(before / tails(0, 0), std::pow(2, 2 * 0.5444837), 1e-6);
      before = tails(0, 0);
    }
  }
}

// A constant stress at a corner is none of its own, in either field.
TEST(CornerTails, AreNoneOfAStressThatIsBounded) {
  const Mesh mesh = l_shape(3, CellKind::quad8);
  const VecX singular = nodal(mesh, mode), even = nodal(mesh, [](const Vec2&x) { return Vec2(x.y(), 0.3 * x.x()); });
  MatX fields(even.size(), 2);
  fields << even, even;
  const double own = tails_of(mesh, fields)(0, 1);
  fields << singular, singular;
  EXPECT_LT(own, 1e-10 * tails_of(mesh, fields)(0, 1));
}

// All cells of the body have the corner: there is no second ring to tell the stress that is bounded.
TEST(CornerTails, OfABodyOfOneRingAreFinite) {
  const Mesh mesh = l_shape(1, CellKind::quad4);
  const VecX u = nodal(mesh, mode);
  MatX fields(u.size(), 2);
  fields << u, u;
  const MatX tails = tails_of(mesh, fields);
  EXPECT_TRUE(tails.allFinite());
  EXPECT_GT(tails(0, 1), 0);
}

// Of a body of one ring: of all that both fields, here of constant stress, work on one another, what polynomials miss,
// and more.
TEST(CornerTails, ArePartsOfTheWorkOfBothFields) {
  const Mesh mesh = l_shape(1, CellKind::quad4);
  const VecX u = nodal(mesh, [](const Vec2&x) { return Vec2(x.y(), 0.3 * x.x()); }),
             z = nodal(mesh, [](const Vec2&x) { return Vec2(2 * x.x() + x.y(), x.y()); });
  MatX fields(u.size(), 2);
  fields << u, z;
  const SparseMatrix lower = assemble_stiffness(mesh, {law});
  const VecX force = lower.selfadjointView<Eigen::Lower>() * u;
  const MatX tails = tails_of(mesh, fields);
  for (const int k : {0, 1}) {
    const double work = std::abs(force.dot(fields.col(k)));
    EXPECT_NEAR(tails(0, k), missed_more * missed_energy(0.5444837367, 0) * work, 1e-4 * work) << k;
  }
}

TEST(CornerTails, AtTheCornerItselfAreThoseOfItsCells) {
  const LocalTail tail{.position = {1, 2}, .exponent = 0.5, .radius = 0.1, .window = 0, .amplitude = 3};
  EXPECT_NEAR(tail.at({1, 2}), tail.at({1.1, 2}), 1e-9);
  EXPECT_NEAR(tail.at({1, 2.4}), 3 * std::pow(0.4, -1.5), 1e-12);
}

}  // namespace
}  // namespace mortise
