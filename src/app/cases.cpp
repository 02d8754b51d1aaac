#include "app/cases.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <set>
#include <sstream>

#include "app/accuracy.hpp"
#include "app/next_sizes.hpp"
#include "app/run_table.hpp"
#include "base/errors.hpp"
#include "base/printable.hpp"
#include "base/stopwatch.hpp"
#include "output/output_folder.hpp"
#include "output/vtu.hpp"
#include "results/expected.hpp"
#include "solve/dense_kernel.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

const std::string bad_input = "bad input: ";

// What no case can be solved for is the scene's own.
void refuse_if_all_are(const Scene& scene, const CaseTable& table) {
  const std::string& first = table.rows.at(0).status;
  if (first.starts_with(bad_input) &&
      std::ranges::all_of(table.rows, [&](const auto& row) { return row.second.status == first; }))
    throw InputError(first.substr(bad_input.size()) + (scene.cases.size() > 1 ? " (every case)" : ""));
}

std::string shortest(double value) { return worded(std::setprecision(15), value); }

// The columns that say which case it is.
void set_keys(const Scene& scene, CaseTable& table) {
  table.keys = {"case"};
  if (std::ranges::any_of(scene.cases, [](const LoadCase& load) { return load.scale != 1; }))
    table.keys.emplace_back("scale");
  const std::size_t own = table.keys.size();
  for (const LoadCase& load : scene.cases) {
    std::vector<std::string>& values = table.values.emplace_back();
    values = {load.name};
    if (own > 1) values.push_back(shortest(load.scale));
    for (const auto& [key, value] : load.changed) {
      std::size_t k =
          std::size_t(std::find(table.keys.begin() + std::ptrdiff_t(own), table.keys.end(), key) - table.keys.begin());
      if (k == table.keys.size()) table.keys.push_back(key);
      values.resize(std::max(values.size(), k + 1));
      values[k] = value;
    }
  }
  for (auto& values : table.values) values.resize(table.keys.size());
}

// A mesh for all cases, and which of them it was found with.
struct SharedMesh {
  AccurateMesh found;
  std::vector<char> leads;  // of each case
  std::vector<char> open;   // of each case, as of AccurateMesh
};

// The bars of a case on a mesh that was found for all; whether they are what was asked.
bool estimate_case(const AccuracySpec& spec, const SharedMesh& on, std::size_t k, Results& r) {
  estimate(r, spec, on.found.found);
  r.accuracy = on.found.report;
  r.accuracy->solves[on.found.report.answer() - 1] = {free_unknowns(r), on.open[k] ? 0 : estimated_error(r, spec.of),
                                                      r.seconds.total()};
  const bool reached = r.accuracy->reached();
  if (reached)
    r.accuracy->reason.clear();
  else
    r.status = std::max(r.status, Status::accuracy_not_reached);
  return reached;
}

// All cases one after another, on the mesh that is found for them or else on each scene's own.
class Run {
 public:
  Run(const Scene& scene, const CaseOptions& options, const Progress& progress, const TakeCase& take)
      : scene_(scene), options_(options), progress_(progress), take_(take) {
    set_keys(scene, table);
  }

  void solve(const SharedMesh* on = nullptr) {
    table.warnings.assign(scene_.cases.size(), {});
    reached.assign(scene_.cases.size(), 0);
    CaseSolver solver(on ? std::optional<Mesh>(on->found.mesh) : std::nullopt);
    for (std::size_t k = 0; k < scene_.cases.size(); ++k) table.rows[k] = solve_case(k, on, solver);
    refuse_if_all_are(scene_, table);
    table.shared = solver.shared();
  }

  Progress stage_of(std::size_t k) const {
    return [this, k](const std::string& name) {
      if (progress_)
        progress_("case " + std::to_string(k + 1) + " of " + std::to_string(scene_.cases.size()) + ", " +
                  scene_.cases[k].name + ": " + name);
    };
  }

  CaseTable table;
  std::vector<char> reached;  // of each case, whether the accuracy is that it asks for

 private:
  RunRow solve_case(std::size_t k, const SharedMesh* on, CaseSolver& solver) try {
    const LoadCase& load = scene_.cases[k];
    Results& results = solver.solve(load.scene, stage_of(k));
    if (on)
      reached[k] = estimate_case(*load.scene.accuracy, *on, k, results);
    else if (options_.estimated)
      estimate(results);
    if (options_.diagnosed) diagnose(results);
    judge_expectations(results);
    table.warnings[k] = results.warnings;
    const Json report = report_of(results);
    const RunRow row = row_of(results, report);
    if (take_) take_(load, results);
    return row;
  } catch (const InputError& error) {
    return {printable(bad_input + error.what()), {}};
  }

  const Scene& scene_;
  const CaseOptions& options_;
  const Progress& progress_;
  const TakeCase& take_;
};

