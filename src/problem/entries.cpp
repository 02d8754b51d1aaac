#include "problem/entries.hpp"

#include "base/errors.hpp"
#include "problem/body_entries.hpp"
#include "scene/scene.hpp"

namespace mortise {
namespace {

std::vector<int> bodies_of(const Scene& scene, const Mesh& mesh, const SceneNames& names) {
  std::vector<BodyEntry> entries;
  for (const BodySpec& spec : scene.bodies) entries.push_back({"bodies." + spec.name, spec.name});
  const auto twice = [&](const std::string& body, std::size_t i, std::size_t j) {
    const BodySpec &first = scene.bodies[i], &second = scene.bodies[j];
    if (first.material == second.material) return;
    throw SceneError("bodies: body '" + body + "' is a '" + first.name + "' of '" + first.material + "' and a '" +
                     second.name + "' of '" + second.material + "'; expected one material");
  };
  std::vector<int> of_bodies = entries_of_bodies(mesh, names, entries, twice);
  for (std::size_t b = 0; b < of_bodies.size(); ++b)
    if (of_bodies[b] < 0)
      throw SceneError("bodies: body '" + mesh.bodies[b] + "' of " + mesh.source + " has no material");
  return of_bodies;
}

}  // namespace

Entries resolve(const Scene& scene, const Mesh& mesh) {
  const SceneNames names(mesh);
  const SideTable table(mesh);
  return {.model = scene.model,
          .materials = scene.materials,
          .bodies = scene.bodies,
          .body_of = bodies_of(scene, mesh, names),
          .boundaries = boundary_entries(scene.boundaries, mesh, table, names),
          .body_forces = scene.body_forces,
          .body_force_of = loads_of(scene.body_forces, mesh, names),
          .initial_strains = scene.initial_strains,
          .initial_strain_of = loads_of(scene.initial_strains, mesh, names),
          .gravity = scene.gravity};
}

}  // namespace mortise
