// A body of the mesh file, placed anew.
#pragma once

#include <string>

#include "base/types.hpp"

namespace mortise {

/// Turned about `centre`, then moved.
struct BodyCopy {
  std::string key;             ///< of the scene that says so, for messages
  std::string body;            ///< of the mesh file
  std::string name;            ///< of the copy
  double degrees = 0;          ///< counter-clockwise
  Vec2 centre = Vec2::Zero();  ///< as drawn
  Vec2 shift = Vec2::Zero();   ///< length

  bool operator==(const BodyCopy&) const = default;
};

}  // namespace mortise
