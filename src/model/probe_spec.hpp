// Places at which the solution is read, and functions of place from files.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/field.hpp"

namespace mortise {

/// One [[probe]] entry: places at which the solution is read.
struct ProbeSpec {
  std::string key;
  std::vector<Vec2> at;
  bool line = false;  ///< the places are along a straight line, from its start
  std::string body;   ///< that has them; empty: of each the only one
  double angle = 0;   ///< of the axes of the stresses, degrees counter-clockwise from x

  bool operator==(const ProbeSpec&) const = default;
};

/// One entry of [fields]: a function of place by its values at the points of a file.
struct FieldSpec {
  std::string key;
  std::string file;                         ///< as Scene::mesh_file
  std::string values;                       ///< the array of a .vtu, the column of a .csv
  std::optional<int> component;             ///< of an array with several, from 0
  std::shared_ptr<NamedFunction> function;  ///< that expressions name; load_fields says what it is

  /// Of two readings: each has a function of its own.
  bool operator==(const FieldSpec& other) const {
    return key == other.key && file == other.file && values == other.values && component == other.component;
  }
};

}  // namespace mortise
