#include "problem/scene_names.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "model/patterns.hpp"

namespace mortise {
namespace {

template <typename Numbers>
std::vector<int> numbers_of(const std::string& name, const Numbers& numbers) {
  std::vector<int> found;
  if (!is_pattern(name)) {
    if (const auto at = numbers.find(name); at != numbers.end()) found.push_back(at->second);
    return found;
  }
  for (const auto& [known, number] : numbers)
    if (matches(name, known)) found.push_back(number);
  std::ranges::sort(found);
  return found;
}

}  // namespace

SceneNames::SceneNames(const Mesh& mesh) : mesh_(mesh) {
  for (const std::string& name : mesh.bodies) bodies_.emplace(name, int(bodies_.size()));
  for (int b = 0; b < int(mesh.boundaries.size()); ++b)
    if (mesh.boundaries[b].piece_of < 0) boundaries_.emplace(mesh.boundaries[b].name, b);
  for (const NamedPoint& point : mesh.points) points_.emplace(point.name, int(points_.size()));
}

std::vector<int> SceneNames::bodies(const std::string& key, const std::string& name) const {
  std::vector<int> found = numbers_of(name, bodies_);
  if (found.empty())
    throw SceneError(key + ": " + unknown_name("body", name, mesh_.bodies) + " (" + mesh_.source + ")");
  return found;
}

std::vector<int> SceneNames::boundaries(const std::string& key, const std::string& name) const {
  std::vector<int> found = numbers_of(name, boundaries_);
  if (found.empty())
    throw SceneError(key + ": " + unknown_name("boundary", name, boundary_names(mesh_)) + " (" + mesh_.source + ")");
  return found;
}

SceneNames::Places SceneNames::places(const std::string& key, const std::string& name) const {
  Places found{numbers_of(name, boundaries_), {}};
  if (found.boundaries.empty()) found.points = numbers_of(name, points_);
  if (found.points.empty() && found.boundaries.empty()) {
    std::vector<std::string> known = boundary_names(mesh_);
    for (const NamedPoint& point : mesh_.points) known.push_back(point.name);
    throw SceneError(key + ": " + unknown_name("boundary", name, known) + " (" + mesh_.source + ")");
  }
  return found;
}

}  // namespace mortise
