// The values of [fields], read from their files.
#pragma once

#include "scene/scene.hpp"

namespace mortise {

/// Reads them once: what has been read of this scene stays. Throws SceneError.
void load_fields(const Scene& scene);

}  // namespace mortise
