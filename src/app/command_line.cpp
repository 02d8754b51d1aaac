#include "app/command_line.hpp"

#include <sys/prctl.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <iostream>
#include <new>
#include <optional>
#include <sstream>

#include "app/accuracy.hpp"
#include "app/cases.hpp"
#include "app/check.hpp"
#include "app/picture.hpp"
#include "app/sweep.hpp"
#include "app/terminal.hpp"
#include "app/version.hpp"
#include "base/errors.hpp"
#include "base/printable.hpp"
#include "gmsh/mesh_cache.hpp"
#include "gmsh/write_msh.hpp"
#include "model/mesh_endings.hpp"
#include "output/output_folder.hpp"
#include "results/error_report.hpp"
#include "results/expected.hpp"
#include "results/report_text.hpp"
#include "solve/threads.hpp"

namespace mortise {
namespace {

struct Options {
  std::string scene;
  std::vector<std::string> set;
  std::string output;
  std::string accuracy, picture, one_case;
  bool quiet = false, diagnose = false, no_estimate = false, no_programs = false, no_cache = false;
  int threads = 0;
};

std::vector<Override> overrides(const Options& options) {
  std::vector<Override> list;
  for (const std::string& text : options.set) list.push_back(parse_override(text));
  if (!options.accuracy.empty()) list.push_back({"accuracy.value", options.accuracy});
  if (options.no_programs) list.push_back({"mesh.programs", "false"});  // last, so that nothing undoes it
  return list;
}

std::string stem(const Options& options) { return std::filesystem::path(options.scene).stem().string(); }

int exit_code(Status status) { return status == Status::solved ? 0 : 2; }

std::atomic<bool> interrupted = false;

// On the mesh that is found for the accuracy asked for.
Results solve_to_accuracy(const Scene& scene, const StageLine& line) {
  // The first Ctrl-C asks for the last complete answer, a second one ends the run.
  const auto old = std::signal(SIGINT, [](int) {
    interrupted = true;
    std::signal(SIGINT, SIG_DFL);
  });
  auto found = solve_to_accuracy(
      scene, [&](const std::string& name) { line(name); }, [] { return interrupted.load(); });
  std::signal(SIGINT, old);
  if (!found) throw InputError(scene.path + ": interrupted before the first solve was complete");
  return *std::move(found);
}

// The results would take the place of what they were made from.
void check_fields_stay(const Scene& scene, const std::filesystem::path& folder) {
  std::error_code ignored;
  for (const FieldSpec& field : scene.fields)
    if (std::filesystem::equivalent(std::filesystem::path(field.file).parent_path(), folder, ignored))
      throw InputError(field.key + ": " + field.file + " lies in the results folder; expected -o another folder");
}

// Or one of its cases.
Scene scene_of(const Options& options) {
  Scene scene = read_scene(options.scene, overrides(options));
  return options.one_case.empty() ? std::move(scene) : case_of(scene, options.one_case);
}

int solve_all_cases(const Options& options, const Scene& scene, const std::filesystem::path& folder,
                    std::optional<StageLine>& line) {
  const CaseTable table = write_cases(
      scene, {!options.no_estimate, options.diagnose}, [&](const std::string& name) { (*line)(name); }, folder);
  line.reset();
  if (!options.quiet) say(cases_text(scene.title, table, folder));
  const Status worst = table.worst();
  if (worst != Status::solved)
    std::cerr << "mortise: " << scene.path << ": " << to_string(worst)
              << ": not every case is solved (see the status in " << (folder / "cases.csv").string() << ")\n";
  return exit_code(worst);
}

// As with --accuracy: its mesh is found by estimates.
void refuse_no_estimate(const Options& options, const Scene& scene) {
  const auto asks = [](const LoadCase& load) { return bool(load.scene.accuracy); };
  if (options.no_estimate && (scene.accuracy || std::ranges::any_of(scene.cases, asks)))
    throw InputError("command line: --no-estimate: " + scene.path +
                     " asks for an accuracy, which is found by estimates; expected one or the other");
}

int solve(const Options& options) {
  const Scene scene = scene_of(options);
  refuse_no_estimate(options, scene);
  const std::filesystem::path folder = options.output.empty() ? "out/" + stem(options) : options.output;
  check_output_folder(folder);
  check_fields_stay(scene, folder);
  std::optional<StageLine> line(options.quiet);
  if (!scene.cases.empty()) return solve_all_cases(options, scene, folder, line);
  const auto stage = [&](const std::string& name) { (*line)(name); };
  Results results = scene.accuracy ? solve_to_accuracy(scene, *line) : solve_scene(scene, stage);
  if (!scene.accuracy && !options.no_estimate) {
    stage("estimate");
    estimate(results);
  }
  if (options.diagnose) {
    stage("diagnose");
    diagnose(results);
  }
  judge_expectations(results);
  results.solution.factor.reset();
  stage("write");
  Json report = report_of(results);
  write_results(results, report, folder);
  line.reset();
  if (!options.quiet) say(report_text(report, folder));
  if (results.status == Status::accuracy_not_reached)
    std::cerr << "mortise: " << scene.path << ": " << to_string(results.status) << ": " << results.accuracy->reason
              << "; largest part: " << largest_error(results) << "\n";
  else if (results.status != Status::solved)
    std::cerr << "mortise: " << scene.path << ": " << to_string(results.status) << " (see the summary's checks)\n";
  return exit_code(results.status);
}

bool is_geometry(const Options& options) {
  return is_mesh_ending(std::filesystem::path(options.scene).extension().string());
}

GeoLimits geo_limits(const Options& options) { return {.programs = !options.no_programs}; }

int check(const Options& options) {
  if (!is_geometry(options)) return check(scene_of(options), options.picture, options.quiet);
  if (!options.set.empty() || !options.one_case.empty())
    throw InputError("command line: " + options.scene +
                     " is no scene; expected a scene file (.toml) with --set and --case");
  return check_geometry(options.scene, geo_limits(options), options.picture, options.quiet);
}

int new_scene(const Options& options) {
  std::filesystem::path target = options.output;
  if (target.empty()) target = std::filesystem::path(options.scene).replace_extension(".toml");
  return new_scene(options.scene, geo_limits(options), target);
}

int mesh(const Options& options) {
  const Scene scene = read_scene(options.scene, overrides(options));
  const std::filesystem::path output = options.output.empty() ? "out/" + stem(options) + ".msh" : options.output;
  check_msh_target(output.string(), {scene.path, scene.mesh_file});
  if (output.has_parent_path()) std::filesystem::create_directories(output.parent_path());
  Status status = Status::solved;
  if (scene.accuracy) {
    const Results results = solve_to_accuracy(scene, StageLine(options.quiet));
    status = results.status;
    write_msh(results.problem.mesh, output.string());
  } else {
    write_msh(scene_mesh(scene), output.string());
  }
  if (!options.quiet) std::cout << output.string() << "\n";
  if (status != Status::solved)
    std::cerr << "mortise: " << scene.path << ": " << to_string(status) << " on this mesh (mortise solve says more)\n";
  return exit_code(status);
}

// As one of the processes of a sweep: it ends with it.
int solve_runs(const Options& options) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  serve_sweep(options.scene, overrides(options), options.diagnose, std::cin, std::cout);
  return 0;
}

// An option that is given says something: an empty variable of a shell script is no default.
CLI::Validator filled(const std::string& expected) {
  return {[expected](const std::string& text) {
            return text.empty() ? "expected " + expected + ", found an empty text" : std::string();
          },
          ""};
}

void add_geo_limits(CLI::App* command, Options& options) {
  command->add_flag("--no-programs", options.no_programs,
                    "refuse a .geo that runs programs or writes files: it is a program itself");
  command->add_flag("--no-cache", options.no_cache, "mesh a .geo anew, and do not keep its mesh for later runs");
}

CLI::App* add_command(CLI::App& app, const std::string& name, const std::string& what, Options& options,
                      const std::string& output) {
  CLI::App* command = app.add_subcommand(name, what);
  command->add_option("scene", options.scene, "scene file (.toml)")->required();
  command
      ->add_option("--set", options.set,
                   "override a value of the scene, e.g. mesh.parameters.n_upper=40; may be given several times")
      ->option_text("KEY=VALUE")
      ->allow_extra_args(false);
  if (!output.empty()) command->add_option("-o,--output", options.output, output)->check(filled("a path"));
  command->add_flag("--quiet", options.quiet, "print errors only");
  add_geo_limits(command, options);
  command->add_option("--threads", options.threads, "threads, for bodies beside each other (default: all cores)")
      ->check(CLI::Range(1, most_threads));
  return command;
}

void add_diagnose(CLI::App* command, Options& options) {
  command->add_flag("--diagnose", options.diagnose,
                    "find the inf-sup constant too: do the meshes control the pressure?");
}

void add_case(CLI::App* command, Options& options) {
  command->add_option("--case", options.one_case, "NAME: this one of the scene's cases, as a scene of its own")
      ->check(filled("the name of a case"));
}

CLI::Option* add_accuracy(CLI::App* command, Options& options) {
  return command
      ->add_option("--accuracy", options.accuracy,
                   "find a mesh on which the contact pressure is right to this part, such as 1%")
      ->check(filled("a part such as 1% or 0.01"));
}

CLI::App* add_solve(CLI::App& app, Options& options) {
  CLI::App* command = add_command(app, "solve", "mesh, solve, check and write the results of a scene", options,
                                  "folder of the results (default: out/SCENE)");
  add_diagnose(command, options);
  add_case(command, options);
  CLI::Option* accuracy = add_accuracy(command, options);
  command->add_flag("--no-estimate", options.no_estimate, "do not estimate the discretisation error")
      ->excludes(accuracy);
  return command;
}

CLI::App* add_check(CLI::App& app, Options& options) {
  CLI::App* command = add_command(
      app, "check",
      "read, mesh and validate a scene without solving it; of a geometry or mesh alone, list bodies and curves",
      options, "");
  add_case(command, options);
  command->add_option("--picture", options.picture, "FILE.png: draw bodies, curves, supports, loads and contact pairs")
      ->check(filled("a .png, .pdf or .svg to write"));
  return command;
}

CLI::App* add_new(CLI::App& app, Options& options) {
  CLI::App* command = app.add_subcommand("new", "write a scene from a geometry or a mesh, to be filled in");
  command->add_option("file", options.scene, "geometry (.geo) or mesh")->required();
  command->add_option("-o,--output", options.output, "scene file to write (default: FILE.toml beside it)")
      ->check(filled("a path"));
  add_geo_limits(command, options);
  return command;
}

CLI::App* add_mesh(CLI::App& app, Options& options) {
  CLI::App* command =
      add_command(app, "mesh", "write the mesh of a scene", options, ".msh to write (default: out/SCENE.msh)");
  add_accuracy(command, options);
  return command;
}

// Not shown: `mortise sweep` starts it.
CLI::App* add_solve_runs(CLI::App& app, Options& options) {
  CLI::App* command = add_command(app, "solve-runs", "solve the runs of a sweep", options, "");
  add_diagnose(command, options);
  return command->group("");
}

// A script reads the options, and takes the place of this process.
void add_scripted(CLI::App& app, const std::string& name, const std::string& script, const std::string& what) {
  CLI::App* command = app.add_subcommand(name, what + " (mortise " + name + " --help has the options)");
  command->set_help_flag();
  command->prefix_command();
  command->callback([command, script] { become_script(script, command->remaining()); });
}

// CLI11 says only that there is none.
void refuse_unknown_subcommand(const CLI::App& app, int argc, const char* const* argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() == argv[1]) return;
    if (!command->get_group().empty()) names.push_back(command->get_name());
  }
  throw InputError("command line: " + unknown_name("subcommand", argv[1], names));
}

