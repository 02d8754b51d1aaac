// What the results of a scene should be.
#pragma once

#include <string>

#include "model/field.hpp"

namespace mortise {

/// One [[expect]] entry: a figure of summary.json, or the pressure along a pair.
struct Expectation {
  std::string key;
  std::string figure;    ///< dotted key; empty: the pressure of `pair`
  Field value;           ///< of the figure a number; the pressure at each place of the multiplier side, stress
  int pair = 0;          ///< in the order of summary.json
  double tolerance = 0;  ///< a part of the value; of a pressure that varies, of its largest
  std::string source;    ///< of the value, in words
};

}  // namespace mortise
