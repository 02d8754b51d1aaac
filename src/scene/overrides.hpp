// Overrides: `--set KEY=VALUE` written into a document before it is read.
#pragma once

#include "scene/document.hpp"
#include "scene/scene.hpp"

namespace mortise::scene_file {

/// Sets the value that override.key leads to; keys and tables that are missing are created. A number in the key picks
/// an entry of a list, counted from 0; contact.KEY stands for contact.0.KEY, contact.1.KEY and so on.
/// Throws InputError naming the override: no dotted key, an index out of range, a way that leads through a scalar.
void apply_override(Node& root, const Override& change);

}  // namespace mortise::scene_file
