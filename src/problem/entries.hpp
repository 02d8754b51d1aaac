// The scene's entries on bodies and boundaries, their names resolved in the mesh.
#pragma once

#include <map>

#include "model/body_specs.hpp"
#include "model/model.hpp"
#include "problem/boundary_entries.hpp"

namespace mortise {

struct Scene;

struct Entries {
  Model model;
  std::map<std::string, Material> materials;
  std::vector<BodySpec> bodies;
  std::vector<int> body_of;  ///< of each body of the mesh, in `bodies`
  std::vector<BoundaryEntry> boundaries;
  std::vector<BodyForceSpec> body_forces;
  std::vector<int> body_force_of;  ///< of each body of the mesh, in `body_forces`; -1: none
  std::vector<InitialStrainSpec> initial_strains;
  std::vector<int> initial_strain_of;  ///< likewise
  std::optional<Vec2> gravity;         ///< acceleration

  const BodySpec& body(int body) const { return bodies[body_of[body]]; }  ///< of the mesh
  const Material& material(int of) const { return materials.at(body(of).material); }

  /// What acts in a body at a place, weight too: force over volume.
  Vec2 force_in(int body, const Vec2& x) const;
};

/// Throws SceneError where the scene names what the mesh does not have, leaves a body without material, or says two
/// things of one.
Entries resolve(const Scene& scene, const Mesh& mesh);

}  // namespace mortise
