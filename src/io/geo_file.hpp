// What a .geo says about itself before gmsh reads it: the parameters that can be set from outside.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mortise {

/// Numbers that `file` and the files it includes name in DefineConstant, in the order of the text, each once.
/// An Include whose name is not a plain string is not followed.
/// Throws InputError, with the line, at an Exit command: gmsh would end our process there, with exit status 0.
std::vector<std::string> geo_parameters(const std::filesystem::path& file);

}  // namespace mortise
