// Values at scattered points, from a comma-separated table.
#pragma once

#include <string>

#include "base/types.hpp"

namespace mortise {

struct CsvPoints {
  Points points;  ///< that all differ
  VecX values;
};

/// A table whose first line names its columns, among them x and y (or ParaView's Points:0 and Points:1) and
/// `column`; parted by commas, semicolons or tabs. Columns that are not named may hold anything. Throws InputError with
/// file and line: a column that is not there, a field that is no finite number, one point with two values.
CsvPoints read_csv_points(const std::string& file, const std::string& column);

}  // namespace mortise
