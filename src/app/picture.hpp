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

/// `mortise certify`: runs reports/certify.py, which runs this program again and again. Its exit status; throws as
/// draw_picture does.
int certify(const std::vector<std::string>& arguments);

/// `mortise check --picture`: the set-up as a .png, .pdf or .svg, by setup.py. As draw_picture.
int draw_setup(const Problem& problem, const std::filesystem::path& picture);

}  // namespace mortise
