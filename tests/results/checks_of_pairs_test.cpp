// Answers of two pairs that are wrong in one place only, whichever it is: the check that it concerns must fail.
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "app/solve_scene.hpp"
#include "results/checks.hpp"
#include "scene/scene.hpp"

namespace mortise {
namespace {

// Three plates under uniform pressure: every row is loaded alike.
Results solved(Plane plane) {
  Scene scene = read_scene(MORTISE_SOURCE_DIR "/geo/stack.toml", {});
  scene.model.plane = plane;
  for (ContactSpec& contact : scene.contacts) contact.condition = Condition::unilateral;
  return solve_scene(scene);
}

const Results& answer() {
  static const Results results = solved(Plane::strain);
  return results;
}

/// Names of the checks that fail on the answer with what `spoil` has made of it.
std::set<std::string> failed(const std::function<void(Results&)>& spoil, const Results& of = answer()) {
  Results r = of;
  spoil(r);
  std::set<std::string> names;
  for (const Check& check : checks(r))
    if (!check.ok()) names.insert(check.name);
  return names;
}

using Names = std::set<std::string>;
const char* const tension = "p >= 0 at the multipliers";
const char* const overlap = "weighted gap >= 0";
const char* const product = "p gap = 0";
const char* const of_bodies = "force balance of each body";
const char* const turns_of_bodies = "moment balance of each body";
const char* const of_contact = "contact forces equal and opposite";
const char* const turns_of_contact = "contact moments equal and opposite";

double largest_pressure() { return answer().solution.lambda.cwiseAbs().maxCoeff(); }
double largest_displacement() { return answer().solution.u.cwiseAbs().maxCoeff(); }

TEST(ChecksOfPairs, HoldForTheAnswer) {
  EXPECT_EQ(answer().status, Status::solved);
  EXPECT_EQ(answer().problem.pairs.size(), 2U);
  EXPECT_EQ(failed([](Results&) {}), Names());
}

TEST(ChecksOfPairs, ATensionOfAHundredthInAnyRowFails) {
  for (Eigen::Index row = 0; row < answer().solution.lambda.size(); ++row)
    EXPECT_TRUE(failed([&](Results& r) { r.solution.lambda(row) = 0.01 * largest_pressure(); }).contains(tension))
        << row;
}

// Half a wave of linear functions between closed rows is an eighth; also where bodies bear ten times the contact's
// stress.
TEST(ChecksOfPairs, ADipOfMoreThanAnEighthInAnyPairFails) {
  for (std::size_t pair = 0; pair < answer().problem.pairs.size(); ++pair)
    for (const double stress : {1.0, 10.0}) {
      const auto dipped = [&](double part) {
        return failed([&](Results& r) {
          r.recovery.stress.points *= stress;
          r.recovery.contacts[pair].p_least = -part * largest_pressure();
        });
      };
      EXPECT_EQ(dipped(0.13), Names{"p >= 0 between the multipliers"}) << pair;
      EXPECT_EQ(dipped(0.12), Names()) << pair;
    }
}

TEST(ChecksOfPairs, AnOverlapInAnyRowFailsAndAGapUnderPressure) {
  for (Eigen::Index row = 0; row < answer().solution.lambda.size(); ++row) {
    const auto opened = [&](double part) {
      return failed([&](Results& r) {
        SaddlePointSystem& s = r.problem.discretisation.system;
        s.g(row) -= part * largest_displacement() * s.row_scale(row);
      });
    };
    EXPECT_EQ(opened(-1e-6), (Names{overlap, product})) << row;
    EXPECT_EQ(opened(1e-6), Names{product}) << row;
  }
}

TEST(ChecksOfPairs, AForceOrACoupleOnAnyBodyFails) {
  const Results& r = answer();
  const auto& [points, mesh] = std::tie(r.problem.points, r.problem.mesh);
  for (std::size_t body = 0; body < mesh.bodies.size(); ++body) {
    const int a = points.node[points.first[body]], b = points.node[points.first[body + 1] - 1];
    const double force = 1e-6 * largest_pressure();
    const auto pushed = [&](int node, const Vec2& by, int other, const Vec2& back) {
      return failed([&](Results& spoilt) {
        spoilt.recovery.reactions.nodal.segment<2>(2 * node) += by;
        spoilt.recovery.reactions.nodal.segment<2>(2 * other) += back;
      });
    };
    const Names by_force = pushed(a, Vec2(force, 0), a, Vec2(0, 0));
    EXPECT_TRUE(by_force.contains(of_bodies) && by_force.contains(balance_check)) << body;
    const Vec2 apart = (mesh.nodes.row(a) - mesh.nodes.row(b)).transpose(), across(-apart.y(), apart.x());
    const Vec2 half = force * across.normalized();
    EXPECT_EQ(pushed(a, half, b, -half), (Names{turns_of_bodies, balance_check})) << body;
    // Along the line through both it is no couple.
    const Vec2 along = force * apart.normalized();
    EXPECT_EQ(pushed(a, along, b, -along), Names()) << body;
  }
}

// Radial forces strain a ring, and so do couples.
TEST(ChecksOfPairs, OfRingsForcesAlongTheAxisAloneMustBalance) {
  static const Results rings = solved(Plane::axisymmetric);
  for (std::size_t body = 0; body < rings.problem.mesh.bodies.size(); ++body) {
    const int node = rings.problem.points.node[rings.problem.points.first[body]];
    const auto pushed = [&](const Vec2& by) {
      return failed([&](Results& r) { r.recovery.reactions.nodal.segment<2>(2 * node) += by; }, rings);
    };
    const double force = 1e-6 * rings.solution.lambda.cwiseAbs().maxCoeff();
    EXPECT_EQ(pushed(Vec2(0, force)), (Names{of_bodies, balance_check})) << body;
    EXPECT_EQ(pushed(Vec2(force, 0)), Names()) << body;
  }
}

TEST(ChecksOfPairs, AForceOrACoupleBetweenTheSidesOfAnyPairFails) {
  for (std::size_t pair = 0; pair < answer().problem.pairs.size(); ++pair) {
    const auto changed = [&](double first, double last) {
      return failed([&](Results& r) {
        Coupling& coupling = r.problem.pairs[pair].coupling;
        const ContactResults& line = r.recovery.contacts[pair];
        const VecX lambda = r.solution.lambda.segment(r.problem.pairs[pair].first_row, coupling.B.rows());
        // Normal forces at the ends of the line, by entries of the row with the largest multiplier.
        Eigen::Index row = 0;
        lambda.cwiseAbs().maxCoeff(&row);
        const double force = 1e-6 * coupling.scale(row);
        coupling.B.coeffRef(row, 2 * line.multiplier.nodes.front().node + 1) += first * force;
        coupling.B.coeffRef(row, 2 * line.multiplier.nodes.back().node + 1) += last * force;
      });
    };
    EXPECT_TRUE(changed(1, 0).contains(of_contact)) << pair;
    EXPECT_EQ(changed(1, -1), Names{turns_of_contact}) << pair;
  }
}

TEST(ChecksOfPairs, ALineThatIsCoveredTwiceOrHalfFails) {
  for (std::size_t pair = 0; pair < answer().problem.pairs.size(); ++pair)
    for (const double part : {0.5, 0.98, 1.02, 2.0})
      EXPECT_EQ(failed([&](Results& r) {
                  for (ContactPair& any : r.problem.pairs) any.spec.initial_gap = InitialGap::closed;
                  r.problem.pairs[pair].coupling.covered_length *= part;
                }),
                Names{"segments cover the closed contact curve"})
          << pair << " " << part;
}

}  // namespace
}  // namespace mortise
