#include "app/sweep.hpp"

#include <istream>
#include <ostream>
#include <sstream>

#include "app/accuracy.hpp"
#include "app/run_table.hpp"
#include "base/errors.hpp"
#include "base/printable.hpp"
#include "gmsh/geo_file.hpp"
#include "results/expected.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

using Run = std::vector<Override>;

Scene scene_of_run(const std::string& path, const Run& run) {
  Scene scene = read_scene(path, run);
  if (!scene.cases.empty())
    throw InputError(scene.path +
                     ": the scene has cases of its own; expected mortise solve, or a scene without [[case]]");
  return scene;
}

RunRow row_of_results(Results& results, bool diagnosed) {
  if (diagnosed) diagnose(results);
  judge_expectations(results);
  return row_of(results, report_of(results));
}

// What is varied and set, and how the files stand that the runs read.
std::string key_of(const std::string& path, const std::vector<Run>& runs, bool diagnosed) {
  std::ostringstream text;
  const auto stamp = [&](const fs::path& file) {
    std::error_code ignored;
    text << file << fs::file_size(file, ignored) << " " << fs::last_write_time(file, ignored).time_since_epoch().count()
         << "\n";
  };
  text << MORTISE_VERSION << diagnosed << "\n";
  stamp(path);
  for (const Run& run : runs) {
    for (const Override& o : run) text << o.key.size() << o.key << o.value.size() << o.value << "\n";
    try {
      const Scene scene = read_scene(path, run);
      for (const fs::path& file : geo_inputs(scene.mesh_file)) stamp(file);
      for (const FieldSpec& field : scene.fields) stamp(field.file);
    } catch (const InputError&) {  // its row will say so
    }
  }
  return std::to_string(std::hash<std::string>{}(text.str()));
}

Json json_of(const RunRow& row) {
  Json figures = Json::object();
  for (const auto& [name, value] : row.figures) figures[name] = value;
  return {{"status", row.status}, {"figures", figures}};
}

std::vector<Run> runs_in(const Json& group, const std::vector<Override>& overrides) {
  std::vector<Run> runs;
  for (const Json& values : group) {
    Run& run = runs.emplace_back(overrides);
    for (const Json& pair : values) run.push_back({pair[0], pair[1]});
  }
  return runs;
}

}  // namespace

std::string refusal_of(const std::string& path, const std::vector<Run>& runs) {
  std::string first;
  for (const Run& run : runs) try {
      scene_of_run(path, run);
      return {};
    } catch (const InputError& error) {
      if (first.empty()) first = error.what();
    }
  return first;
}

RunRow solve_run(const std::string& path, const std::vector<Override>& overrides, bool diagnosed, CaseSolver& solver,
                 const Progress& progress) try {
  const Scene scene = scene_of_run(path, overrides);
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

void serve_sweep(const std::string& path, const std::vector<Override>& overrides, bool diagnosed, std::istream& in,
                 std::ostream& out) {
  out << "{}" << std::endl;
  CaseSolver solver;
  for (std::string line; std::getline(in, line);) {
    const std::vector<Run> runs = runs_in(Json::parse(line), overrides);
    Json about = {{"key", key_of(path, runs, diagnosed)}};
    if (const std::string refusal = refusal_of(path, runs); !refusal.empty()) about["refused"] = printable(refusal);
    out << about << std::endl;
    if (!std::getline(in, line) || line != "solve") continue;
    solver.forget_rows();
    for (const Run& run : runs) out << json_of(solve_run(path, run, diagnosed, solver)) << std::endl;
  }
}

}  // namespace mortise
