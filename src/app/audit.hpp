// What a scene probably does not mean: looked for before and after the solve, each finding one line with its place.
#pragma once

#include "app/solve_scene.hpp"

namespace mortise {

/// Before the solve: boundaries of different bodies that meet, or lie over one another, where no contact pair stands
/// between them; one line for two bodies.
/// Throws InputError for what is surely a mistake: elements listed twice, an edge that two loads name, bodies drawn
/// over one another (docs/files.md, notes).
std::vector<std::string> audit_scene(const Scene& scene, const Mesh& mesh, const std::vector<ContactPair>& pairs);

/// After the solve: contact that reaches the end of a pair's curve although the boundary goes on smoothly, one line a
/// pair; bodies that pass through one another where no pair stands between them, one line for two bodies. Nothing where
/// the run did not converge.
std::vector<std::string> audit_solution(const Scene& scene, const Results& results);

}  // namespace mortise
