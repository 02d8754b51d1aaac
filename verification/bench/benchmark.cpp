// Speed and memory of the mortar solve: its stages, and the whole against its limit, one Cholesky solve of the same
// stiffness by CHOLMOD. `mortise_benchmark --help` for the options.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <list>
#include <string>

#include "app/solve_scene.hpp"
#include "base/stopwatch.hpp"
#include "gmsh/load_mesh.hpp"
#include "limit.hpp"
#include "peak_memory.hpp"
#include "solve/dense_kernel.hpp"
#include "solve/threads.hpp"
#include "walls.hpp"

namespace mortise::bench {
namespace {

struct Options {
  int up_to = 320, threads = 0, repeats = 5, walls = 10;
};

Options read_options(int argc, char** argv) {
  Options options;
  CLI::App app("Speed and memory of the mortar solve on parabola 1: stages, and the whole against CHOLMOD alone.");
  app.add_option("--up-to", options.up_to, "largest mesh: elements along the upper contact curve, 40 to 640 (320)");
  app.add_option("--threads", options.threads,
                 "threads of the factorisation (default: all cores for large meshes, else 1)");
  app.add_option("--repeats", options.repeats, "runs of each that the table takes medians of (default 5)")
      ->check(CLI::Range(3, 1000));
  app.add_option("--walls", options.walls, "largest wall of many bodies: blocks along each side (default 10, 0: none)");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));
  }
  return options;
}

// One size of parabola 1, meshed.
struct Case {
  std::string name;
  Scene scene;
  Mesh mesh;
  double limit_megabytes = 0, whole_megabytes = 0;
};

Case make_case(int n_upper) {
  const std::string upper = std::to_string(n_upper), lower = std::to_string(n_upper * 5 / 4);
  Scene scene = read_scene(MORTISE_SOURCE_DIR "/geo/parabola_1.toml",
                           {{"mesh.parameters.n_upper", upper}, {"mesh.parameters.n_lower", lower}});
  Mesh mesh = load_mesh(scene.mesh_file, scene.mesh_parameters);
  return {upper + "x" + lower, std::move(scene), std::move(mesh)};
}

void measure_memory(Case& c) {
  GroundedSystem system;
  c.limit_megabytes =
      peak_megabytes([&] { system = grounded_system(c.mesh, discretise(resolve(c.scene, c.mesh), c.mesh)); },
                     [&] { cholmod_solution(system); });
  c.whole_megabytes = peak_megabytes([] {}, [&] { solve_scene(c.scene, std::move(c.mesh)); });
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

template <typename Work>
double seconds_of(const Work& work) {
  Stopwatch watch;
  work();
  return watch.lap();
}

void print_row(const Case& c, int repeats) {
  GroundedSystem system = grounded_system(c.mesh, discretise(resolve(c.scene, c.mesh), c.mesh));
  std::vector<double> limit, whole, ratios;
  std::vector<Seconds> stages;
  for (int i = 0; i < repeats; ++i) {
    limit.push_back(seconds_of([&] { cholmod_solution(system); }));
    Mesh mesh = c.mesh;
    whole.push_back(seconds_of([&] { stages.push_back(solve_scene(c.scene, std::move(mesh)).seconds); }));
    ratios.push_back(whole.back() / limit.back());
  }
  const auto stage = [&](double Seconds::*which) {
    std::vector<double> seconds;
    for (const Seconds& s : stages) seconds.push_back(s.*which);
    return median(seconds);
  };
  std::printf("%-9s %9d %9.4f %9.4f %6.2f %6.2f..%-6.2f %8.0f %8.0f %6.2f  %8.4f %8.4f %8.4f %8.4f %8.4f\n",
              c.name.c_str(), int(system.f.size()), median(limit), median(whole), median(whole) / median(limit),
              *std::min_element(ratios.begin(), ratios.end()), *std::max_element(ratios.begin(), ratios.end()),
              c.limit_megabytes, c.whole_megabytes, c.whole_megabytes / c.limit_megabytes, stage(&Seconds::assemble),
              stage(&Seconds::couple), stage(&Seconds::factorise), stage(&Seconds::solve), stage(&Seconds::recover));
  std::fflush(stdout);
}

void print_table(const std::list<Case>& cases, const Options& options, double empty_megabytes) {
  std::printf(
      "\nlimit: CHOLMOD analyse (AMD) + factorise (supernodal) + solve of the grounded stiffness.\n"
      "whole: solve_scene from the mesh to recovered stresses. Medians of %d runs, one case after the other; range: of "
      "the\n"
      "single pairs' ratios; threads: %s. MB: peak of a process that does nothing else, mesh and libraries\n"
      "(%.0f MB) included.\n\n",
      options.repeats, options.threads > 0 ? std::to_string(options.threads).c_str() : "as mortise chooses",
      empty_megabytes);
  std::printf("%-9s %9s %9s %9s %6s %14s %8s %8s %6s  %8s %8s %8s %8s %8s\n", "mesh", "unknowns", "limit s", "whole s",
              "ratio", "range", "limit MB", "whole MB", "ratio", "assemble", "couple", "factor", "solve", "recover");
  for (const Case& c : cases) print_row(c, options.repeats);
}

void run(const Options& options) {
  choose_dense_kernel();
  set_solver_threads(options.threads);
  const double empty_megabytes = peak_megabytes([] {}, [] {});
  std::list<Case> cases;
  for (const int n_upper : {40, 80, 160, 320, 640})
    if (n_upper <= options.up_to) cases.push_back(make_case(n_upper));
  // Children start with what this process holds: before anything is solved here.
  for (Case& c : cases) measure_memory(c);
  print_table(cases, options, empty_megabytes);
  if (options.walls > 0) print_walls(options.walls);
}

}  // namespace
}  // namespace mortise::bench

int main(int argc, char** argv) {
  try {
    mortise::bench::run(mortise::bench::read_options(argc, argv));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mortise_benchmark: %s\n", error.what());
    return 1;
  }
}
