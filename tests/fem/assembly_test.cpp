#include "fem/assembly.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "fem/constraints.hpp"
#include "fem/patch_recovery.hpp"
#include "fem/stress.hpp"
#include "mesh/side_table.hpp"
#include "model/moduli.hpp"
#include "support/two_plates.hpp"

namespace mortise {
namespace {

constexpr double pi = std::numbers::pi;

using test::TwoPlates;

constexpr CellKind kinds[] = {CellKind::tri3, CellKind::tri6, CellKind::quad4, CellKind::quad8, CellKind::quad9};

Mesh curved_plates(CellKind kind) {
  TwoPlates plates;
  plates.height = [](double x) { return -1.25 * x * x + x + 0.2; };
  plates.n_upper = 5;
  plates.n_lower = 8;
  plates.kind_upper = plates.kind_lower = kind;
  return test::mesh_of(plates);
}

VecX field(const Mesh& mesh, const std::function<Vec2(const Vec2&)>& u) {
  VecX values(2 * mesh.nodes.rows());
  for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i) values.segment<2>(2 * i) = u(mesh.nodes.row(i).transpose());
  return values;
}

TEST(Stiffness, ResistsNoRigidMotion) {
  for (const CellKind kind : kinds) {
    const Mesh mesh = curved_plates(kind);
    const SparseMatrix K = assemble_stiffness(mesh, std::vector<ElasticLaw>(2, elastic_law(1, 0.3, {Plane::strain})));
    for (const auto& motion :
         {field(mesh, [](const Vec2&) { return Vec2(1, 0); }), field(mesh, [](const Vec2&) { return Vec2(0, 1); }),
          field(mesh, [](const Vec2& x) { return Vec2(-x.y(), x.x()); })})
      EXPECT_LE((K.selfadjointView<Eigen::Lower>() * motion).cwiseAbs().maxCoeff(), 1e-14);
  }
}

// Coordinates and displacements that doubles have exactly there as well.
TEST(Stiffness, IsTheSameFarFromTheOriginAndSoAreStresses) {
  constexpr double unit = 1. / (1 << 20), far = 4294967296;  // 2^32
  const auto rounded = [&](double value) { return std::round(value / unit) * unit; };
  const std::vector<ElasticLaw> laws(2, elastic_law(1, 0.3, {Plane::strain}));
  for (const CellKind kind : kinds) {
    Mesh mesh = curved_plates(kind);
    mesh.nodes = mesh.nodes.unaryExpr(rounded).eval();
    const VecX u =
        field(mesh, [](const Vec2& x) { return Vec2(std::sin(3 * x.x()), x.x() * x.y()); }).unaryExpr(rounded);
    const SparseMatrix K = assemble_stiffness(mesh, laws);
    const Stresses stress = recover_stress(mesh, body_points(mesh), laws, u).points;
    mesh.nodes.array() += far;
    EXPECT_EQ((assemble_stiffness(mesh, laws) - K).norm(), 0);
    EXPECT_EQ((recover_stress(mesh, body_points(mesh), laws, u.array() + far).points - stress).norm(), 0);
  }
}

TEST(Stiffness, IsTheSameOnAnyNumberOfThreads) {
  TwoPlates plates;  // enough nodes for three
  plates.n_upper = 90;
  plates.n_lower = 240;
  const Mesh mesh = test::mesh_of(plates);
  ASSERT_GT(mesh.nodes.rows(), 60000);
  const std::vector<ElasticLaw> laws{elastic_law(3, 0.25, {Plane::stress}), elastic_law(1, 0.3, {Plane::strain})};
  const SparseMatrix one = assemble_stiffness(mesh, laws);
  for (const int threads : {2, 3, 7}) {
    const SparseMatrix K = assemble_stiffness(mesh, laws, threads);
    ASSERT_EQ(K.nonZeros(), one.nonZeros());
    EXPECT_TRUE(std::equal(one.outerIndexPtr(), one.outerIndexPtr() + one.cols() + 1, K.outerIndexPtr()));
    EXPECT_TRUE(std::equal(one.innerIndexPtr(), one.innerIndexPtr() + one.nonZeros(), K.innerIndexPtr()));
    EXPECT_TRUE(std::equal(one.valuePtr(), one.valuePtr() + one.nonZeros(), K.valuePtr()));
  }
}

TEST(Stiffness, EnergyOfUniformStrainIsExactOnStraightElements) {
  for (const CellKind kind : kinds) {
    TwoPlates plates;
    plates.kind_upper = plates.kind_lower = kind;
    const Mesh mesh = test::mesh_of(plates);
    const ElasticLaw law = elastic_law(3, 0.25, {Plane::stress});
    const SparseMatrix K = assemble_stiffness(mesh, {law, law});
    const VecX u = field(mesh, [](const Vec2& x) { return Vec2(0.1 * x.x() + 0.2 * x.y(), -0.3 * x.y()); });
    const Vec4 strain(0.1, -0.3, 0, 0.2);
    const Vec4 stress = law.stiffness * strain;
    const double density = 0.5 * (stress(0) * strain(0) + stress(1) * strain(1) + stress(3) * strain(3));
    EXPECT_NEAR(0.5 * u.dot(K.selfadjointView<Eigen::Lower>() * u), density * 0.8 * 0.6, 1e-14);
  }
}

TEST(Law, PlaneStressHasNoStressAcrossAndPlaneStrainNoStrain) {
  const Vec4 strain(1e-3, -2e-3, 0, 5e-4);
  const Vec4 flat = elastic_law(200, 0.3, {Plane::stress}).stiffness * strain;
  EXPECT_EQ(flat(2), 0);
  const Vec4 thick = elastic_law(200, 0.3, {Plane::strain}).stiffness * strain;
  EXPECT_NEAR(thick(2), 0.3 * (thick(0) + thick(1)), 1e-15);
  // Uniaxial plane stress: sigma = E eps when eps_22 = -nu eps_11.
  const Vec4 bar = elastic_law(200, 0.3, {Plane::stress}).stiffness * Vec4(1e-3, -0.3e-3, 0, 0);
  EXPECT_NEAR(bar(0), 0.2, 1e-15);
  EXPECT_NEAR(bar(1), 0, 1e-16);
}

TEST(Law, OrthotropicIsIsotropicWhereTheModuliAre) {
  for (const Plane plane : {Plane::stress, Plane::strain, Plane::axisymmetric}) {
    const Mat4 any = *orthotropic_stiffness(
        {.e1 = 200, .e2 = 200, .e3 = 200, .nu12 = 0.3, .nu13 = 0.3, .nu23 = 0.3, .g12 = 200 / 2.6, .angle = 0.4});
    const ElasticLaw law = elastic_law(plane == Plane::stress ? without_33(any) : any, {plane}, 200),
                     isotropic = elastic_law(200, 0.3, {plane});
    EXPECT_LE((law.stiffness - isotropic.stiffness).cwiseAbs().maxCoeff(), 1e-12 * 200);
    EXPECT_LE((law.compliance - isotropic.compliance).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_NEAR(contact_modulus(law), contact_modulus(isotropic), 1e-12 * 200);
  }
}

// A bar along x1, its fibres at 30 degrees to it: 1 / E = c^4 / E1 + (1 / G12 - 2 nu12 / E1) c^2 s^2 + s^4 / E2
// (Jones 1999, eq. 2.97).
TEST(Law, OrthotropicOffItsAxesHasTheModulusOfJones) {
  const OrthotropicModuli m{
      .e1 = 140, .e2 = 10, .e3 = 9, .nu12 = 0.3, .nu13 = 0.25, .nu23 = 0.4, .g12 = 5, .angle = pi / 6};
  const ElasticLaw law = elastic_law(without_33(*orthotropic_stiffness(m)), {Plane::stress}, m.e1);
  EXPECT_NEAR(law.compliance(0, 0), 9.0 / 16 / 140 + (1.0 / 5 - 0.6 / 140) * 3 / 16 + 1.0 / 16 / 10, 1e-15);
}

TEST(Law, ModuliWithoutPositiveEnergyAreNone) {
  OrthotropicModuli m{.e1 = 1, .e2 = 1, .e3 = 1, .nu12 = 0.3, .nu13 = 0.3, .nu23 = 0.3, .g12 = 1};
  EXPECT_TRUE(orthotropic_stiffness(m));
  m.nu12 = 1.01;
  EXPECT_FALSE(orthotropic_stiffness(m));
  m.nu12 = std::nan("");
  EXPECT_FALSE(orthotropic_stiffness(m));
}

// Stiffness and stress of any law: 1/2 u K u is the energy of a uniform strain, and the stress is C : eps.
TEST(Stiffness, OfAnOrthotropicLawIsItsEnergy) {
  const Mat4 C = *orthotropic_stiffness(
      {.e1 = 140, .e2 = 10, .e3 = 9, .nu12 = 0.3, .nu13 = 0.25, .nu23 = 0.4, .g12 = 5, .angle = 0.7});
  for (const CellKind kind : kinds) {
    TwoPlates plates;
    plates.kind_upper = plates.kind_lower = kind;
    const Mesh mesh = test::mesh_of(plates);
    const ElasticLaw law = elastic_law(C, {Plane::strain}, 140);
    const SparseMatrix K = assemble_stiffness(mesh, {law, law});
    const VecX u = field(mesh, [](const Vec2& x) { return Vec2(0.1 * x.x() + 0.2 * x.y(), -0.3 * x.y()); });
    const Vec4 strain(0.1, -0.3, 0, 0.2);
    EXPECT_NEAR(0.5 * u.dot(K.selfadjointView<Eigen::Lower>() * u), 0.5 * strain.dot(C * strain) * 0.8 * 0.6, 1e-13);
    const StressSamples samples = sample_stresses(mesh, {law, law}, u);
    const Vec4 stress = C * strain;
    EXPECT_LE((samples.stresses.rowwise() - Eigen::RowVector3d(stress(0), stress(1), stress(3))).cwiseAbs().maxCoeff(),
              1e-11);
    EXPECT_NEAR(law.out_of_plane.dot(Eigen::RowVector3d(stress(0), stress(1), stress(3))), stress(2), 1e-12);
  }
}

TEST(Law, FreeThermalExpansionIsWithoutStressInThePlane) {
  const double e = 1e-3;
  for (const Plane plane : {Plane::stress, Plane::strain}) {
    const ElasticLaw law = elastic_law(200, 0.3, {plane}, [=](const Vec2&) { return Vec4(e, e, e, 0); });
    const double in_plane = plane == Plane::strain ? 1.3 * e : e;  // (1 + nu) alpha dT in plane strain
    const Vec4 s = law.stiffness * Vec4(in_plane, in_plane, 0, 0) + law.stress0(Vec2::Zero());
    EXPECT_NEAR(s(0), 0, 1e-15);
    EXPECT_NEAR(s(1), 0, 1e-15);
    EXPECT_NEAR(s(2), plane == Plane::strain ? -200 * e : 0, 1e-15);
  }
}

TEST(Law, VonMisesOfKnownStates) {
  EXPECT_NEAR(von_mises(Vec4(5, 0, 0, 0)), 5, 1e-15);
  EXPECT_NEAR(von_mises(Vec4(0, 0, 0, 2)), 2 * std::sqrt(3), 1e-15);
  EXPECT_NEAR(von_mises(Vec4(-7, -7, -7, 0)), 0, 1e-15);
}

TEST(Loads, PressureOnAClosedOutlineIsInBalance) {
  for (const CellKind kind : kinds) {
    const Mesh mesh = curved_plates(kind);
    VecX load = VecX::Zero(2 * mesh.nodes.rows());
    for (const char* name : {"top", "upper_left", "upper_right", "upper_contact"})
      add_traction(
          mesh, {}, sides_of(mesh, mesh.boundaries[boundary_index(mesh, name)]),
          [](const Vec2&, const Vec2& n) -> Vec2 { return -3 * n; }, load);
    Vec2 force = Vec2::Zero();
    double moment = 0;
    for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i) {
      force += load.segment<2>(2 * i);
      moment += mesh.nodes(i, 0) * load(2 * i + 1) - mesh.nodes(i, 1) * load(2 * i);
    }
    EXPECT_LE(force.norm(), 1e-14);
    EXPECT_LE(std::abs(moment), 1e-14);
  }
}

TEST(Loads, BodyForceSumsToForceTimesArea) {
  for (const CellKind kind : kinds) {
    TwoPlates plates;
    plates.kind_upper = plates.kind_lower = kind;
    const Mesh mesh = test::mesh_of(plates);
    VecX load = VecX::Zero(2 * mesh.nodes.rows());
    const Vec2 summed = add_body_forces(mesh, {}, {BodyForce(), [](const Vec2&) { return Vec2(2, -5); }}, load).force;
    Vec2 sum = Vec2::Zero();
    for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i) sum += load.segment<2>(2 * i);
    EXPECT_NEAR(sum.x(), 2 * 0.24, 1e-14);
    EXPECT_NEAR(sum.y(), -5 * 0.24, 1e-14);
    EXPECT_LE((summed - sum).norm(), 1e-14);
  }
}

