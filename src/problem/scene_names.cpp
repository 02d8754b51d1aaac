#include "problem/scene_names.hpp"

#include "base/errors.hpp"

namespace mortise {

SceneNames::SceneNames(const Mesh& mesh) : mesh_(mesh) {
  for (const std::string& name : mesh.bodies) bodies_.emplace(name, int(bodies_.size()));
  for (const Boundary& boundary : mesh.boundaries) boundaries_.emplace(boundary.name, int(boundaries_.size()));
}

int SceneNames::body(const std::string& key, const std::string& name) const {
  if (const auto found = bodies_.find(name); found != bodies_.end()) return found->second;
  throw SceneError(key + ": " + unknown_name("body", name, mesh_.bodies) + " (" + mesh_.source + ")");
}

int SceneNames::boundary(const std::string& key, const std::string& name) const {
  if (const auto found = boundaries_.find(name); found != boundaries_.end()) return found->second;
  throw SceneError(key + ": " + unknown_name("boundary", name, boundary_names(mesh_)) + " (" + mesh_.source + ")");
}

}  // namespace mortise
