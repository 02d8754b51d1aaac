#include "app/solve_scene.hpp"

#include <stdexcept>
#include <string_view>

#include "app/solve_system.hpp"
#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "base/stopwatch.hpp"
#include "ddm/ranks.hpp"
#include "error/data_estimate.hpp"
#include "fields/load_fields.hpp"
#include "gmsh/load_mesh.hpp"
#include "mesh/copy_bodies.hpp"
#include "problem/audit.hpp"
#include "problem/dirichlet_neumann.hpp"
#include "problem/ties.hpp"
#include "results/audit_solution.hpp"
#include "results/checks.hpp"
#include "results/data_warnings.hpp"
#include "results/diagnose.hpp"
#include "results/error_report.hpp"
#include "results/line_checks.hpp"
#include "results/unheld.hpp"
#include "results/warnings.hpp"
#include "solve/threads.hpp"

namespace mortise {
namespace {

// The rows that are closed at first: each as the nearest one of `start`; empty: all.
std::vector<char> starting_rows(const ActiveSet* start, const Mesh& mesh, const std::vector<ContactPair>& pairs) {
  if (!start || start->pairs.size() != pairs.size()) return {};
  std::vector<char> closed;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const std::vector<ActiveSet::Row>& rows = start->pairs[k];
    if (rows.empty()) return {};
    // Both run along the curve, though maybe against each other: on from the one before.
    std::size_t at = 0;
    for (const int node : row_nodes(pairs[k].coupling)) {
      const Vec2 x = mesh.nodes.row(node).transpose();
      const auto away = [&](std::size_t i) { return (rows[i].place - x).squaredNorm(); };
      if (closed.size() == std::size_t(pairs[k].first_row))
        for (std::size_t i = 1; i < rows.size(); ++i)
          if (away(i) < away(at)) at = i;
      while (at + 1 < rows.size() && away(at + 1) <= away(at)) ++at;
      while (at > 0 && away(at - 1) < away(at)) --at;
      closed.push_back(rows[at].active);
    }
  }
  return closed;
}

// Bodies that take the displacement in domain decomposition; empty without.
std::vector<char> dirichlet_roles(const Scene& scene, const Mesh& mesh, const Discretisation& d,
                                  const std::vector<ContactCurves>& curves) {
  if (scene.method.solver != Solver::ddm) return {};
  return dirichlet_bodies(scene.method.dirichlet, mesh, d, curves);
}

void append(std::vector<std::string>& lines, const std::vector<std::string>& more) {
  lines.insert(lines.end(), more.begin(), more.end());
}

struct Contact {
  std::vector<ContactPair> pairs;
  std::vector<std::string> warnings;  // of the audit, and of motions held
  std::vector<std::vector<RigidMotion>> held;
};

// Bodies drawn over one another may have no places that face each other: that is said first.
std::vector<ContactPair> coupled_pairs(const Scene& scene, const Mesh& mesh, const std::vector<ContactCurves>& curves,
                                       const std::vector<char>& dirichlet, const Discretisation& d) {
  try {
    return couple_pairs(scene.method, mesh, d, curves, dirichlet);
  } catch (const InputError&) {
    audit_scene(scene, mesh, {});
    throw;
  }
}

// Couples the pairs and puts their rows into the system; refuses what cannot be meant.
Contact add_contact(const Scene& scene, const Mesh& mesh, const std::vector<ContactCurves>& curves,
                    const std::vector<char>& dirichlet, Discretisation& d) {
  Contact contact{coupled_pairs(scene, mesh, curves, dirichlet, d), {}, {}};
  set_contact(contact.pairs, d.system);
  contact.warnings = mesh.notes;
  append(contact.warnings, audit_scene(scene, mesh, contact.pairs));
  require_closed(mesh, contact.pairs);
  contact.held = hold_free_motions(mesh, contact.pairs, contact.warnings, d.system);
  append(contact.warnings, held_lines(mesh, contact.held));
  return contact;
}

// Each rank reads or meshes the file by itself.
void require_same_mesh(const Mesh& mesh) {
  if (ranks().count() == 1) return;
  const std::string_view bytes(reinterpret_cast<const char*>(mesh.nodes.data()), mesh.nodes.size() * sizeof(double));
  std::size_t hash = std::hash<std::string_view>{}(bytes);
  for (const Cell& cell : mesh.cells)
    for (int a = 0; a < node_count(cell.kind); ++a) hash = 31 * hash + std::size_t(cell.nodes[a]);
  const double own = double(hash >> 24);  // sums of it are exact
  double sum = own;
  ranks().sum(&sum, 1);
  if (sum != own * ranks().count()) throw std::runtime_error(mesh.source + ": the ranks have different meshes of it");
}

// What `work` returns; what it refuses of the scene is told with the scene's path.
template <typename Work>
auto told_with_path(const Scene& scene, Work work) {
  try {
    return work();
  } catch (const SceneError& error) {
    throw InputError(scene.path + ": " + error.what());
  }
}

}  // namespace

