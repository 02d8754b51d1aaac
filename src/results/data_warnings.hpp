// Functions of place that the mesh does not resolve, in words.
#pragma once

#include <string>
#include <vector>

#include "problem/data_misfit.hpp"

namespace mortise {

/// A line for each entry that varies within elements by more than a hundredth of its size, with the entry, the place
/// and the length over which it varies.
std::vector<std::string> data_warnings(const DataMisfits& misfits);

}  // namespace mortise
