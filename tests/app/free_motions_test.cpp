// Motions that nothing holds: the pressure does not depend on them unless a load drives them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "app/solve_scene.hpp"
#include "support/differences.hpp"
#include "support/messages.hpp"
#include "support/plate_scenes.hpp"

namespace mortise::test {
namespace {

// The upper plate is pressed on by 10 MPa and held by nothing but contact.
Scene pressed_on() {
  Scene scene = uniaxial_scene();
  scene.boundaries[0].on = {"lower_left"};
  return scene;
}

int held_notes(const Results& r) {
  int count = 0;
  for (const std::string& note : r.warnings) count += note.find("nothing holds body 'upper'") != std::string::npos;
  return count;
}

TEST(FreeMotions, APlateThatMaySlideIsHeldByEveryMethodAndThePressureIsExact) {
  for (const Solver solver : {Solver::direct, Solver::ddm, Solver::mssor, Solver::feti}) {
    SCOPED_TRACE(to_string(solver));
    Scene scene = pressed_on();
    scene.method.solver = solver;
    const Results r = solve_scene(scene, mesh_of({}));
    EXPECT_EQ(r.status, Status::solved);
    EXPECT_EQ(held_notes(r), 1);
    const VecX& p = r.recovery.contacts[0].pressure;
    EXPECT_LE(largest_entry(p - VecX::Constant(p.size(), 10e6)), 1e-7 * 10e6);
  }
}

// A line that is an arc of radius 0.5 about (0.4, -0.1); its vertices are even in x, so unevenly spaced on the arc.
TwoPlates saddle(int n, CellKind kind) {
  TwoPlates plates;
  plates.height = [](double x) { return std::sqrt(0.25 - (x - 0.4) * (x - 0.4)) - 0.1; };
  plates.n_upper = n;
  plates.n_lower = n * 5 / 4;
  plates.kind_upper = plates.kind_lower = kind;
  return plates;
}

TEST(FreeMotions, ASaddleOnARoundTopMayTurnWhateverItsChordsSay) {
  for (const CellKind kind : {CellKind::tri3, CellKind::quad4, CellKind::tri6, CellKind::quad8}) {
    const double reference = largest_entry(solve_scene(pressed_on(), mesh_of(saddle(32, CellKind::quad8))).solution.u);
    for (const int n : {8, 12, 16, 24}) {
      SCOPED_TRACE(std::to_string(int(kind)) + ", " + std::to_string(n));
      const Results r = solve_scene(pressed_on(), mesh_of(saddle(n, kind)));
      EXPECT_NE(r.status, Status::not_converged);
      EXPECT_EQ(held_notes(r), 1);
      EXPECT_LE(largest_entry(r.solution.u), 2 * reference);
      EXPECT_NEAR(std::abs(r.recovery.contacts[0].force.y()), 10e6 * 0.8,
                  1e-6 * 10e6);  // balances the load, on whichever side
    }
  }
}

TEST(FreeMotions, AMotionThatTheLoadDrivesIsAnError) {
  for (const bool round : {false, true}) {
    Scene scene = pressed_on();
    BoundarySpec across;
    across.key = "boundary";
    across.on = {"upper_left"};
    across.what = SurfaceTraction{Vec2(1e5, 0)};
    scene.boundaries.push_back(across);
    const TwoPlates plates = round ? saddle(12, CellKind::quad4) : TwoPlates{};
    expect_contains(message_of([&] { solve_scene(scene, mesh_of(plates)); }), "nothing holds body 'upper'");
  }
}

Scene logs(double width, const std::string& order, const std::string& edges) {
  return read_scene(std::string(MORTISE_SOURCE_DIR) + "/tests/parts/logs.toml",
                    {{"mesh.parameters.width", std::to_string(width)},
                     {"mesh.parameters.order", order},
                     {"mesh.parameters.fine", edges}});
}

// A mesh of uneven edges has the weight of its disc beside the centre, by as much as the edges leave the circle.
TEST(FreeMotions, TheWeightOfAnUnevenMeshTurnsNoDisc) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> widths(2.2, 3.6);
  for (const char* order : {"1", "2"})
    for (const char* edges : {"0.02", "0.05", "0.1"}) {
      const double width = widths(random);
      SCOPED_TRACE("order " + std::string(order) + ", edges " + edges + ", width " + std::to_string(width));
      EXPECT_NO_THROW(check_scene(logs(width, order, edges)));
    }
}

TEST(FreeMotions, LogsPressOnOneAnotherAsStaticsSays) {
  const Results r = solve_scene(logs(3.2, "2", "0.05"));
  EXPECT_EQ(r.status, Status::solved);
  const double weight = 600 * 9.81 * std::numbers::pi;  // per length, of radius 1
  for (std::size_t k = 0; k < r.problem.pairs.size(); ++k) {
    const std::string other = r.problem.pairs[k].spec.between[1];
    const double expected = other == "floor" ? 2 * weight : other.starts_with("rim") ? weight : 0;
    EXPECT_NEAR(std::abs(r.recovery.contacts[k].force.y()), expected, 0.005 * weight) << other;
  }
}

TEST(FreeMotions, WhatAnOvalLineHoldsIsHeld) {
  TwoPlates plates = saddle(12, CellKind::quad8);
  plates.height = [](double x) { return 1.02 * std::sqrt(0.25 - (x - 0.4) * (x - 0.4)) - 0.1; };
  EXPECT_EQ(held_notes(solve_scene(pressed_on(), mesh_of(plates))), 0);
}

}  // namespace
}  // namespace mortise::test
