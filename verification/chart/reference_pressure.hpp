// A contact pressure from a file, to measure others against.
#pragma once

#include "problems.hpp"

namespace mortise::chart {

/// Reads x,p (a header line, then x increasing); between the points p is linear in x, beyond them constant.
/// Throws std::runtime_error if the file cannot be read or x does not increase.
Pressure reference_pressure(const std::string& path);

}  // namespace mortise::chart
