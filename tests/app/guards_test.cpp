// Where a pressure cannot be trusted, a run says so: errors, notes and defaults of docs/stability.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/solve_scene.hpp"
#include "problem/dirichlet_neumann.hpp"
#include "results/diagnose.hpp"
#include "results/warnings.hpp"
#include "support/messages.hpp"
#include "support/plate_scenes.hpp"

namespace mortise::test {
namespace {

bool noted(const Results& r, const std::string& part) {
  return std::any_of(r.warnings.begin(), r.warnings.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

std::string all_notes(const Results& r) {
  std::string all;
  for (const std::string& note : r.warnings) all += note + "\n";
  return all.empty() ? "(no notes)" : all;
}

BoundarySpec moved(const char* on, double y) {
  BoundarySpec b;
  b.key = "boundary";
  b.on = {on};
  b.what = Displacement{{}, y};
  return b;
}

Scene solved_by(Scene scene, Solver kind) {
  scene.method.solver = kind;
  return scene;
}

// ---- Prescribed contact curves ----

TEST(PrescribedContact, OnBothCurvesEverywhereIsAnError) {
  Scene s = uniaxial_scene();
  s.boundaries.push_back(moved("upper_contact", 0));
  s.boundaries.push_back(moved("lower_contact", 0));
  for (const Solver kind : {Solver::direct, Solver::ddm})
    expect_contains(message_of([&] { solve_scene(solved_by(s, kind), mesh_of({})); }), "contact has nothing to decide");
}

TEST(PrescribedContact, ThatOverlapsIsAnErrorThatNamesThePlace) {
  Scene s = uniaxial_scene();
  s.boundaries.push_back(moved("upper_contact", -1e-5));
  s.boundaries.push_back(moved("lower_contact", 0));
  const std::string message = message_of([&] { solve_scene(s, mesh_of({})); });
  expect_contains(message, "overlap by 1e-05 near (");
}

TEST(PrescribedContact, OfOneBodyGivesTheOtherTheDisplacementInDomainDecomposition) {
  Scene s = uniaxial_scene();
  s.boundaries.push_back(moved("lower_contact", 0));
  TwoPlates plates;
  plates.n_upper = 5;  // the lower body is the finer one, which would take the displacement
  const Results r = solve_scene(solved_by(s, Solver::ddm), mesh_of(plates));
  ASSERT_TRUE(r.solution.iteration.has_value());
  EXPECT_EQ(dirichlet_names(r.problem.mesh, r.problem.dirichlet), std::vector<std::string>{"upper"});
  EXPECT_NE(r.status, Status::not_converged);
  EXPECT_NEAR(r.recovery.contacts[0].p_min, 10e6, 1);
  EXPECT_NEAR(r.recovery.contacts[0].p_max, 10e6, 1);
}

// ---- Curves ----

TEST(Curves, WithACommonNodeAreAnError) {
  Mesh mesh = mesh_of({});
  // The first node of the upper contact curve becomes that of the lower one, which lies at the same place.
  const auto at = [&](const char* name) {
    for (const Edge& edge : mesh.boundaries[boundary_index(mesh, name)].edges)
      for (const int node : {edge.nodes[0], edge.nodes[1]})
        if (std::abs(mesh.nodes(node, 0)) < 1e-12) return node;
    return -1;
  };
  const int kept = at("lower_contact"), gone = at("upper_contact");
  ASSERT_NE(kept, gone);
  const auto renamed = [&](int from, int to) {
    for (Cell& cell : mesh.cells) std::replace(cell.nodes.begin(), cell.nodes.end(), from, to);
    for (Boundary& boundary : mesh.boundaries)
      for (Edge& edge : boundary.edges) std::replace(edge.nodes.begin(), edge.nodes.end(), from, to);
  };
  const int last = int(mesh.nodes.rows()) - 1;  // takes the place of the node that goes
  renamed(gone, kept);
  mesh.nodes.row(gone) = mesh.nodes.row(last);
  renamed(last, gone);
  mesh.nodes.conservativeResize(last, 2);
  expect_contains(message_of([&] { solve_scene(uniaxial_scene(), mesh); }), "have a common node near (0, 0.3)");
}

TwoPlates tent(int n_upper, int n_lower) {
  TwoPlates plates;
  plates.height = [](double x) { return 0.3 - 0.2 * std::abs(x - 0.4); };  // turns by 23 degrees
  plates.n_upper = n_upper;
  plates.n_lower = n_lower;
  return plates;
}

TEST(Curves, AKinkThatOneMeshCutsShortIsNoted) {
  EXPECT_FALSE(noted(solve_scene(hydrostatic_scene(), mesh_of(tent(8, 10))), "kink"));
  const Results r = solve_scene(hydrostatic_scene(), mesh_of(tent(8, 11)));
  EXPECT_TRUE(noted(r, "'upper_contact' has a kink of 23 degrees near (0.4, 0.3)")) << all_notes(r);
}

TEST(Curves, EdgesThatTurnTooFarAreNoted) {
  TwoPlates plates;
  plates.height = [](double x) { return 0.3 + 0.05 * std::cos(2 * EIGEN_PI * x / 0.4); };
  plates.n_upper = 6;
  plates.n_lower = 8;
  const Results coarse = solve_scene(clamped_scene(), mesh_of(plates));
  EXPECT_TRUE(noted(coarse, "degrees: the mesh is too coarse for the curve")) << all_notes(coarse);
  plates.n_upper = 40;
  plates.n_lower = 50;
  const Results fine = solve_scene(clamped_scene(), mesh_of(plates));
  EXPECT_FALSE(noted(fine, "the mesh is coarse")) << all_notes(fine);
}

Scene contrast(double ratio) {
  Scene s = clamped_scene();
  s.materials["stiff"] = {210e9 * ratio, 0.3, 0};
  s.bodies[0].material = "stiff";  // upper
  return s;
}

// The lower plate's edges are 0.1 long; the upper plate is squeezed to a width of its own. Multipliers on the lower
// one.
Results narrow_upper_plate(double width) {
  TwoPlates plates;
  plates.n_lower = 8;
  Mesh mesh = mesh_of(plates);
  std::vector<char> of_upper(mesh.nodes.rows(), 0);
  for (const Cell& cell : mesh.cells)
    if (mesh.bodies[cell.body] == "upper")
      for (int a = 0; a < node_count(cell.kind); ++a) of_upper[cell.nodes[a]] = 1;
  for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i)
    if (of_upper[i]) mesh.nodes(i, 0) *= width / 0.8;
  Scene s = contrast(1e-6);
  s.boundaries[0].on = {"upper_left", "lower_left"};
  s.contacts[0].multipliers_on = "lower_contact";
  return solve_scene(s, std::move(mesh));
}

TEST(Curves, AMultiplierWhoseEdgeHardlyFacesTheOtherSideFollowsItsNeighbour) {
  // On the much stiffer base p is that of a flat die, 10 MPa.
  for (const double width : {0.50001, 0.501, 0.51}) {
    const Results r = narrow_upper_plate(width);
    EXPECT_TRUE(noted(r, "(x = 0.6, y = 0.3) whose edges hardly face the other side")) << width << all_notes(r);
    EXPECT_NEAR(r.recovery.contacts[0].p_max, 10e6, 1e6) << width;
  }
  EXPECT_FALSE(noted(narrow_upper_plate(0.53), "hardly face"));
  Results found = narrow_upper_plate(0.501), open = found;
  found.problem.accuracy.emplace();  // nobody can help what its mesh faces
  open.recovery.contacts[0].pressure.setZero();
  for (const Results* r : {&found, &open})
    for (const std::string& line : warnings(*r, large_displacement(*r)))
      EXPECT_EQ(line.find("hardly face"), std::string::npos) << line;
}

TEST(Curves, TheSideAtALimitDoesNotHangOnWhereTheSceneLies) {
  // Straight edges exactly 1.5 times as long as the other side's, from places where lengths round differently.
  TwoPlates plates;
  plates.kind_upper = plates.kind_lower = CellKind::quad4;
  plates.n_upper = 6, plates.n_lower = 9;
  for (int k = 0; k < 20; ++k) {
    Mesh mesh = mesh_of(plates);
    mesh.nodes.array() += 0.1 * k * std::sqrt(2);
    EXPECT_EQ(solve_scene(uniaxial_scene(), std::move(mesh)).problem.pairs[0].spec.multipliers_on, "lower_contact")
        << k;
  }
}

// ---- Stiffness ----

TEST(Stiffness, TheMuchStifferBodyDoesNotCarryTheMultipliersByDefault) {
  TwoPlates plates;
  plates.n_upper = 24;
  plates.n_lower = 8;
  const auto side = [&](double ratio) {
    return solve_scene(contrast(ratio), mesh_of(plates)).problem.pairs[0].spec.multipliers_on;
  };
  EXPECT_EQ(side(1), "upper_contact");  // the finer one
  EXPECT_EQ(side(9), "upper_contact");
  EXPECT_EQ(side(11), "lower_contact");
  EXPECT_EQ(side(1e6), "lower_contact");
}

TEST(Curves, LongStraightEdgesCarryTheMultipliersByDefault) {
  const auto side = [](int n_upper, CellKind kind) {
    TwoPlates plates;
    plates.kind_upper = plates.kind_lower = kind;
    plates.n_upper = n_upper;
    plates.n_lower = 10;
    return solve_scene(clamped_scene(), mesh_of(plates)).problem.pairs[0].spec.multipliers_on;
  };
  EXPECT_EQ(side(14, CellKind::quad4), "upper_contact");
  EXPECT_EQ(side(16, CellKind::quad4), "lower_contact");
  EXPECT_EQ(side(6, CellKind::tri3), "upper_contact");
  EXPECT_EQ(side(16, CellKind::quad8), "upper_contact");
}

TEST(Stiffness, TheInfSupConstantTellsAndItsNoteSaysWhatToDo) {
  TwoPlates plates;
  plates.height = [](double x) { return -1.25 * x * x + x + 0.2; };
  plates.kind_upper = plates.kind_lower = CellKind::quad4;
  plates.n_upper = 24;
  plates.n_lower = 8;
  const auto beta = [&](Scene s, const std::string& side, bool& warned) {
    s.contacts[0].multipliers_on = side;
    Results r = solve_scene(s, mesh_of(plates));
    diagnose(r);
    warned = noted(r, "the inf-sup constant is");
    return r.inf_sup->beta;
  };
  bool warned = false;
  EXPECT_GT(beta(contrast(1), "upper_contact", warned), inf_sup_limit);
  EXPECT_FALSE(warned);
  EXPECT_LT(beta(contrast(1e4), "upper_contact", warned), inf_sup_limit / 10);
  EXPECT_TRUE(warned);
  EXPECT_GT(beta(contrast(1e4), "", warned), inf_sup_limit);
  EXPECT_FALSE(warned);
}

TEST(Stiffness, TheInfSupConstantDoesNotDependOnTheMeshNorOnUnits) {
  std::vector<double> beta;
  for (const int n : {8, 16, 32}) {
    TwoPlates plates;
    plates.height = [](double x) { return -1.25 * x * x + x + 0.2; };
    plates.n_upper = n;
    plates.n_lower = n * 5 / 4;
    Scene s = clamped_scene();
    Results r = solve_scene(s, mesh_of(plates));
    diagnose(r);
    beta.push_back(r.inf_sup->beta);
    Mesh millimetres = mesh_of(plates);
    millimetres.nodes *= 1000;
    s.materials["steel"].young = 210e3;
    s.boundaries.back().what = Pressure{10};
    Results same = solve_scene(s, std::move(millimetres));
    diagnose(same);
    EXPECT_NEAR(same.inf_sup->beta, beta.back(), 1e-9);
  }
  EXPECT_GT(beta.back(), 0.9 * beta.front());
  EXPECT_LT(beta.back(), 1.1 * beta.front());
}

// ---- Contact that just touches ----

// p and the gap are zero at once: no row may chatter, no check may compare round-off with round-off.
TEST(Touching, IsSolvedWithoutPressure) {
  Scene s = uniaxial_scene();  // pulled along the contact line instead of pressed on it
  s.contacts[0].condition = Condition::unilateral;
  s.boundaries.back() = {};
  s.boundaries.back().key = "boundary";
  s.boundaries.back().on = {"upper_right", "lower_right"};
  s.boundaries.back().what = Pressure{10e6};
  for (const Multipliers space : {Multipliers::linear, Multipliers::quadratic, Multipliers::dual}) {
    s.method.multipliers = space;
    const Results r = solve_scene(s, mesh_of({}));
    EXPECT_EQ(r.status, Status::solved) << to_string(space);
    EXPECT_LT(r.recovery.contacts[0].p_max, 1e-3);
    EXPECT_LE(r.solution.steps.size(), 3U);
  }
}

// ---- What the equations and the elements can do ----

TEST(Limits, NearlyIncompressibleBodiesAreNoted) {
  Scene s = uniaxial_scene();
  s.materials["steel"].poisson = 0.42;
  TwoPlates plates;
  EXPECT_FALSE(noted(solve_scene(s, mesh_of(plates)), "nearly incompressible"));
  plates.kind_upper = CellKind::quad4;
  const Results r = solve_scene(s, mesh_of(plates));
  EXPECT_TRUE(noted(r, "body 'upper' is nearly incompressible")) << all_notes(r);
  EXPECT_FALSE(noted(r, "body 'lower'"));
  s.materials["steel"].poisson = 0.49;
  EXPECT_TRUE(noted(solve_scene(s, mesh_of({})), "6-node triangles"));
  s.model.plane = Plane::stress;
  EXPECT_FALSE(noted(solve_scene(s, mesh_of({})), "nearly incompressible"));
}

// As of the same stiffness written out; fibres that are stiff along one axis are another matter.
TEST(Limits, NearlyIncompressibleStiffnessesAreNoted) {
  Scene s = uniaxial_scene();
  TwoPlates plates;
  plates.kind_upper = CellKind::quad4;
  const auto with = [&](double along, double across, double coupled, double shear) {
    Mat4 stiffness = Mat4::Zero();
    stiffness.topLeftCorner<3, 3>().setConstant(coupled);
    stiffness.diagonal() << along, across, across, shear;
    s.materials["steel"].stiffness = stiffness * s.materials["steel"].young;
    return solve_scene(s, mesh_of(plates));
  };
  const double poisson = 0.42, lambda = poisson / (1 + poisson) / (1 - 2 * poisson), mu = 0.5 / (1 + poisson);
  EXPECT_TRUE(noted(with(lambda + 2 * mu, lambda + 2 * mu, lambda, mu), "(as of poisson = 0.42)"));
  EXPECT_FALSE(noted(with(15, 1, 0.4, 0.5), "nearly incompressible"));
}

TEST(Limits, BodiesThatAreStifferAlongTheRadiusThanAroundTheAxisAreNoted) {
  const auto with = [](double x, double y, double around, double shear, Plane plane) {
    Scene s = uniaxial_scene();
    s.model.plane = plane;
    Mat4 stiffness = Mat4::Zero();
    stiffness.topLeftCorner<3, 3>().setConstant(0.4);
    stiffness.diagonal() << x, y, around, shear;
    s.materials["steel"].stiffness = stiffness * s.materials["steel"].young;
    return solve_scene(s, mesh_of({}));
  };
  using enum Plane;
  EXPECT_FALSE(noted(with(1.4, 1.4, 1.4, 0.5, strain), "not isotropic"));
  EXPECT_FALSE(noted(with(1.4, 1.4, 1.4, 0.5, axisymmetric), "not isotropic"));
  EXPECT_FALSE(noted(with(1.4, 2, 1.4, 0.5, strain), "not isotropic"));
  const Results r = with(1.6, 1.6, 0.4, 0.6, axisymmetric);
  EXPECT_TRUE(noted(r, "on the axis its stress has no limit, as it is stiffer along r than around: it grows as r^-0.5"))
      << all_notes(r);
}

TEST(Limits, LargeDisplacementsAreNoted) {
  Scene s = uniaxial_scene();
  EXPECT_FALSE(noted(solve_scene(s, mesh_of({})), "large displacements"));
  s.boundaries.back().what = Pressure{1e11};
  EXPECT_TRUE(noted(solve_scene(s, mesh_of({})), "large displacements"));
}

TEST(Limits, AMeasuredGapFarFromTheOriginIsNoted) {
  Scene s = uniaxial_scene();
  s.contacts[0].initial_gap = InitialGap::measured;
  Mesh mesh = mesh_of({});
  EXPECT_FALSE(noted(solve_scene(s, mesh), "are rounded to about"));
  mesh.nodes.array() += 1e6;
  const Results r = solve_scene(s, mesh);
  EXPECT_TRUE(noted(r, "are rounded to about")) << all_notes(r);
}

}  // namespace
}  // namespace mortise::test