// Whether any case asks for an accuracy: then all do, of one geometry.
bool seek_accuracy(const Scene& scene) {
  if (std::ranges::none_of(scene.cases, [](const LoadCase& load) { return bool(load.scene.accuracy); })) return false;
  for (const LoadCase& load : scene.cases) {
    const Scene& own = load.scene;
    if (own.accuracy == scene.accuracy && own.mesh_file == scene.mesh_file &&
        own.mesh_parameters == scene.mesh_parameters)
      continue;
    throw InputError(scene.path + ": case '" + load.name +
                     "': the mesh of an accuracy is found for all cases; expected one geometry and one [accuracy], or "
                     "this case by --case " +
                     load.name);
  }
  return true;
}

SharedMesh mesh_for(const Scene& scene, std::vector<char> leads, const Progress& progress) {
  std::vector<const Scene*> leading;
  for (std::size_t k = 0; k < leads.size(); ++k)
    if (leads[k]) leading.push_back(&scene.cases[k].scene);
  SharedMesh mesh{mesh_to_accuracy(leading, progress), std::move(leads), {}};
  std::size_t found = 0;
  for (const char lead : mesh.leads) mesh.open.push_back(lead ? mesh.found.open[found++] : 0);
  return mesh;
}

// The mesh that serves the ends of a history mostly serves all that lies between them.
std::vector<char> ends_lead(std::size_t cases) {
  std::vector<char> leads(cases, 0);
  leads.front() = leads.back() = 1;
  return leads;
}

// Where the cases that lead have no solution on any mesh, perhaps others have.
SharedMesh first_mesh(const Scene& scene, const Progress& progress) try {
  return mesh_for(scene, ends_lead(scene.cases.size()), progress);
} catch (const InputError&) {
  if (scene.cases.size() <= 2) throw;  // all lead
  return mesh_for(scene, std::vector<char>(scene.cases.size(), 1), progress);
}

// On a mesh that is good enough for all, if there is one.
void solve_accurately(const Scene& scene, const Progress& progress, Run& run) {
  SharedMesh mesh = first_mesh(scene, progress);
  for (;;) {
    run.solve(&mesh);
    std::vector<char> leads = mesh.leads;
    for (std::size_t k = 0; k < leads.size(); ++k)
      if (!run.reached[k]) leads[k] = 1;
    if (leads == mesh.leads) return;
    mesh = mesh_for(scene, std::move(leads), progress);
  }
}

Json summary_of(const Scene& scene, const CaseTable& table) {
  Json cases = Json::array();
  for (const auto& [k, row] : table.rows)
    cases.push_back({{"name", scene.cases[k].name},
                     {"scale", scene.cases[k].scale},
                     {"status", row.status},
                     {"warnings", table.warnings[k]}});
  return {{"title", scene.title},
          {"scene", scene.path},
          {"changes", scene.changes},
          {"version", MORTISE_VERSION},
          {"dense_kernel", dense_kernel()},
          {"status", to_string(table.worst())},
          {"cases", cases},
          {"shared_factor", table.shared},
          {"seconds", {{"total", table.seconds}}}};
}

// ParaView's list of files: the cases take the place of times.
void write_collection(const Scene& scene, const CaseTable& table, const fs::path& path) {
  std::ofstream file(path);
  file << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const auto& [k, row] : table.rows)
    if (!row.figures.empty())
      file << "<DataSet timestep=\"" << k << "\" part=\"0\" file=\"" << case_folder << "/" << scene.cases[k].name
           << "/result.vtu\"/>\n";
  file << "</Collection>\n</VTKFile>\n";
  file.close();
  if (!file) throw InputError(path.string() + ": cannot be written");
}

double figure(const RunRow& row, const std::string& name) {
  const auto found = std::ranges::find(row.figures, name, &std::pair<std::string, double>::first);
  return found == row.figures.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
}

// Of the pairs of a row, "contact.0", that with the largest p; whether there are others.
std::pair<std::string, bool> most_pressed(const RunRow& row) {
  constexpr std::string_view end = ".pressure.max";
  std::string key;
  double most = -std::numeric_limits<double>::infinity();
  int pairs = 0;
  for (const auto& [name, value] : row.figures) {
    if (!name.starts_with("contact.") || !name.ends_with(end) || std::isnan(value)) continue;
    ++pairs;
    if (!(value > most)) continue;
    most = value;
    key = name.substr(0, name.size() - end.size());
  }
  return {key, pairs > 1};
}

