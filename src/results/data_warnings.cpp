#include "results/data_warnings.hpp"

#include <sstream>

#include "base/printable.hpp"

namespace mortise {
namespace {

// Below, an entry is resolved as well as smooth ones are on a mesh of six edges a wave.
constexpr double told_from = 0.01;

std::string line_of(const EntryMisfit& entry) {
  std::ostringstream text;
  text.precision(2);
  text << entry.key << " varies within elements " << near_point(entry.at) << ": over a length of " << entry.finest
       << ", where they are " << entry.size << " wide; " << percent(entry.part)
       << " of it in the mean is not what they can follow. Its sum is right to 0.3 % all the same; stresses near there"
          " are not; expected elements of about "
       << entry.finest;
  return text.str();
}

}  // namespace

std::vector<std::string> data_warnings(const DataMisfits& misfits) {
  std::vector<std::string> lines;
  for (const EntryMisfit& entry : misfits.entries)
    if (entry.part > told_from) lines.push_back(line_of(entry));
  return lines;
}

}  // namespace mortise
