// The bodies, curves and points of the mesh that a scene's names mean.
#pragma once

#include <unordered_map>

#include "mesh/mesh.hpp"

namespace mortise {

class SceneNames {
 public:
  explicit SceneNames(const Mesh& mesh);

  /// Indices of the bodies or boundaries that `key` of the scene names: one, or those that match a pattern
  /// (model/patterns.hpp), ascending. Throws SceneError with the known names where there is none.
  std::vector<int> bodies(const std::string& key, const std::string& name) const;
  std::vector<int> boundaries(const std::string& key, const std::string& name) const;

  /// Boundaries or, where there are none of that name, physical points.
  struct Places {
    std::vector<int> boundaries, points;
  };
  Places places(const std::string& key, const std::string& name) const;

 private:
  using Numbers = std::unordered_map<std::string, int>;
  const Mesh& mesh_;
  Numbers bodies_, boundaries_, points_;
};

}  // namespace mortise
