// A .geo's text before gmsh reads it: the parameters that can be set from outside, the files it reads.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mortise {

/// A number that a .geo names in DefineConstant: n = {7, Min 1, Max 99, Choices{1, 2}}.
struct GeoParameter {
  std::string name;
  std::optional<double> min, max;  ///< where the .geo gives them as plain numbers
  std::vector<double> choices;     ///< if any: the only values
};

/// Parameters of `file` and the files it includes, in the order of the text, each once.
/// An Include whose name is not a plain string is not followed.
std::vector<GeoParameter> geo_parameters(const std::filesystem::path& file);

/// `file` and all files that it reads by Include or Merge with plain names, themselves or through one another.
std::vector<std::filesystem::path> geo_inputs(const std::filesystem::path& file);

/// geo_inputs, if by its text the mesh of `file` depends on nothing but them: empty where it reads files by names that
/// are not plain or by other commands, or asks for the date, the environment or random numbers. Programs that it runs
/// are found when it is meshed (gmsh_process.hpp).
std::optional<std::vector<std::filesystem::path>> geo_sources(const std::filesystem::path& file);

/// Throws InputError unless all `values` are finite, of parameters that the .geo has, and in the ranges it gives.
void check_geo(const std::filesystem::path& file, const std::map<std::string, double>& values);

}  // namespace mortise
