#include "app/run_table.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "base/staged_file.hpp"
#include "output/csv.hpp"

namespace mortise {
namespace {

using Figures = std::vector<std::pair<std::string, double>>;

// "AT.x", "AT.y" of [x, y]; nothing of null.
void add_pair(const std::string& at, const Json& pair, Figures& row) {
  if (pair.is_null()) return;
  row.emplace_back(at + ".x", pair[0]);
  row.emplace_back(at + ".y", pair[1]);
}

// Columns by the dotted keys of summary.json, but for a few that are shorter.
// `numbers`: of the pairs.
Figures figures(const Json& r, const std::vector<int>& numbers) {
  Figures row;
  for (const char* name : {"nodes", "elements", "dofs", "multipliers"}) row.emplace_back(name, r["mesh"][name]);
  const double meshing = r["seconds"]["mesh"];
  row.emplace_back("iterations.contact", r["iterations"]["contact"]);
  row.emplace_back("energy", r["energy"]);
  row.emplace_back("seconds.mesh", meshing);
  row.emplace_back("seconds.solve", r["seconds"]["total"].get<double>() - meshing);
  if (const Json& iteration = r["iteration"]; !iteration.is_null()) {
    for (const auto& [name, value] : iteration.items())
      if (value.is_number() && name != "kinematic" && name != "force") row.emplace_back("iteration." + name, value);
    row.emplace_back("iteration.seconds", r["seconds"]["solve"]);
  }
  if (const Json& estimate = r["estimate"]; !estimate.is_null()) {
    row.emplace_back("estimate.error", estimate["error"]);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    row.emplace_back("estimate.pressure.error",
                     estimate["pressure"].is_null() ? nan : estimate["pressure"]["error"].get<double>());
  }
  if (!r["inf_sup"].is_null()) row.emplace_back("inf_sup", r["inf_sup"]);
  for (std::size_t k = 0; k < r["contact"].size(); ++k) {
    const Json& c = r["contact"][k];
    const std::string at = "contact." + std::to_string(numbers[k]) + ".";
    for (const auto& [name, value] : c["pressure"].items())
      if (!value.is_null()) row.emplace_back(at + "pressure." + name, value);
    add_pair(at + "force", c["force"], row);
    add_pair(at + "force_error", c["force_error"], row);
    for (const char* name : {"length_in_contact", "length_in_contact_error"})
      if (!c[name].is_null()) row.emplace_back(at + name, c[name]);
    if (const Json& ends = c["ends"]; !ends.is_null()) {
      row.emplace_back(at + "from", ends[0]);
      row.emplace_back(at + "to", ends[1]);
    }
  }
  for (const Json& check : r["checks"]) row.emplace_back(check["name"], check["value"]);
  return row;
}

// The upper half of a matrix; nothing of null.
void add_stiffness(const std::string& at, const Json& matrix, Figures& row) {
  constexpr std::array motions{"x", "y", "turn"};
  for (std::size_t i = 0; i < matrix.size(); ++i)
    for (std::size_t j = i; j < 3; ++j) row.emplace_back(at + motions[i] + "." + motions[j], matrix[i][j]);
}

// The force and the moment that drive a rigid curve, about its point: what the scene gives and what holds it.
void add_acting(const std::string& at, const Json& support, Figures& row) {
  const Json& rigid = support["rigid"];
  const auto sum = [&](int i) { return rigid["force"][i].get<double>() + support["reaction"][i].get<double>(); };
  const double x = rigid["about"][0], y = rigid["about"][1], held = support["moment"];
  const double about = held - (x * support["reaction"][1].get<double>() - y * support["reaction"][0].get<double>());
  row.emplace_back(at + "x", sum(0));
  row.emplace_back(at + "y", sum(1));
  row.emplace_back(at + "turn", rigid["moment"].get<double>() + about);
}

// Reactions; of rigid curves how they moved.
void add_supports(const Json& supports, Figures& row) {
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const Json& support = supports[i];
    const std::string at = "support." + std::to_string(i) + ".";
    add_pair(at + "reaction", support["reaction"], row);
    row.emplace_back(at + "moment", support["moment"]);
    if (support.contains("stiffness")) add_stiffness(at + "stiffness.", support["stiffness"]["matrix"], row);
    if (!support.contains("rigid")) continue;
    add_pair(at + "displacement", support["rigid"]["displacement"], row);
    row.emplace_back(at + "turned", support["rigid"]["turned"]);
    add_acting(at + "acting.", support, row);
  }
}

// Of each row of probes.csv.
void add_probes(const std::vector<ProbeValue>& probes, Figures& row) {
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const std::string at = "probe." + std::to_string(i) + ".";
    const auto add_vector = [&](const std::string& name, const Vec2& v) {
      row.emplace_back(at + name + "_x", v.x());
      row.emplace_back(at + name + "_y", v.y());
    };
    add_vector("u", probes[i].u);
    if (probes[i].error) {
      row.emplace_back(at + "u_x_error", probes[i].error->u.x());
      row.emplace_back(at + "u_y_error", probes[i].error->u.y());
    }
    row.emplace_back(at + "von_mises", probes[i].von_mises);
  }
}

}  // namespace

RunRow row_of(const Results& results, const Json& report) {
  const ContactNumbers numbers = contact_numbers(results.problem);
  RunRow row{report["status"], figures(report, numbers.pairs)};
  add_supports(report["model"]["supports"], row.figures);
  const Json ties = report["model"].value("ties", Json::array());
  for (std::size_t i = 0; i < ties.size(); ++i)
    for (const std::string name : {"overlap", "tension"})
      if (ties[i].contains(name))
        row.figures.emplace_back("tie." + std::to_string(numbers.ties[i]) + "." + name, ties[i][name]);
  add_probes(results.recovery.probes, row.figures);
  return row;
}

Status status_of(const RunRow& row) {
  for (const Status status : all_of(Status{}))
    if (row.status == to_string(status)) return status;
  return Status::check_failed;
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
