#include "app/sweep_row.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <sstream>

#include "base/staged_file.hpp"
#include "output/csv.hpp"

namespace mortise {
namespace {

std::vector<std::pair<std::string, double>> figures(const Results& r) {
  std::vector<std::pair<std::string, double>> row{
      {"nodes", double(r.problem.mesh.nodes.rows())},
      {"elements", double(r.problem.mesh.cells.size())},
      {"dofs", free_unknowns(r)},
      {"multipliers", double(r.solution.lambda.size())},
      {"iterations.contact", double(r.problem.pairs.empty() ? 0 : r.solution.steps.size())},
      {"energy", r.recovery.energy},
      {"seconds.mesh", r.seconds.mesh},
      {"seconds.solve", r.seconds.total() - r.seconds.mesh}};
  if (const auto& iteration = r.solution.iteration) {
    row.insert(row.end(), {{"iteration.steps", double(iteration->steps)},
                           {"iteration.convergence_rate", iteration->convergence_rate},
                           {"iteration.seconds", r.seconds.solve}});
    for (const auto& [name, value] : iteration->figures) row.emplace_back("iteration." + name, value);
  }
  if (r.estimate) {
    row.emplace_back("estimate.error", r.estimate->energy.error);
    row.emplace_back("estimate.pressure.error", r.estimate->pressure());
  }
  if (r.inf_sup) row.emplace_back("inf_sup", r.inf_sup->beta);
  for (std::size_t k = 0; k < r.recovery.contacts.size(); ++k) {
    const ContactResults& c = r.recovery.contacts[k];
    const std::string at = "contact." + std::to_string(k) + ".";
    row.insert(row.end(), {{at + "pressure.min", c.p_min},
                           {at + "pressure.mean", c.p_mean},
                           {at + "pressure.max", c.p_max},
                           {at + "force.x", c.force.x()},
                           {at + "force.y", c.force.y()},
                           {at + "length_in_contact", c.length_in_contact}});
  }
  for (const Check& c : r.checks) row.emplace_back(c.name, c.value);
  return row;
}

std::string exact(double value) {
  std::array<char, 40> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

}  // namespace

RunRow row_of(const Results& results) { return {to_string(results.status), figures(results)}; }

Status status_of(const RunRow& row) {
  for (const Status status : {Status::solved, Status::accuracy_not_reached, Status::not_converged})
    if (row.status == to_string(status)) return status;
  return Status::check_failed;
}

// Fields between tabs, of which no field has any; the last is a point, so that a line cut short is known.
std::string line_of(const RunRow& row) {
  std::string line = row.status;
  for (const auto& [name, value] : row.figures) line += "\t" + name + "\t" + exact(value);
  return line + "\t.";
}

std::optional<RunRow> row_in(const std::string& line) {
  std::vector<std::string> fields;
  std::stringstream stream(line);
  for (std::string field; std::getline(stream, field, '\t');) fields.push_back(field);
  if (fields.size() % 2 != 0 || fields.empty() || fields.back() != ".") return std::nullopt;
  RunRow row{fields[0], {}};
  for (std::size_t i = 1; i + 1 < fields.size(); i += 2) {
    double value = 0;
    std::from_chars(fields[i + 1].data(), fields[i + 1].data() + fields[i + 1].size(), value);
    row.figures.emplace_back(fields[i], value);
  }
  return row;
}

void write_table(const std::filesystem::path& path, const std::vector<std::string>& keys,
                 const std::vector<std::vector<std::string>>& values, const std::map<std::size_t, RunRow>& rows) {
  std::vector<CsvColumn> words, numbers;
  for (const std::string& key : keys) words.push_back({key, {}, {}});
  words.push_back({"status", {}, {}});
  std::size_t count = 0;
  for (const auto& [run, row] : rows) {
    for (std::size_t k = 0; k < keys.size(); ++k) words[k].words.push_back(values[run][k]);
    words.back().words.push_back(row.status);
    for (const auto& [name, value] : row.figures) {
      auto column = std::ranges::find(numbers, name, &CsvColumn::name);
      if (column == numbers.end()) column = numbers.insert(column, {name, {}, {}});
      column->numbers.resize(count, std::numeric_limits<double>::quiet_NaN());
      column->numbers.push_back(value);
    }
    ++count;
  }
  for (CsvColumn& column : numbers) column.numbers.resize(count, std::numeric_limits<double>::quiet_NaN());
  words.insert(words.end(), numbers.begin(), numbers.end());
  StagedFile staged(path);
  write_csv(staged.path(), words);
  staged.commit();
}

}  // namespace mortise