// The exit status of --help and --version; none of a command.
std::optional<int> parse(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0)
      throw InputError(std::string("command line: ") + error.what() + " (mortise --help)");
    std::ostringstream text;
    const int status = app.exit(error, text, text);
    say(text.str());
    return status;
  }
}

int parse_and_run(int argc, const char* const* argv) {
  CLI::App app("Two-dimensional frictionless contact of linear-elastic bodies on meshes that do not match.");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.footer(
      "Exit status: 0 solved and all checks hold; 1 bad input; 2 a check fails or no convergence; 3 internal error.");
  Options options;
  CLI::App* solve_command = add_solve(app, options);
  CLI::App* check_command = add_check(app, options);
  CLI::App* new_command = add_new(app, options);
  CLI::App* mesh_command = add_mesh(app, options);
  add_solve_runs(app, options);
  add_scripted(app, "sweep", "sweeps/sweep.py", "solve a scene many times, one CSV row a run");
  add_scripted(app, "picture", "pictures/picture.py", "draw the results in a folder");
  add_scripted(app, "certify", "reports/certify.py",
               "solve a scene by several means and say which figures agree within their bars");
  add_scripted(app, "report", "reports/report.py", "write one page of the results in a folder, to hand over");
  add_scripted(app, "window", "scenes/window.py", "look at a scene in gmsh's window, pick, check and solve");
  refuse_unknown_subcommand(app, argc, argv);
  if (const auto status = parse(app, argc, argv)) return *status;

  set_solver_threads(options.threads);
  set_mesh_cache(!options.no_cache);
  if (*solve_command) return solve(options);
  if (*check_command) return check(options);
  if (*new_command) return new_scene(options);
  if (*mesh_command) return mesh(options);
  return solve_runs(options);
}

}  // namespace

int run_command_line(int argc, const char* const* argv) {
  struct CacheOff {  // as a library has it
    ~CacheOff() { set_mesh_cache(false); }
  } const cache_off;
  const PrintableStream out(std::cout);
  const PrintableStream err(std::cerr);
  const auto refuse = [](const std::string& line) {
    std::cerr << "mortise: error: " << in_short(printable(line)) << "\n";
    return 1;
  };
  try {
    const int status = parse_and_run(argc, argv);
    if (std::cout.flush()) return status;
    return refuse("the standard output cannot be written");
  } catch (const InputError& error) {
    return refuse(error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return refuse(error.path1().string() + ": " + error.code().message());
  } catch (const std::bad_alloc&) {
    return refuse("out of memory: the mesh is too large for this machine");
  } catch (const std::exception& error) {
    std::cerr << "mortise: internal error: " << printable(error.what()) << "\n";
    return 3;
  }
}

}  // namespace mortise
