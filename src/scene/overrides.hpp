// Overrides: `--set KEY=VALUE` written into a document before it is read.
#pragma once

#include <functional>

#include "scene/document.hpp"
#include "scene/scene.hpp"

namespace mortise::scene_file {

/// Sets the value that override.key leads to; keys and tables that are missing are created. A number in the key picks
/// an entry of a list, counted from 0; contact.KEY stands for contact.0.KEY, contact.1.KEY and so on.
/// Throws InputError naming the override: no dotted key, an index out of range, a way that leads through a scalar.
void apply_override(Node& root, const Override& change);

/// A change on its way into a document, as an override is one.
struct Change {
  std::vector<std::string> parts;               ///< of its key
  Place place;                                  ///< where it is written
  std::function<Node(const Node& spot)> value;  ///< that takes name and path of `spot`
};

/// Makes a change, as of apply_override.
void apply(Node& root, Change change);

}  // namespace mortise::scene_file
