// Errors and seconds of many ways to solve one problem, a CSV row a run. `mortise_chart --help` for the options.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>
#include <sstream>

#include "app/accuracy.hpp"
#include "base/errors.hpp"
#include "base/stopwatch.hpp"
#include "errors.hpp"
#include "given_fields.hpp"
#include "solve/dense_kernel.hpp"
#include "solve/threads.hpp"

namespace mortise::chart {
namespace {

struct Options {
  std::string problem, reference, pressure, fields;
  std::vector<std::string> runs;  // NAME;KEY=VALUE;KEY=VALUE...
  int turns = 3, threads = 1;
};

Options read_options(int argc, char** argv) {
  Options options;
  CLI::App app(
      "Solves one problem in several ways, by turns, and prints for each run errors and the seconds of each stage.\n"
      "Meshing and writing are in none of them, but of a way with accuracy.value s_total is the whole loop with its\n"
      "meshes. s_total is processor time, which other work on the machine hardly\n"
      "changes; s_wall and the stages are of the wall clock. On one thread and an idle machine both are the same.");
  app.add_option("problem", options.problem, "manufactured, rings or parabola_1")->required();
  app.add_option("--run", options.runs, "NAME;KEY=VALUE;...: a way to solve it, by the keys of the scene file")
      ->required();
  app.add_option("--turns", options.turns, "runs of each (default 3)")->check(CLI::Range(1, 1000));
  app.add_option("--threads", options.threads, "threads of the factorisation (default 1)")->check(CLI::Range(1, 1024));
  app.add_option("--reference", options.reference, "CSV of x,p: reference pressure of parabola_1");
  app.add_option("--pressure", options.pressure, "CSV to write: x,p of the (last) way's multiplier side");
  app.add_option("--fields", options.fields,
                 "FILES_bodies.txt and FILES_contact.txt of another program: the errors are theirs");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));
  }
  return options;
}

struct Way {
  std::string name;
  Problem problem;
  bool refused = false;
};

Way parse_way(const std::string& text, const Options& options) {
  std::istringstream words(text);
  Way way;
  std::getline(words, way.name, ';');
  std::vector<Override> settings;
  for (std::string word; std::getline(words, word, ';');) settings.push_back(parse_override(word));
  try {
    way.problem = make_problem(options.problem, settings, options.reference);
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s: %s\n", way.name.c_str(), error.what());
    way.refused = true;
  }
  return way;
}

void print_number(double value) { std::isfinite(value) ? std::printf(",%.9g", value) : std::printf(","); }

void print_heading() {
  std::printf(
      "name,turn,status,nodes,elements,dofs,multipliers,interface_steps,energy,e_energy,e_p_l2,e_p_l2_inner,"
      "e_p_max_inner,s_assemble,s_couple,s_factorise,s_solve,s_recover,s_total,s_wall\n");
}

void print_refused(const std::string& name) { std::printf("%s,0,refused,,,,,,,,,,,,,,,,,\n", name.c_str()); }

void print_row(const std::string& name, int turn, const Results& r, const RunErrors& e, double total, double wall) {
  const int steps = r.solution.iteration ? r.solution.iteration->steps : 0;
  std::printf("%s,%d,%s,%d,%d,%d,%d,%d", name.c_str(), turn, to_string(r.status).c_str(),
              int(r.problem.mesh.nodes.rows()), int(r.problem.mesh.cells.size()), free_unknowns(r),
              int(r.solution.lambda.size()), steps);
  std::printf(",%.17g", r.recovery.energy);
  const Seconds& s = r.seconds;
  for (const double value : {e.energy, e.p_l2, e.p_l2_inner, e.p_max_inner, s.assemble, s.couple, s.factorise, s.solve,
                             s.recover, total, wall})
    print_number(value);
  std::printf("\n");
  std::fflush(stdout);
}

// Seconds of this process on all processors.
double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

// One run; `errors` are computed in the first turn and kept.
void solve(Way& way, int turn, std::map<std::string, RunErrors>& errors, const Options& options) {
  Mesh mesh = way.problem.mesh;
  Stopwatch watch;
  const double start = processor_seconds();
  try {
    const Scene& scene = way.problem.scene;
    Results r = scene.accuracy ? *solve_to_accuracy(scene) : solve_scene(scene, std::move(mesh));
    const double total = processor_seconds() - start, wall = watch.lap();
    if (!options.fields.empty()) take_fields(r, options.fields);
    if (turn == 0) errors[way.name] = run_errors(r, way.problem);
    print_row(way.name, turn, r, errors.at(way.name), total, wall);
    if (turn == 0 && !options.pressure.empty()) write_pressure(r, options.pressure);
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s: %s\n", way.name.c_str(), error.what());
    way.refused = true;
    print_refused(way.name);
  }
}

void run(const Options& options) {
  choose_dense_kernel();
  set_solver_threads(options.threads);
  std::vector<Way> ways;
  for (const std::string& text : options.runs) ways.push_back(parse_way(text, options));
  print_heading();
  for (const Way& way : ways)
    if (way.refused) print_refused(way.name);
  std::map<std::string, RunErrors> errors;
  for (int turn = 0; turn < options.turns; ++turn)
    for (Way& way : ways)
      if (!way.refused) solve(way, turn, errors, options);
}

}  // namespace
}  // namespace mortise::chart

int main(int argc, char** argv) {
  try {
    mortise::chart::run(mortise::chart::read_options(argc, argv));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mortise_chart: %s\n", error.what());
    return 1;
  }
}
