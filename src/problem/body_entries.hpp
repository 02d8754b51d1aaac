// Which entry of a section of the scene acts on each body.
#pragma once

#include <functional>

#include "problem/scene_names.hpp"

namespace mortise {

/// An entry that names bodies: where it stands, for messages, and a body's name or a pattern.
struct BodyEntry {
  std::string key, body;
};

/// The index of each body's entry, -1 if there is none. A name of its own counts before a pattern. Where two
/// patterns name a body the first one counts, after `twice(body, first, second)`, which may throw.
/// Throws SceneError where an entry names no body of the mesh.
std::vector<int> entries_of_bodies(
    const Mesh& mesh, const SceneNames& names, const std::vector<BodyEntry>& entries,
    const std::function<void(const std::string& body, std::size_t first, std::size_t second)>& twice);

/// The same of entries that exclude each other: throws SceneError where two patterns name a body.
std::vector<int> entries_of_bodies(const Mesh& mesh, const SceneNames& names, const std::vector<BodyEntry>& entries);

/// The entry of [[body_force]] or [[initial_strain]] that acts on each body; -1: none.
template <typename Spec>
std::vector<int> loads_of(const std::vector<Spec>& specs, const Mesh& mesh, const SceneNames& names) {
  std::vector<BodyEntry> entries;
  for (const Spec& spec : specs) entries.push_back({spec.key, spec.body});
  return entries_of_bodies(mesh, names, entries);
}

}  // namespace mortise
