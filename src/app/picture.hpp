// What scripts do (python/pictures, python/reports), which are found beside the program and run by Python.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/solve_scene.hpp"

namespace mortise {

/// `mortise picture`: runs picture.py with these arguments. 0, or 1 where it drew nothing and said why on the standard
/// error. Throws InputError where the script or Python is not there.
int draw_picture(const std::vector<std::string>& arguments);

/// `mortise certify` and `mortise report`: run reports/NAME.py, which runs this program again. Its exit status; throws
/// as draw_picture does.
int run_report(const std::string& name, const std::vector<std::string>& arguments);

/// `mortise check --picture`: the set-up as a .png, .pdf or .svg, by setup.py. As draw_picture.
int draw_setup(const Problem& problem, const std::filesystem::path& picture);

}  // namespace mortise