TEST(Stress, OfALinearFieldIsExactEverywhere) {
  for (const CellKind kind : kinds) {
    const Mesh mesh = curved_plates(kind);
    const std::vector<ElasticLaw> laws(2, elastic_law(3, 0.25, {Plane::strain}));
    const VecX u =
        field(mesh, [](const Vec2& x) { return Vec2(0.1 * x.x() + 0.2 * x.y(), 0.4 * x.x() - 0.3 * x.y()); });
    const Vec4 exact = laws[0].stiffness * Vec4(0.1, -0.3, 0, 0.6);
    const StressField s = recover_stress(mesh, body_points(mesh), laws, u);
    const FieldStresses samples = sample_stresses(mesh, laws, u).stresses;
    const Eigen::RowVector3d exact_there(exact(0), exact(1), exact(3));
    EXPECT_LE((samples.rowwise() - exact_there).cwiseAbs().maxCoeff(), 1e-12);
    for (const Stresses* field : {&s.points, &s.centres})
      EXPECT_LE((field->rowwise() - exact.transpose()).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(Stress, OfAQuadraticFieldIsExactAtTheNodesOfRectangles) {
  // 8- and 9-node rectangles: the stress is linear, their 2 x 2 samples are exact, and so is the extension.
  for (const CellKind kind : {CellKind::quad8, CellKind::quad9}) {
    TwoPlates plates;
    plates.kind_upper = plates.kind_lower = kind;
    const Mesh mesh = test::mesh_of(plates);
    const std::vector<ElasticLaw> laws(2, elastic_law(3, 0.25, {Plane::strain}));
    const VecX u = field(mesh, [](const Vec2& x) { return Vec2(x.x() * x.x() + x.x() * x.y(), x.y() * x.y()); });
    const BodyPoints points = body_points(mesh);
    const StressField s = recover_stress(mesh, points, laws, u);
    for (std::size_t p = 0; p < points.node.size(); ++p) {
      const Vec2 x = mesh.nodes.row(points.node[p]).transpose();
      const Vec4 exact = laws[0].stiffness * Vec4(2 * x.x() + x.y(), 2 * x.y(), 0, x.x());
      EXPECT_LE((s.points.row(p).transpose() - exact).cwiseAbs().maxCoeff(), 1e-11);
    }
  }
}

TEST(CheckCells, NamesTheInvertedElement) {
  for (const CellKind kind : kinds) {
    Mesh mesh = test::mesh_of({[](double) { return 0.3; }, 3, 4, kind, kind});
    EXPECT_NO_THROW(check_cells(mesh));
    const Cell& cell = mesh.cells[2];
    const Vec2 a = mesh.nodes.row(cell.nodes[1]);
    mesh.nodes.row(cell.nodes[1]) = mesh.nodes.row(cell.nodes[0]) - (a.transpose() - mesh.nodes.row(cell.nodes[0]));
    EXPECT_THROW(check_cells(mesh), std::runtime_error);
  }
}

}  // namespace
}  // namespace mortise
