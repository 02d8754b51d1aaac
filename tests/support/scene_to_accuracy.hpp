// A scene of geo/ that asks for an accuracy.
#pragma once

#include "scene/scene.hpp"

namespace mortise::test {

inline Scene scene_to_accuracy(const std::string& name, const std::string& value, std::vector<Override> more = {}) {
  more.push_back({"accuracy.value", value});
  return read_scene(MORTISE_SOURCE_DIR "/geo/" + name + ".toml", more);
}

}  // namespace mortise::test
