// What one has before anything is solved: mortise check and mortise new.
#pragma once

#include <filesystem>
#include <string>

#include "app/solve_scene.hpp"

namespace mortise {

/// Says what a scene will model and what it leaves out, and draws it where `picture` names a file. Exit status; throws
/// InputError as check_scene and draw_setup do.
int check(const Scene& scene, const std::string& picture, bool quiet);

/// Says what a scene could name: bodies and curves of a geometry or mesh, those without a name by their numbers, and
/// which curves meet. As check; throws as load_all_named.
int check_geometry(const std::string& file, const GeoLimits& limits, const std::string& picture, bool quiet);

/// Writes a scene of a geometry or mesh, to be filled in. Throws InputError, too, where `target` is there already.
int new_scene(const std::string& file, const GeoLimits& limits, const std::filesystem::path& target);

}  // namespace mortise
