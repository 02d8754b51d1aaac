// What the names of a scene stand for in its mesh.
#pragma once

#include <unordered_map>

#include "mesh/mesh.hpp"

namespace mortise {

class SceneNames {
 public:
  explicit SceneNames(const Mesh& mesh);

  /// Index of the body or boundary that `key` of the scene names. Throws SceneError with the known names.
  int body(const std::string& key, const std::string& name) const;
  int boundary(const std::string& key, const std::string& name) const;

 private:
  using Numbers = std::unordered_map<std::string, int>;
  const Mesh& mesh_;
  Numbers bodies_, boundaries_;
};

}  // namespace mortise
