#include "app/data_errors.hpp"

#include <algorithm>
#include <sstream>

#include "base/printable.hpp"
#include "error/data_estimate.hpp"
#include "results/error_report.hpp"

namespace mortise {
namespace {

// Below, an entry is resolved as well as smooth ones are on a mesh of six edges a wave.
constexpr double told_from = 0.01;

std::string line_of(const EntryMisfit& entry) {
  std::ostringstream text;
  text.precision(2);
  text << entry.key << " varies within elements " << near_point(entry.at) << ": over a length of " << entry.finest
       << ", where they are " << entry.size << " wide; " << 100 * entry.part
       << " % of it in the mean is not what they can follow. Its sum is right all the same; stresses near there are not"
          "; expected elements of about "
       << entry.finest;
  return text.str();
}

}  // namespace

void add_data_errors(const Scene& scene, Results& r, const AccuracySpec& spec) {
  if (!r.estimate) return;
  const DataMisfits data = data_misfits(scene, r.mesh, r.discretisation.laws);
  const std::vector<std::string> before = error_warnings(r);
  add_data_errors(r.mesh, r.points, r.discretisation, r.pairs, r.solution, data, spec, *r.estimate);
  for (std::size_t k = 0; k < r.contacts.size(); ++k) set_bars(r.estimate->pressures[k], r.contacts[k]);
  std::erase_if(r.warnings, [&](const std::string& line) { return std::ranges::count(before, line) > 0; });
  for (std::string& line : error_warnings(r)) r.warnings.push_back(std::move(line));
  for (const EntryMisfit& entry : data.entries)
    if (!scene.accuracy && entry.part > told_from) r.warnings.push_back(line_of(entry));
}

}  // namespace mortise
