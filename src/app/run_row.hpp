// One run of several: its status and figures.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace mortise {

struct RunRow {
  std::string status;                                   ///< a word, or "bad input: " and a message
  std::vector<std::pair<std::string, double>> figures;  ///< by column
};

}  // namespace mortise
