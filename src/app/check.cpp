#include "app/check.hpp"

#include <map>
#include <sstream>

#include "app/picture.hpp"
#include "app/terminal.hpp"
#include "base/errors.hpp"
#include "base/printable.hpp"
#include "gmsh/load_mesh.hpp"
#include "mesh/measures.hpp"
#include "results/report_text.hpp"

namespace mortise {
namespace {

// "copies    100 of coarse, 50 of fine"
std::string copies_line(const Scene& scene) {
  std::map<std::string, int> counts;
  for (const BodyCopy& copy : scene.copies) ++counts[copy.body];
  std::vector<std::string> words;
  for (const auto& [body, count] : counts) words.push_back(std::to_string(count) + " of " + body);
  return words.empty() ? "" : "  copies    " + listed(words) + "\n";
}

// "cases     half, full, hot; the above is the scene without them"
std::string cases_line(const Scene& scene) {
  std::vector<std::string> names;
  for (const LoadCase& load : scene.cases) names.push_back(load.name);
  return names.empty() ? "" : "  cases     " + listed(names) + "; the above is the scene without them\n";
}

// Where those bodies and curves are whose names are only tags.
std::string measures_lines(const Mesh& mesh) {
  if (!mesh.named_by_tag) return "";
  std::ostringstream text;
  const auto tell = [&](const std::string& name, const char* size, const Measure& measure) {
    text << "            " << name << ": " << size << " " << measure.size << ", centre "
         << near_point(measure.centre).substr(5) << "\n";
  };
  const std::vector<Measure> bodies = body_measures(mesh), boundaries = boundary_measures(mesh);
  for (std::size_t b = 0; b < bodies.size(); ++b) tell(mesh.bodies[b], "area", bodies[b]);
  for (std::size_t b = 0; b < boundaries.size(); ++b) tell(mesh.boundaries[b].name, "length", boundaries[b]);
  return text.str();
}

}  // namespace

int check(const Scene& scene, const std::string& picture, bool quiet) {
  const Problem problem = check_scene(scene);
  const int drawn = picture.empty() ? 0 : draw_setup(problem, picture);
  if (quiet) return drawn;
  std::ostringstream text;
  text << printable(scene.title) << "\n  mesh      " << problem.mesh.source << ": " << problem.mesh.nodes.rows()
       << " nodes, " << problem.mesh.cells.size() << " elements\n"
       << measures_lines(problem.mesh) << copies_line(scene) << model_text(model_report(problem));
  const std::size_t count = problem.pairs.size(), told = count > told_in_full ? told_of_many : count;
  for (std::size_t k = 0; k < told; ++k) {
    const ContactPair& pair = problem.pairs[k];
    text << "  contact   " << pair.spec.between[0] << " - " << pair.spec.between[1] << ": "
         << to_string(pair.spec.condition) << ", frictionless, gap " << gap_words(pair) << ", "
         << pair.coupling.gap0.size() << " multipliers on " << pair.spec.multipliers_on << ", facing over "
         << pair.coupling.covered_length << "\n";
  }
  if (told < count) text << "            and " << count - told << " more pairs\n";
  text << "  left out  friction, large displacements, plasticity, time"
       << (scene.body_forces.empty() && !scene.gravity ? ", body forces" : "")
       << (scene.initial_strains.empty() ? ", initial strains" : "") << "\n";
  for (const std::string& warning : problem.warnings) text << "  warning   " << warning << "\n";
  text << cases_line(scene);
  say(text.str());
  return drawn;
}

int check_geometry(const std::string& file, const GeoLimits& limits, const std::string& picture, bool quiet) {
  std::vector<std::string> words;
  if (!picture.empty()) words = {"--picture", picture};
  if (quiet) words.emplace_back("--quiet");
  return run_on_geometry("curves", load_all_named(file, limits), words);
}

int new_scene(const std::string& file, const GeoLimits& limits, const std::filesystem::path& target) {
  if (std::filesystem::exists(target))
    throw InputError(target.string() + ": is there already and stays as it is; expected -o another file");
  return run_on_geometry("new", load_all_named(file, limits), {target.string()});
}

}  // namespace mortise