Mesh scene_mesh(const Scene& scene, bool* cached) {
  return told_with_path(scene, [&] {
    return copy_bodies(load_mesh(scene.mesh_file, scene.mesh_parameters, scene.geo_limits, cached), scene.copies);
  });
}

Results solve_scene(const Scene& scene, const Progress& progress, const ActiveSet* start) {
  Stopwatch watch;
  if (progress) progress("mesh");
  bool cached = false;
  Mesh mesh = scene_mesh(scene, &cached);
  const double seconds = watch.lap();
  Results results = solve_scene(scene, std::move(mesh), progress, start);
  results.seconds.mesh = seconds;
  results.mesh_cached = cached;
  return results;
}

CheckedScene check_scene(const Scene& scene) {
  return told_with_path(scene, [&] {
    load_fields(scene);
    CheckedScene checked{scene_mesh(scene), {}, {}, {}};
    tie_curves(scene, checked.mesh);
    checked.discretisation = discretise(scene, checked.mesh);
    locate_probes(scene, checked.mesh);
    const std::vector<ContactCurves> curves = contact_curves(scene, checked.mesh);
    Contact contact =
        add_contact(scene, checked.mesh, curves, dirichlet_roles(scene, checked.mesh, checked.discretisation, curves),
                    checked.discretisation);
    checked.pairs = std::move(contact.pairs);
    checked.warnings = std::move(contact.warnings);
    return checked;
  });
}

ActiveSet active_set(const Results& r) {
  ActiveSet set;
  for (const ContactPair& pair : r.pairs) {
    std::vector<ActiveSet::Row>& rows = set.pairs.emplace_back();
    for (const int node : row_nodes(pair.coupling))
      rows.push_back({r.mesh.nodes.row(node).transpose(), r.solution.active[pair.first_row + rows.size()]});
  }
  return set;
}

void estimate(Results& r, const AccuracySpec& spec, const std::vector<FoundPoint>& found, bool forces) {
  Stopwatch watch;
  require_held(r, spec);
  r.estimate = estimate_error(r.mesh, r.points, r.discretisation, r.pairs, r.solution, spec, most_own_duals, found);
  add_data_errors(r.mesh, r.points, r.discretisation, r.pairs, r.solution, r.misfits, spec, *r.estimate);
  for (std::size_t k = 0; k < r.contacts.size(); ++k) set_bars(r.estimate->pressures[k], r.contacts[k]);
  const std::vector<PlaceError> of_probes = place_errors(r.mesh, r.points, r.discretisation, r.pairs, r.solution,
                                                         r.estimate->pressures, probed_places(r.probes));
  for (std::size_t i = 0; i < of_probes.size(); ++i) r.probes[i].error = of_probes[i];
  leave_out_unheld(r);
  if (forces) set_force_bars(r);
  append(r.warnings, error_warnings(r));
  if (auto check = estimate_check(r)) r.checks.push_back(*std::move(check));
  r.status = std::max(r.status, verdict(r));
  r.seconds.estimate = watch.lap();
}

void diagnose(const Scene& scene, Results& r) {
  const Stopwatch watch;
  r.inf_sup = inf_sup_report(scene, r);
  r.seconds.estimate += watch.elapsed();
  if (!r.inf_sup) return;
  if (const auto line = inf_sup_warning(*r.inf_sup)) r.warnings.push_back(*line);
}

