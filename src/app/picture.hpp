// What scripts do (src/python), which are found beside the program and run by Python.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/solve_scene.hpp"

namespace mortise {

/// `mortise picture`, `sweep`, `certify`, `report` and `window`: a script, reports/certify.py or another, takes the
/// place of this process; it may run the program again. Returns only by throwing InputError, where the script or Python
/// is not there.
[[noreturn]] void become_script(const std::string& name, const std::vector<std::string>& arguments);

/// `mortise check --picture`: the set-up as a .png, .pdf or .svg, by setup.py. 0, or 1 where it drew nothing and said
/// why on the standard error. Throws as become_script.
int draw_setup(const Problem& problem, const std::filesystem::path& picture);

/// `mortise check` and `mortise new` of a geometry or mesh without a scene: what its bodies and curves are, by
/// scenes/NAME.py, with these arguments behind it. As draw_setup.
int run_on_geometry(const std::string& name, const Mesh& mesh, std::vector<std::string> arguments);

}  // namespace mortise
