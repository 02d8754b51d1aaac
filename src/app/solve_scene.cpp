#include "app/solve_scene.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "app/solve_system.hpp"
#include "base/errors.hpp"
#include "base/printable.hpp"
#include "base/stopwatch.hpp"
#include "error/data_estimate.hpp"
#include "fields/load_fields.hpp"
#include "gmsh/load_mesh.hpp"
#include "mesh/copy_bodies.hpp"
#include "problem/fluid.hpp"
#include "problem/take_loads.hpp"
#include "results/audit_solution.hpp"
#include "results/checks.hpp"
#include "results/data_warnings.hpp"
#include "results/diagnose.hpp"
#include "results/error_report.hpp"
#include "results/line_checks.hpp"
#include "results/unheld.hpp"
#include "results/warnings.hpp"
#include "scene/check_ranges.hpp"
#include "scene/loads.hpp"

namespace mortise {
namespace {

// The scene's fields read, too.
Problem prepared(const Scene& scene, Mesh mesh, const Progress& progress = {}, const ActiveSet* start = nullptr) {
  check_ranges(scene);
  load_fields(scene);
  return prepare(scene, std::move(mesh), progress, start);
}

// The mesh with the overlaps of ties that are locked: what pretension makes of them before all other loads.
Mesh tightened(const Scene& scene, Mesh mesh, const Progress& progress) {
  if (std::ranges::none_of(scene.ties, &ContactSpec::locked)) return mesh;
  Scene alone = scaled_loads(scene, 0);
  for (ContactSpec& tie : alone.ties) tie.locked = false;
  Problem p = prepared(alone, std::move(mesh), progress);
  const Solution solution = SystemSolver(p).solve();
  require_solution(p, solution);
  if (solution.status != SolveStatus::converged)
    throw SceneError(
        "contact.locked: the solution under pretension alone, which the overlaps are from, has not converged");
  const Discretisation& d = p.discretisation;
  for (const auto& [k, overlap] : d.multipoint.overlaps)
    p.mesh.ties[k].pretension->overlap = overlap_of(overlap, *d.system.constraints.multipoint, solution.u);
  return std::move(p.mesh);
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

Problem check_scene(const Scene& scene) {
  return told_with_path(scene, [&] { return prepared(scene, scene_mesh(scene)); });
}

ActiveSet active_set(const Results& r) {
  ActiveSet set;
  for (const ContactPair& pair : r.problem.pairs) {
    std::vector<ActiveSet::Row>& rows = set.pairs.emplace_back();
    for (const int node : row_nodes(pair.coupling))
      rows.push_back({r.problem.mesh.nodes.row(node).transpose(), r.solution.active[pair.first_row + rows.size()]});
  }
  return set;
}

void estimate(Results& r, const AccuracySpec& spec, const std::vector<FoundPoint>& found, bool last) {
  Stopwatch watch;
  require_held(r, spec);
  Recovery& recovery = r.recovery;
  ForcesAsked asked;
  if (last) asked = ask_forces(r);
  r.estimate = estimate_error(r.problem, r.solution, *r.memory, {.spec = spec, .found = found, .also = asked.rows});
  add_data_errors(r.problem, r.solution, spec, *r.estimate);
  for (std::size_t k = 0; k < recovery.contacts.size(); ++k) set_bars(r.estimate->pressures[k], recovery.contacts[k]);
  const std::vector<PlaceError> of_probes =
      place_errors(r.problem, r.solution, r.estimate->pressures, probed_places(recovery.probes), *r.memory);
  for (std::size_t i = 0; i < of_probes.size(); ++i) recovery.probes[i].error = of_probes[i];
  leave_out_unheld(r);
  if (last) {
    set_force_bars(asked, std::exchange(r.estimate->also, {}), r);
    set_fitted_pressures(r);
  }
  append_lines(r.warnings, error_warnings(r));
  if (spec.of == Goal::pressure || spec.of == Goal::peak)
    if (auto check = estimate_check(r)) r.checks.push_back(*std::move(check));
  r.status = std::max(r.status, verdict(r));
  r.seconds.estimate = watch.lap();
}

void diagnose(Results& r) {
  const Stopwatch watch;
  r.inf_sup = inf_sup_report(r);
  r.seconds.estimate += watch.elapsed();
  if (!r.inf_sup) return;
  if (const auto line = inf_sup_warning(*r.inf_sup)) r.warnings.push_back(*line);
}

namespace {

// The motions that the solver left free, too: what holds them counts as prescribed.
void find_unheld(Results& r) {
  Problem& p = r.problem;
  const auto free = motions_through(p.mesh, p.floating.motions, p.floating.grounded, r.solution.rigid_modes);
  append_lines(r.warnings, held_lines(p.mesh, free));
  r.unheld = p.held.motions;
  r.unheld.insert(r.unheld.end(), free.begin(), free.end());
  for (const int unknown : held_unknowns(p.floating.grounded, r.solution)) {
    p.discretisation.system.constraints.fixed[unknown] = 1;
    p.idle.push_back(unknown);
  }
}

// What rows open by in round-off, over their size.
double round_off_of_rows(const Solution& solution) { return solution.constraint_tolerance * largest_entry(solution.u); }

using MovedNodes = std::vector<std::pair<int, Vec2>>;

// What a motion of bodies does, each node once.
MovedNodes moved_nodes(const Mesh& mesh, const BodyPoints& points, const std::vector<RigidMotion>& motion) {
  MovedNodes moved;
  for (const RigidMotion& of_body : motion)
    for (int p = points.first[of_body.body]; p < points.first[of_body.body + 1]; ++p)
      moved.emplace_back(points.node[p], of_body.at(mesh.nodes.row(points.node[p])));
  std::ranges::sort(moved, {}, &MovedNodes::value_type::first);
  const auto again = std::ranges::unique(moved, {}, &MovedNodes::value_type::first);
  moved.erase(again.begin(), again.end());
  return moved;
}

// Displacements along motions that nothing holds mean nothing, so that they are to be the least there are. Where held
// motions change closed rows, if only by the corners of the meshes, these are prescribed; whether any is.
bool prescribe_held(Problem& p, const Solution& solution) {
  if (p.held.motions.empty() || solution.status != SolveStatus::converged) return false;
  SaddlePointSystem& system = p.discretisation.system;
  const BodyPoints points = body_points(p.mesh);
  VecX shift = VecX::Zero(solution.u.size());
  for (const auto& set : least_motions(p.mesh, p.held.motions, solution.u))
    for (const auto& [node, by] : moved_nodes(p.mesh, points, set)) shift.segment<2>(2 * node) = by;
  VecX opening = (system.B * shift).cwiseQuotient(system.row_scale);
  for (Eigen::Index a = 0; a < opening.size(); ++a)
    if (!solution.active[a]) opening(a) = 0;
  if (largest_entry(opening) <= round_off_of_rows(solution)) return false;
  if (const auto& multipoint = system.constraints.multipoint) shift = (multipoint->inverse * shift).eval();
  for (const int unknown : p.held.grounded) system.constraints.value(unknown) += shift(unknown);
  system.start = solution.active;
  return true;
}

// Takes the other motions out of u, as far as closed rows stay closed and open ones open.
void take_out_unheld(const Problem& p, const std::vector<std::vector<RigidMotion>>& unheld, Solution& solution) {
  if (unheld.empty() || solution.status != SolveStatus::converged) return;
  const SaddlePointSystem& system = p.discretisation.system;
  const double round_off = round_off_of_rows(solution);
  VecX gap = system.B * solution.u - system.g;
  if (solution.compression.size() > 0) gap += system.layers.B * solution.compression;
  const BodyPoints points = body_points(p.mesh);
  for (const auto& set : least_motions(p.mesh, unheld, solution.u)) {
    const MovedNodes shift = moved_nodes(p.mesh, points, set);
    std::map<Eigen::Index, double> opening;
    for (const auto& [node, by] : shift)
      for (const int c : {0, 1})
        for (SparseMatrix::InnerIterator it(system.B, 2 * node + c); it; ++it) opening[it.row()] += it.value() * by(c);
    double part = 1;
    for (const auto& [row, by] : opening) {
      if (std::abs(by) <= round_off * system.row_scale(row)) continue;
      if (solution.active[row])
        part = 0;
      else if (by < 0)
        part = std::min(part, std::max(0.0, -gap(row) / by));
    }
    for (const auto& [node, by] : shift) solution.u.segment<2>(2 * node) += part * by;
    for (const auto& [row, by] : opening) gap(row) += part * by;
  }
}

void judge(Results& r) {
  r.checks = checks(r);
  r.status = verdict(r);
  const LargeDisplacement moved = large_displacement(r);
  r.contact_moved = moved.lost;
  append_lines(r.warnings, warnings(r, moved));
  if (!r.problem.accuracy) append_lines(r.warnings, data_warnings(r.problem.misfits));
  append_lines(r.warnings, audit_solution(r));
  append_lines(r.warnings, unheld_probes(r));
}

// Solved again as long as fluids get further.
Solution solve_wet(SystemSolver& solver, Problem& p) {
  Solution solution = solver.solve();
  while (solution.status == SolveStatus::converged && spread_fluids(solution, p)) {
    refuse_driven(p.mesh, p.pairs, p.held.motions, {"the fluid in the gaps pushes it"}, p.discretisation.system.f);
    p.discretisation.system.start = solution.active;
    const double factorise = solution.factorise_seconds;
    solution = solver.solve();
    solution.factorise_seconds += factorise;
  }
  return solution;
}

// The rest of results that have their problem.
void solve_problem(SystemSolver& solver, const Progress& progress, Results& r) {
  Problem& p = r.problem;
  Stopwatch watch;
  if (r.nodes.empty()) r.nodes = contact_nodes(p);  // before motions are held
  const double nodes_seconds = watch.lap();
  if (progress) progress("solve for " + std::to_string(free_unknowns(r)) + " unknowns");
  r.solution = solve_wet(solver, p);
  require_solution(p, r.solution);
  if (prescribe_held(p, r.solution)) {
    const double factorise = r.solution.factorise_seconds;
    r.solution = solve_wet(solver, p);
    require_solution(p, r.solution);
    r.solution.factorise_seconds += factorise;
  }
  add_fluids(p, r.solution);
  find_unheld(r);
  take_out_unheld(p, r.unheld, r.solution);
  r.seconds.factorise = r.solution.factorise_seconds;
  r.seconds.solve = watch.lap() - r.seconds.factorise;

  if (progress) progress("recover");
  r.recovery = recover(p, r.nodes, r.solution);
  judge(r);
  r.seconds.recover = nodes_seconds + watch.lap();
}

void take_problem(Problem&& problem, Results& r) {
  r.problem = std::move(problem);
  r.warnings = r.problem.warnings;
  r.seconds.assemble = r.problem.assemble_seconds;
  r.seconds.couple = r.problem.couple_seconds;
}

// The mesh of a solution in which bodies go through one another at pairs that patterns mean, with these known now; none
// where no such pair is missed: all others are open, however far the patterns look.
std::optional<Mesh> with_missed_pairs(Results& r) {
  std::vector<KnownPair>& known = r.problem.mesh.known_pairs;
  const std::size_t before = known.size();
  for (const KnownPair& pair : r.audited->missed)
    if (std::ranges::none_of(known, [&](const KnownPair& k) { return k.curves == pair.curves; })) known.push_back(pair);
  if (known.size() == before) return std::nullopt;
  return std::move(r.problem.mesh);
}

Results solve_on(const Scene& scene, Mesh mesh, const Progress& progress, const ActiveSet* start) {
  for (Seconds spent;;) {
    Results r;
    take_problem(prepared(scene, tightened(scene, std::move(mesh), progress), progress, start), r);
    SystemSolver solver(r.problem);
    solve_problem(solver, progress, r);
    r.seconds += spent;
    auto again = with_missed_pairs(r);
    if (!again) return r;
    mesh = *std::move(again);
    spent = r.seconds;
  }
}

}  // namespace

Results solve_scene(const Scene& scene, Mesh mesh, const Progress& progress, const ActiveSet* start) {
  return told_with_path(scene, [&] { return solve_on(scene, std::move(mesh), progress, start); });
}

CaseSolver::CaseSolver(std::optional<Mesh> mesh) : mesh_(std::move(mesh)) {}
CaseSolver::~CaseSolver() = default;

// Whether the results have the problem under the scene's loads now.
bool CaseSolver::take(const Scene& scene) {
  if (!scene_ || !differ_in_loads_alone(*scene_, scene)) return false;
  const Stopwatch watch;
  Results before = std::exchange(results_, {});
  results_.problem = std::move(before.problem);
  results_.memory = std::move(before.memory);
  results_.audited = std::move(before.audited);
  results_.nodes = std::move(before.nodes);
  results_.problem.discretisation.system.constraints.fixed = fixed_;
  check_ranges(scene, &*scene_);
  load_fields(scene);
  if (!take_loads(scene, results_.problem)) return false;
  results_.problem.warnings = results_.warnings = warnings_;
  SaddlePointSystem& system = results_.problem.discretisation.system;
  system.start = start_ ? starting_rows(*start_, results_.problem.mesh, results_.problem.pairs) : std::vector<char>();
  results_.seconds.assemble = watch.elapsed();
  ++shared_;
  return true;
}

void CaseSolver::begin(const Scene& scene, std::optional<Mesh> known, const Progress& progress) {
  scene_.reset();
  results_ = {};
  results_.memory = std::make_shared<EstimateMemory>(true);
  Stopwatch watch;
  if (progress) progress("mesh");
  Mesh mesh = known ? *std::move(known) : scene_mesh(scene, &results_.mesh_cached);
  results_.seconds.mesh = watch.lap();
  mesh = tightened(scene, std::move(mesh), progress);
  take_problem(prepared(scene, std::move(mesh), progress, start_ ? &*start_ : nullptr), results_);
  fixed_ = results_.problem.discretisation.system.constraints.fixed;
  warnings_ = results_.warnings;
  solver_ = std::make_unique<SystemSolver>(results_.problem);
  scene_ = scene;
}

Results& CaseSolver::solve(const Scene& scene, const Progress& progress) {
  return told_with_path(scene, [&]() -> Results& {
    if (!take(scene)) begin(scene, mesh_, progress);
    solve_problem(*solver_, progress, results_);
    while (auto again = with_missed_pairs(results_)) {
      const Seconds spent = results_.seconds;
      begin(scene, std::move(again), progress);
      solve_problem(*solver_, progress, results_);
      results_.seconds += spent;
    }
    start_ = active_set(results_);
    return results_;
  });
}

}  // namespace mortise
