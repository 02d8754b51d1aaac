#include "app/sweep.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>

#include "app/accuracy.hpp"
#include "base/errors.hpp"
#include "base/printable.hpp"
#include "io/csv.hpp"
#include "io/staged_file.hpp"

namespace mortise {
namespace {

// One run's figures under their column names.
using Row = std::vector<std::pair<std::string, double>>;

Row figures(const Results& r) {
  Row row{{"nodes", double(r.mesh.nodes.rows())},
          {"elements", double(r.mesh.cells.size())},
          {"dofs", free_unknowns(r)},
          {"multipliers", double(r.solution.lambda.size())},
          {"iterations.contact", double(r.pairs.empty() ? 0 : r.solution.steps.size())},
          {"energy", r.energy},
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
  for (std::size_t k = 0; k < r.contacts.size(); ++k) {
    const ContactResults& c = r.contacts[k];
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

// Columns in the order in which they first appear; what a run does not have stays empty.
class Table {
 public:
  explicit Table(const std::vector<Variation>& variations) {
    for (const Variation& v : variations) columns_.push_back({v.key, {}, {}});
    columns_.push_back({"status", {}, {}});
  }
  void add(const std::vector<std::string>& words, const Row& row) {
    for (std::size_t i = 0; i < words.size(); ++i) columns_[i].words.push_back(words[i]);
    for (const auto& [name, value] : row) column(name, words.size()).numbers.push_back(value);
    ++rows_;
    for (std::size_t i = words.size(); i < columns_.size(); ++i)
      columns_[i].numbers.resize(rows_, std::numeric_limits<double>::quiet_NaN());
  }
  void write(const std::filesystem::path& path) const {
    StagedFile staged(path);
    write_csv(staged.path(), columns_);
    staged.commit();
  }

 private:
  CsvColumn& column(const std::string& name, std::size_t from) {
    const auto found = std::find_if(columns_.begin() + std::ptrdiff_t(from), columns_.end(),
                                    [&](const CsvColumn& c) { return c.name == name; });
    if (found != columns_.end()) return *found;
    columns_.push_back({name, {}, std::vector<double>(rows_, std::numeric_limits<double>::quiet_NaN())});
    return columns_.back();
  }
  std::vector<CsvColumn> columns_;
  std::size_t rows_ = 0;
};

// Whether a file with that header is a table of ours: its columns end with "status", or go on with the figures. No
// scene, geometry or mesh begins so.
bool is_table(const std::string& header) {
  return header.ends_with(",status") || header.find(",status,nodes,elements,dofs,") != std::string::npos;
}

}  // namespace

Variation parse_variation(const std::string& text) {
  if (text.find('=') == std::string::npos || text.front() == '=')
    throw InputError("--vary '" + text + "': expected KEY=VALUE1,VALUE2,... such as mesh.parameters.n_upper=20,40,80");
  const Override split = parse_override(text);
  Variation variation{split.key, {}};
  std::stringstream values(split.value);
  for (std::string value; std::getline(values, value, ',');) variation.values.push_back(value);
  if (variation.values.empty())
    throw InputError("--vary " + text +
                     ": no value; expected KEY=VALUE1,VALUE2,... such as "
                     "mesh.parameters.n_upper=20,40,80");
  return variation;
}

Status sweep(const std::string& scene_path, const std::vector<Override>& overrides,
             const std::vector<Variation>& variations, const std::filesystem::path& csv, bool diagnosed,
             const std::function<void(const std::string& line)>& report) {
  if (csv.has_parent_path()) std::filesystem::create_directories(csv.parent_path());
  check_target(csv, {scene_path}, is_table);
  std::size_t total = 1;
  for (const Variation& v : variations) total *= v.values.size();
  Table table(variations);
  Status worst = Status::solved;
  std::optional<ActiveSet> start;  // of the run before: solve_scene ignores it on another mesh
  for (std::size_t run = 0; run < total; ++run) {
    std::vector<Override> all = overrides;
    std::vector<std::string> words;
    std::string line = std::to_string(run + 1) + "/" + std::to_string(total);
    for (std::size_t v = 0, stride = total; v < variations.size(); ++v) {
      stride /= variations[v].values.size();
      words.push_back(variations[v].values[run / stride % variations[v].values.size()]);
      all.push_back({variations[v].key, words.back()});
      line += " " + variations[v].key + "=" + words.back();
    }
    try {
      const Scene scene = read_scene(scene_path, all);
      Results results = scene.accuracy ? *solve_to_accuracy(scene) : solve_scene(scene, {}, start ? &*start : nullptr);
      if (!scene.accuracy) estimate(results);
      if (diagnosed) diagnose(scene, results);
      start = active_set(results);
      words.push_back(to_string(results.status));
      table.add(words, figures(results));
      worst = std::max(worst, results.status);
    } catch (const InputError& error) {
      words.push_back(printable(std::string("bad input: ") + error.what()));
      table.add(words, {});
      worst = std::max(worst, Status::check_failed);
    }
    table.write(csv);
    report(line + ": " + words.back());
  }
  return worst;
}

}  // namespace mortise