namespace {

Results solve_on(const Scene& scene, Mesh mesh, const Progress& progress, const ActiveSet* start) {
  const auto stage = [&](const std::string& name) {
    if (progress) progress(name);
  };
  Results r;
  r.mesh = std::move(mesh);
  Stopwatch watch;
  require_same_mesh(r.mesh);
  tie_curves(scene, r.mesh);

  stage("assemble");
  load_fields(scene);
  r.points = body_points(r.mesh);
  r.discretisation = discretise(scene, r.mesh);
  r.misfits = data_misfits(scene, r.mesh, r.discretisation.laws);
  const std::vector<ProbePlace> probes = locate_probes(scene, r.mesh);
  SaddlePointSystem& system = r.discretisation.system;
  r.seconds.assemble = watch.lap();

  stage("couple");
  const std::vector<ContactCurves> curves = contact_curves(scene, r.mesh);
  const std::vector<char> dirichlet = dirichlet_roles(scene, r.mesh, r.discretisation, curves);
  for (std::size_t b = 0; b < dirichlet.size(); ++b)
    if (dirichlet[b]) r.dirichlet.push_back(r.mesh.bodies[b]);
  Contact contact = add_contact(scene, r.mesh, curves, dirichlet, r.discretisation);
  r.pairs = std::move(contact.pairs);
  r.warnings = std::move(contact.warnings);
  r.unheld = std::move(contact.held);
  const Floating floating = find_floating(r.mesh, system.constraints);
  system.grounded = floating.grounded;
  system.start = starting_rows(start, r.mesh, r.pairs);
  r.seconds.couple = watch.lap();

  stage("solve for " + std::to_string(free_unknowns(r)) + " unknowns");
  r.solution = solve_system(scene.method, system, unknowns_of(r.mesh, dirichlet));
  require_solution(r.mesh, r.pairs, floating, r.solution);
  std::vector<std::vector<RigidMotion>> free;
  for (const auto& mode : r.solution.rigid_modes.colwise())
    free.push_back(motion_through(r.mesh, floating.motions, floating.grounded, mode));
  append(r.warnings, held_lines(r.mesh, free));
  r.unheld.insert(r.unheld.end(), free.begin(), free.end());
  for (const int unknown : held_unknowns(floating.grounded, r.solution)) system.constraints.fixed[unknown] = 1;
  r.seconds.factorise = r.solution.factorise_seconds;
  r.seconds.solve = watch.lap() - r.seconds.factorise;

  stage("recover");
  const VecX& u = r.solution.u;
  r.stress = recover_stress(r.mesh, r.points, r.discretisation.laws, u);
  r.energy = strain_energy(r.discretisation, u);
  r.contacts.resize(r.pairs.size());
  for_each_index(r.pairs.size(), solver_threads(), [&](std::size_t k) {
    const ContactPair& pair = r.pairs[k];
    r.contacts[k] = contact_results(r.mesh, pair, system.constraints, r.points, r.stress, u,
                                    r.solution.lambda.segment(pair.first_row, pair.coupling.B.rows()));
  });
  r.probes = probe_values(r.mesh, r.points, r.discretisation.laws, u, r.stress, probes);
  r.extremes = find_extremes(r.mesh, r.points, r.stress, r.contacts);
  r.reactions = find_reactions(scene, r.mesh, r.discretisation, r.solution);
  r.checks = checks(scene, r);
  r.status = verdict(r);
  append(r.warnings, warnings(scene, r));
  if (!scene.accuracy) append(r.warnings, data_warnings(r.misfits));
  append(r.warnings, audit_solution(r));
  append(r.warnings, unheld_probes(scene, r));
  r.seconds.recover = watch.lap();
  return r;
}

}  // namespace

Results solve_scene(const Scene& scene, Mesh mesh, const Progress& progress, const ActiveSet* start) {
  return told_with_path(scene, [&] { return solve_on(scene, std::move(mesh), progress, start); });
}

}  // namespace mortise
