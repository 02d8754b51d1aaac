/// Scenes: read_scene, parse_override, Scene; InputError, which everything here throws for bad input.
#pragma once

#include "base/errors.hpp"
#include "scene/scene.hpp"