// "solved, largest p 5.8e8 within 3.1e6, in contact 0.0101, force (0, -9.2e6)", of several pairs "on contact.1".
std::string row_text(const RunRow& row) {
  std::ostringstream text;
  text << std::setprecision(6) << row.status;
  const auto [key, one_of_several] = most_pressed(row);
  if (key.empty()) return text.str();
  text << ", largest p " << figure(row, key + ".pressure.max");
  if (const double bar = figure(row, key + ".pressure.max_error"); !std::isnan(bar))
    text << std::setprecision(2) << " within " << bar << std::setprecision(6);
  if (one_of_several) text << " on " << key;
  text << ", in contact " << figure(row, key + ".length_in_contact") << ", force (" << figure(row, key + ".force.x")
       << ", " << figure(row, key + ".force.y") << ")";
  return text.str();
}

void print_cases(const CaseTable& table, std::ostream& out) {
  constexpr std::size_t most = 20;
  std::size_t told = 0, left = 0;
  for (const auto& [k, row] : table.rows) {
    if (told == most) {
      ++left;
      continue;
    }
    out << "  case      " << table.values[k][0] << ": " << row_text(row) << "\n";
    ++told;
  }
  if (left > 0) out << "            and " << left << " more in cases.csv\n";
}

// What a warning says, whatever its figures.
std::string without_figures(std::string warning) {
  std::erase_if(warning, [](unsigned char c) { return std::isdigit(c) || c == '.' || c == '-'; });
  return warning;
}

// Each once, with the cases that have it.
void print_warnings(const CaseTable& table, std::ostream& out) {
  constexpr std::size_t most = 5;
  std::map<std::string, std::set<std::string>> cases;
  std::vector<std::string> order;
  for (std::size_t k = 0; k < table.warnings.size(); ++k)
    for (const std::string& warning : table.warnings[k]) {
      std::set<std::string>& with = cases[without_figures(warning)];
      if (with.empty()) order.push_back(warning);
      with.insert(table.values[k][0]);
    }
  for (std::size_t i = 0; i < std::min(order.size(), most); ++i) {
    const std::size_t with = cases[without_figures(order[i])].size();
    out << "  warning   " << (with > 1 ? "in " + std::to_string(with) + " cases, first " : "") << order[i] << "\n";
  }
  if (order.size() > most) out << "  warning   " << order.size() - most << " more in summary.json\n";
}

}  // namespace

Status CaseTable::worst() const {
  Status worst = Status::solved;
  for (const auto& [k, row] : rows) worst = std::max(worst, status_of(row));
  return worst;
}

CaseTable solve_cases(const Scene& scene, const CaseOptions& options, const Progress& progress, const TakeCase& take) {
  const Stopwatch watch;
  Run run(scene, options, progress, take);
  if (seek_accuracy(scene))
    solve_accurately(scene, progress, run);
  else
    run.solve();
  run.table.seconds = watch.elapsed();
  return std::move(run.table);
}

Scene case_of(const Scene& scene, const std::string& name) {
  const auto load = std::ranges::find(scene.cases, name, &LoadCase::name);
  if (load != scene.cases.end()) return load->scene;
  std::vector<std::string> known;
  for (const LoadCase& one : scene.cases) known.push_back(one.name);
  throw InputError(scene.path + ": " + unknown_name("case", name, known));
}

CaseTable write_cases(const Scene& scene, const CaseOptions& options, const Progress& progress,
                      const fs::path& folder) {
  std::set<std::string> written;
  const TakeCase take = [&](const LoadCase& load, Results& results) {
    Json report = report_of(results);
    write_results(results, report, folder / case_folder / load.name, scene.case_files == CaseFiles::all);
    written.insert(load.name);
  };
  const CaseTable table =
      solve_cases(scene, options, progress, scene.case_files == CaseFiles::table ? TakeCase() : take);
  OutputFolder output(folder);
  write_table(output.path("cases.csv"), table.keys, table.values, table.rows);
  if (scene.case_files == CaseFiles::all && !why_no_vtu()) write_collection(scene, table, output.path("cases.pvd"));
  std::ofstream file(output.path("summary.json"));
  file << summary_of(scene, table).dump(2) << "\n";
  file.close();
  if (!file) throw InputError(folder.string() + ": cannot write summary.json");
  output.commit(written);
  return table;
}

std::string cases_text(const std::string& title, const CaseTable& table, const fs::path& folder) {
  std::ostringstream out;
  const auto solved =
      std::ranges::count_if(table.rows, [&](const auto& row) { return status_of(row.second) == Status::solved; });
  out << printable(title) << "\n  " << to_string(table.worst()) << "; " << solved << " of " << table.rows.size()
      << " cases are solved; figures in " << (folder / "cases.csv").string() << "\n";
  print_cases(table, out);
  print_warnings(table, out);
  out << std::fixed << std::setprecision(3) << "  seconds   " << table.seconds << ", "
      << table.seconds / double(std::max<std::size_t>(table.rows.size(), 1)) << " a case; " << table.shared
      << " of them had the factor of the one before\n";
  return out.str();
}

}  // namespace mortise
