// The ranges of a scene's numbers, of one that a program has filled or changed.
#pragma once

#include "scene/scene.hpp"

namespace mortise {

/// Throws SceneError "KEY: expected ..., found ..." for the first number that no scene file could say.
/// By value, as the rows of the table of keys hold what they read into. `checked`: one that has been; what is the same
/// there is not looked at again.
void check_ranges(Scene scene, const Scene* checked = nullptr);

}  // namespace mortise
