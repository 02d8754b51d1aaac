// Scenes that have no solution, or not the one that was meant: errors that name the place.
#pragma once

#include "fem/motion_sets.hpp"
#include "problem/contact_pair.hpp"

namespace mortise {

/// Motions that only contact holds: those that no prescribed displacement resists, and a spring's unknown for each.
struct Floating {
  std::vector<std::vector<RigidMotion>> motions;
  std::vector<int> grounded;
};

Floating find_floating(const Mesh& mesh, const Constraints& constraints);

/// Motions that neither prescribed displacements nor closed contact resist: the one that a load drives is an
/// SceneError, the others are held at one unknown of the system each, which takes no force but where normals of one
/// side alone make one, and returned. Contact resists them by its rows, and as the multiplier side's curve does
/// (smooth_normals): a disc turns freely whatever its chords say. The first of the audit's `findings` ends an error:
/// probably a pair is missing.
Floating hold_free_motions(const Mesh& mesh, const std::vector<ContactPair>& pairs,
                           const std::vector<std::string>& findings, SaddlePointSystem& system);

/// Throws the SceneError of hold_free_motions if the load, n, drives one of the motions.
void refuse_driven(const Mesh& mesh, const std::vector<ContactPair>& pairs,
                   const std::vector<std::vector<RigidMotion>>& motions, const std::vector<std::string>& findings,
                   const VecX& load);

/// "nothing holds MOTION, but no load drives it either ..."; one line for many.
std::vector<std::string> held_lines(const Mesh& mesh, const std::vector<std::vector<RigidMotion>>& motions);

/// Throws SceneError where a gap that the scene calls closed is wider than two meshes of one curve can show.
void require_closed(const Mesh& mesh, const std::vector<ContactPair>& pairs);

}  // namespace mortise
