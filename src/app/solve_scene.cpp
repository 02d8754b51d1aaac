#include "app/solve_scene.hpp"

#include "app/audit.hpp"
#include "app/checks.hpp"
#include "app/decompose.hpp"
#include "app/notes.hpp"
#include "app/refusals.hpp"
#include "app/roles.hpp"
#include "app/solve_mssor.hpp"
#include "base/errors.hpp"
#include "base/stopwatch.hpp"
#include "io/gmsh_mesh.hpp"

namespace mortise {
namespace {

// The rows that are closed at first: those of a run on the same mesh, else (empty) all.
std::vector<char> starting_rows(const ActiveSet* start, const Results& r) {
  if (!start || start->nodes.rows() != r.mesh.nodes.rows() || start->nodes != r.mesh.nodes) return {};
  return start->node == row_nodes(r.pairs) ? start->active : std::vector<char>{};
}

// Bodies that take the displacement in domain decomposition; empty for the mortar method.
std::vector<char> roles(const Scene& scene, const Mesh& mesh, const Discretisation& d) {
  return scene.method.kind == MethodKind::ddm ? dirichlet_bodies(scene, mesh, d) : std::vector<char>{};
}

SaddlePointSolution solve_system(const Scene& scene, const SaddlePointSystem& system,
                                 const std::vector<char>& dirichlet, Results& r) {
  if (scene.method.kind == MethodKind::ddm) return decompose(scene, system, dirichlet, r);
  return scene.method.solver == Solver::mssor ? solve_mssor(scene, system, r) : solve_saddle_point(system);
}

void append(std::vector<std::string>& lines, const std::vector<std::string>& more) {
  lines.insert(lines.end(), more.begin(), more.end());
}

}  // namespace

std::string to_string(Status status) {
  switch (status) {
    case Status::solved:
      return "solved";
    case Status::not_converged:
      return "not_converged";
    case Status::check_failed:
      return "check_failed";
  }
  return "";
}

Results solve_scene(const Scene& scene, const Progress& progress, const ActiveSet* start) {
  Stopwatch watch;
  if (progress) progress("mesh");
  Mesh mesh = load_mesh(scene.mesh_file, scene.mesh_parameters, scene.geo_limits);
  const double seconds = watch.lap();
  Results results = solve_scene(scene, std::move(mesh), progress, start);
  results.seconds.mesh = seconds;
  return results;
}

CheckedScene check_scene(const Scene& scene) {
  CheckedScene checked{load_mesh(scene.mesh_file, scene.mesh_parameters, scene.geo_limits), {}, {}, {}};
  checked.discretisation = discretise(scene, checked.mesh);
  Discretisation& d = checked.discretisation;
  checked.pairs = couple_pairs(scene, checked.mesh, d, roles(scene, checked.mesh, d));
  checked.warnings = audit_scene(scene, checked.mesh, checked.pairs);
  require_closed(scene, checked.mesh, checked.pairs);
  append(checked.warnings, hold_free_motions(scene, checked.mesh, checked.pairs, stack(checked.pairs, d.load.size()),
                                             checked.warnings, d));
  return checked;
}

ActiveSet active_set(const Results& r) { return {r.mesh.nodes, row_nodes(r.pairs), r.active}; }

Results solve_scene(const Scene& scene, Mesh mesh, const Progress& progress, const ActiveSet* start,
                    const Adjust& adjust) {
  const auto stage = [&](const char* name) {
    if (progress) progress(name);
  };
  Results r;
  r.mesh = std::move(mesh);
  Stopwatch watch;

  stage("assemble");
  r.points = body_points(r.mesh);
  r.discretisation = discretise(scene, r.mesh);
  if (adjust) adjust(r.mesh, r.discretisation);
  const Discretisation& d = r.discretisation;
  r.seconds.assemble = watch.lap();

  stage("couple");
  const std::vector<char> dirichlet = roles(scene, r.mesh, d);
  r.pairs = couple_pairs(scene, r.mesh, d, dirichlet);
  const StackedCoupling coupling = stack(r.pairs, d.load.size());
  r.notes = audit_scene(scene, r.mesh, r.pairs);
  require_closed(scene, r.mesh, r.pairs);
  append(r.notes, hold_free_motions(scene, r.mesh, r.pairs, coupling, r.notes, r.discretisation));
  const Floating floating = find_floating(r.mesh, d.constraints);
  r.seconds.couple = watch.lap();

  stage("solve");
  const VecX g = -coupling.gap0;
  const SaddlePointSystem system{d.stiffness,
                                 d.load,
                                 coupling.B,
                                 g,
                                 d.constraints.fixed,
                                 d.constraints.value,
                                 largest_young(d),
                                 coupling.scale,
                                 floating.grounded,
                                 unilateral_rows(r.pairs),
                                 starting_rows(start, r)};
  SaddlePointSolution solution = solve_system(scene, system, dirichlet, r);
  require_solved(scene, r, floating, solution);
  hold_loose_motions(floating, solution, r);
  r.active = solution.active;
  r.steps = solution.steps;
  r.coarse_steps = solution.coarse_steps;
  r.u = solution.u;
  r.seconds.factorise = solution.factorise_seconds;
  r.seconds.solve = solution.solve_seconds;
  r.multipliers = int(coupling.B.rows());
  for (const char fixed : d.constraints.fixed) r.unknowns += !fixed;
  watch.lap();

  stage("recover");
  r.stress = recover_stress(r.mesh, r.points, d.laws, r.u);
  r.energy = strain_energy(d, r.u);
  for (std::size_t k = 0; k < r.pairs.size(); ++k)
    r.contacts.push_back(contact_results(
        r.mesh, r.pairs[k], d.constraints, r.points, r.stress, r.u,
        solution.lambda.segment(coupling.first_row[k], coupling.first_row[k + 1] - coupling.first_row[k])));
  const double negligible = negligible_pressure(r);
  for (std::size_t k = 0; k < r.pairs.size(); ++k)
    r.against_sigma_n.push_back(compare_with_stress(r.mesh, r.pairs[k], r.contacts[k], d.constraints, negligible));
  add_checks(solution, coupling, scene, r);
  add_notes(scene, solution.unsettled, r);
  append(r.notes, audit_solution(scene, r));
  r.seconds.recover = watch.lap();
  return r;
}

}  // namespace mortise
