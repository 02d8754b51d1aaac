#include "problem/body_entries.hpp"

#include "base/errors.hpp"
#include "model/patterns.hpp"

namespace mortise {

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

std::vector<int> entries_of_bodies(const Mesh& mesh, const SceneNames& names, const std::vector<BodyEntry>& entries) {
  return entries_of_bodies(mesh, names, entries, [&](const std::string& body, std::size_t first, std::size_t second) {
    throw SceneError(entries[second].key + ": body '" + body + "' is a '" + entries[second].body + "', and a '" +
                     entries[first].body + "' of " + entries[first].key +
                     "; expected one of them, or an entry with the body's own name, which counts before patterns");
  });
}

}  // namespace mortise
