#include "app/sweep.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>

#include "app/accuracy.hpp"
#include "app/solve_scene.hpp"
#include "app/sweep_row.hpp"
#include "app/workers.hpp"
#include "base/errors.hpp"
#include "base/printable.hpp"
#include "base/staged_file.hpp"
#include "gmsh/geo_file.hpp"
#include "results/expected.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

// ---- The journal: complete groups, kept until the table is complete ----

constexpr const char* journal_title = "mortise sweep: runs that are complete";

fs::path journal_of(const fs::path& csv) { return csv.parent_path() / ("." + csv.filename().string() + ".runs"); }

std::string checksum(const std::string& text) {
  std::ostringstream sum;
  sum << std::hex << std::hash<std::string>{}(text);
  return sum.str();
}

// Tells a group of runs from others: what is varied and set, and how the files stand that it reads.
std::string key_of(const SweepPlan& plan, std::size_t group) {
  std::ostringstream text;
  const auto stamp = [&](const fs::path& file) {
    std::error_code ignored;
    text << file << fs::file_size(file, ignored) << " " << fs::last_write_time(file, ignored).time_since_epoch().count()
         << "\n";
  };
  text << MORTISE_VERSION << plan.diagnosed << "\n";
  stamp(plan.scene);
  const auto [first, last] = runs_of_group(plan, group);
  for (std::size_t run = first; run < last; ++run) {
    const std::vector<Override> all = plan.overrides_of(run);
    for (const Override& o : all) text << o.key.size() << o.key << o.value.size() << o.value << "\n";
    try {
      const Scene scene = read_scene(plan.scene, all);
      for (const fs::path& file : geo_inputs(scene.mesh_file)) stamp(file);
      for (const FieldSpec& field : scene.fields) stamp(field.file);
    } catch (const InputError&) {  // its row will say so
    }
  }
  return checksum(text.str());
}

// "KEY<tab>ROW<tab>CHECKSUM"
std::string journal_line(const std::string& key, const RunRow& row) {
  const std::string text = key + "\t" + line_of(row);
  return text + "\t" + checksum(text) + "\n";
}

// The lines of the journal by their keys; only the first title says that it is one. Damaged lines are left out.
std::map<std::string, std::vector<RunRow>> read_journal(const fs::path& path) {
  std::map<std::string, std::vector<RunRow>> found;
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || line != journal_title) return found;
  while (std::getline(file, line)) {
    const std::size_t end = line.find('\t'), sum = line.rfind('\t');
    if (sum == end || line.substr(sum + 1) != checksum(line.substr(0, sum))) continue;
    if (const auto row = row_in(line.substr(end + 1, sum - end - 1))) found[line.substr(0, end)].push_back(*row);
  }
  return found;
}

// "3/8 KEY=VALUE: solved"
std::string told(const SweepPlan& plan, std::size_t run, const RunRow& row) {
  std::string line = std::to_string(run + 1) + "/" + std::to_string(plan.values.size());
  for (std::size_t k = 0; k < plan.keys.size(); ++k) line += " " + plan.keys[k] + "=" + plan.values[run][k];
  return line + ": " + row.status;
}

Status worst_of(const std::map<std::size_t, RunRow>& rows) {
  Status worst = Status::solved;
  for (const auto& [run, row] : rows) worst = std::max(worst, status_of(row));
  return worst;
}

// A sweep under way: what is known, what is to be run, and its two files.
struct Running {
  const SweepPlan& plan;
  fs::path csv, journal;
  std::map<std::size_t, RunRow> rows = {};       // by number of the run
  std::vector<std::size_t> groups = {};          // to be run
  std::map<std::size_t, std::string> keys = {};  // of groups
  std::ofstream lines = {};                      // of the journal

  void write() const { write_table(csv, plan.keys, plan.values, rows); }
};

// What the journal of an earlier call has; it is gone on with.
void resume(Running& now, const SweepPart& part, const SweepReport& report) {
  const std::map<std::string, std::vector<RunRow>> kept = read_journal(now.journal);
  const auto [first, last] = groups_of(now.plan, part);
  for (std::size_t group = first; group < last; ++group) {
    const auto [from, to] = runs_of_group(now.plan, group);
    const auto found = kept.find(now.keys[group] = key_of(now.plan, group));
    if (found == kept.end() || found->second.size() != to - from) {
      now.groups.push_back(group);
      continue;
    }
    for (std::size_t run = from; run < to; ++run) {
      now.rows[run] = found->second[run - from];
      report(told(now.plan, run, now.rows[run]) + " (kept)");
    }
  }
  if (now.groups.empty()) now.write();
  now.lines.open(now.journal, kept.empty() ? std::ios::trunc : std::ios::app);
  if (kept.empty()) now.lines << journal_title << "\n" << std::flush;
}

// Takes in a line of a process: "RUN row". A group that is complete goes into the journal.
void take_line(Running& now, const std::string& line, const SweepReport& report) {
  const std::size_t run = std::stoul(line), group = group_of(run);
  const RunRow row = row_in(line.substr(line.find(' ') + 1)).value();
  now.rows[run] = row;
  now.write();
  report(told(now.plan, run, row));
  const auto [from, to] = runs_of_group(now.plan, group);
  if (run + 1 < to) return;
  std::string complete;
  for (std::size_t k = from; k < to; ++k) complete += journal_line(now.keys[group], now.rows.at(k));
  now.lines << complete << std::flush;
}

RunRow row_of_results(Results& results, bool diagnosed) {
  if (diagnosed) diagnose(results);
  judge_expectations(results);
  return row_of(results, report_of(results));
}

}  // namespace

RunRow solve_run(const std::string& path, const std::vector<Override>& overrides, bool diagnosed, CaseSolver& solver,
                 const Progress& progress) try {
  const Scene scene = read_scene(path, overrides);
  if (!scene.cases.empty())
    throw InputError(scene.path +
                     ": the scene has cases of its own; expected mortise solve, or a scene without [[case]]");
  if (scene.accuracy) {
    Results results = *solve_to_accuracy(scene, progress);
    return row_of_results(results, diagnosed);
  }
  Results& results = solver.solve(scene, progress);
  estimate(results);
  return row_of_results(results, diagnosed);
} catch (const InputError& error) {
  return {printable(std::string("bad input: ") + error.what()), {}};
}

Status sweep(const SweepPlan& plan, const fs::path& whole, const SweepPart& part, int jobs, const SweepReport& report) {
  Running now{plan, table_of(whole, part), journal_of(table_of(whole, part))};
  if (now.csv.has_parent_path()) fs::create_directories(now.csv.parent_path());
  check_target(now.csv, {plan.scene}, is_sweep_table);
  check_target(now.journal, {plan.scene}, [](const std::string& title) { return title == journal_title; });
  resume(now, part, report);

  CaseSolver solver;  // of each process its own
  const auto work = [&](std::size_t index, const Answer& answer) {
    solver.forget_rows();
    const auto [from, to] = runs_of_group(plan, now.groups[index]);
    for (std::size_t run = from; run < to; ++run)
      answer(std::to_string(run) + " " +
             line_of(solve_run(plan.scene, plan.overrides_of(run), plan.diagnosed, solver)));
  };
  const auto take = [&](const std::string& line) { take_line(now, line, report); };
  if (!share_work(now.groups.size(), jobs, work, take))
    throw InputError(now.csv.string() +
                     ": a process of the sweep has ended before its runs were complete; the same command goes on "
                     "with those that are missing");
  now.lines.close();
  fs::remove(now.journal);
  return worst_of(now.rows);
}

}  // namespace mortise
