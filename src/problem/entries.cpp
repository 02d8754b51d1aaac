#include "problem/entries.hpp"

#include <functional>

#include "base/errors.hpp"
#include "model/patterns.hpp"
#include "scene/scene.hpp"

namespace mortise {
namespace {

// An entry that names bodies: where it stands, for messages, and a body's name or a pattern.
struct BodyEntry {
  std::string key, body;
};

// The index of each body's entry, -1 if there is none. A name of its own counts before a pattern. Where two patterns
// name a body the first one counts, after `twice(body, first, second)`, which may throw.
std::vector<int> entries_of_bodies(
    const Mesh& mesh, const SceneNames& names, const std::vector<BodyEntry>& entries,
    const std::function<void(const std::string& body, std::size_t first, std::size_t second)>& twice) {
  std::vector<int> of_bodies(mesh.bodies.size(), -1);
  for (std::size_t i = 0; i < entries.size(); ++i)
    for (const int b : names.bodies(entries[i].key, entries[i].body)) {
      int& before = of_bodies[b];
      const bool pattern = is_pattern(entries[i].body);
      if (before >= 0 && pattern && is_pattern(entries[before].body)) twice(mesh.bodies[b], std::size_t(before), i);
      if (before < 0 || !pattern) before = int(i);
    }
  return of_bodies;
}

// The entry of [[body_force]] or [[initial_strain]] that acts on each body; -1: none.
template <typename Spec>
std::vector<int> loads_of(const std::vector<Spec>& specs, const Mesh& mesh, const SceneNames& names) {
  std::vector<BodyEntry> entries;
  for (const Spec& spec : specs) entries.push_back({spec.key, spec.body});
  return entries_of_bodies(mesh, names, entries, [&](const std::string& body, std::size_t first, std::size_t second) {
    throw SceneError(entries[second].key + ": body '" + body + "' is a '" + entries[second].body + "', and a '" +
                     entries[first].body + "' of " + entries[first].key +
                     "; expected one of them, or an entry with the body's own name, which counts before patterns");
  });
}

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

Vec2 Entries::force_in(int body, const Vec2& x) const {
  Vec2 force = gravity ? Vec2(material(body).density * *gravity) : Vec2::Zero();
  if (const int i = body_force_of[body]; i >= 0) force += body_forces[i].force(x);
  return force;
}

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
