// The ranges of a scene's numbers, of one that a program has filled or changed.
#pragma once

#include "scene/scene.hpp"

namespace mortise {

/// Throws SceneError "KEY: expected ..., found ..." for the first number that no scene file could say.
/// By value, as the rows of the table of keys hold what they read into.
void check_ranges(Scene scene);

}  // namespace mortise
