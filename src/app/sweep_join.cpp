#include "app/sweep_join.hpp"

#include <algorithm>
#include <fstream>

#include "app/sweep_row.hpp"
#include "base/errors.hpp"
#include "base/printable.hpp"
#include "base/staged_file.hpp"
#include "output/csv.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

// The fields of a line as they stand there, with their quotes. A field has no end of line in it.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

struct TextTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

TextTable read_table(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  TextTable table;
  if (std::getline(file, line)) table.header = fields_of(line);
  while (std::getline(file, line)) table.rows.push_back(fields_of(line));
  return table;
}

// One part's table, which must be whole.
TextTable checked_part(const SweepPlan& plan, const SweepPart& part, const fs::path& csv) {
  const fs::path path = table_of(csv, part);
  const std::string number = std::to_string(part.part), of = std::to_string(part.of);
  const std::string name = path.string() + ", part " + number + " of " + of + ": ";
  if (!fs::is_regular_file(path))
    throw InputError(name + "no such file; expected what --part " + number + "/" + of + " writes");
  const TextTable table = read_table(path);
  for (const auto& row : table.rows)
    for (const std::string& field : row)
      if (printable(field) != field) throw InputError(name + "is damaged: it holds '" + field + "'; start it again");
  const auto [first, last] = runs_of(plan, part);
  const auto require = [&](bool same) {
    if (!same)
      throw InputError(name + "is of another sweep; expected the same scene, values of --vary and number of parts");
  };
  require(table.header.size() > plan.keys.size() && table.rows.size() <= last - first);
  for (std::size_t k = 0; k < plan.keys.size(); ++k) require(table.header[k] == csv_field(plan.keys[k]));
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    require(table.rows[i].size() == table.header.size());
    for (std::size_t k = 0; k < plan.keys.size(); ++k)
      require(table.rows[i][k] == csv_field(plan.values[first + i][k]));
  }
  if (table.rows.size() < last - first)
    throw InputError(name + std::to_string(table.rows.size()) + " of its " + std::to_string(last - first) +
                     " runs are complete; start it again");
  return table;
}

}  // namespace

Status join_sweep(const SweepPlan& plan, const fs::path& csv, std::size_t parts) {
  check_target(csv, {plan.scene}, is_sweep_table);
  TextTable whole;
  Status worst = Status::solved;
  for (std::size_t k = 1; k <= parts; ++k) {
    const TextTable part = checked_part(plan, {k, parts}, csv);
    std::vector<std::size_t> columns;  // of the whole, by the part's
    for (const std::string& name : part.header) {
      const auto at = std::ranges::find(whole.header, name);
      columns.push_back(std::size_t(at - whole.header.begin()));
      if (at == whole.header.end()) whole.header.push_back(name);
    }
    for (const std::vector<std::string>& fields : part.rows) {
      std::vector<std::string>& row = whole.rows.emplace_back(whole.header.size());
      for (std::size_t i = 0; i < fields.size(); ++i) row[columns[i]] = fields[i];
      worst = std::max(worst, status_of({fields[plan.keys.size()], {}}));
    }
  }
  StagedFile staged(csv);
  std::ofstream file(staged.path(), std::ios::binary);
  const auto write = [&](std::vector<std::string>& row) {
    row.resize(whole.header.size());
    for (std::size_t i = 0; i < row.size(); ++i) file << (i > 0 ? "," : "") << row[i];
    file << "\n";
  };
  write(whole.header);
  for (std::vector<std::string>& row : whole.rows) write(row);
  file.close();
  if (!file) throw InputError(csv.string() + ": cannot be written");
  staged.commit();
  return worst;
}

}  // namespace mortise
