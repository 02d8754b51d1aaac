// Scenes that have no solution, or not the one that was meant: errors that name the place.
#pragma once

#include "app/solve_scene.hpp"

namespace mortise {

/// What only contact holds: the motions that no prescribed displacement resists, and a spring's unknown for each.
struct Floating {
  std::vector<std::vector<RigidMotion>> motions;
  std::vector<int> grounded;
};

Floating find_floating(const Mesh& mesh, const Constraints& constraints);

/// Throws InputError where a body may move although all contact is closed. The first of the audit's `findings` ends
/// the message: probably a pair is missing.
void require_held(const Scene& scene, const Mesh& mesh, const Constraints& constraints, const StackedCoupling& coupling,
                  const std::vector<std::string>& findings);

/// Throws InputError where a gap that the scene calls closed is wider than two meshes of one curve can show.
void require_closed(const Scene& scene, const Mesh& mesh, const std::vector<ContactPair>& pairs);

/// Throws InputError where the solver found the stiffness not positive definite, contact conditions that depend on one
/// another, or a body that the closed rows do not hold.
void require_solved(const Scene& scene, const Results& results, const Floating& floating,
                    const SaddlePointSolution& solution);

}  // namespace mortise
