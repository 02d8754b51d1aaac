#include "app/solve_scene.hpp"

#include <cmath>
#include <sstream>

#include "app/checks.hpp"
#include "base/errors.hpp"
#include "base/stopwatch.hpp"
#include "io/gmsh_mesh.hpp"
#include "mesh/place.hpp"

namespace mortise {
namespace {

void require_available(const Scene& scene) {
  if (scene.method.kind == MethodKind::ddm)
    throw InputError(scene.path + ": method.kind = \"ddm\" is not available in this version; expected \"mortar\"");
}

std::string near_node(const Mesh& mesh, int node) { return near_point(mesh.nodes.row(node).transpose()); }

// Rows of B over their size: what contact can hold.
SparseMatrix unit_rows(const StackedCoupling& coupling) {
  SparseMatrix rows = coupling.B;
  for (Eigen::Index k = 0; k < rows.nonZeros(); ++k) rows.valuePtr()[k] /= coupling.scale(rows.innerIndexPtr()[k]);
  return rows;
}

void require_held(const Scene& scene, const Mesh& mesh, const Constraints& constraints,
                  const StackedCoupling& coupling) {
  const auto motions = free_motions(mesh, constraints, unit_rows(coupling));
  if (motions.empty()) return;
  throw InputError(scene.path + ": nothing holds " + describe(mesh, motions.front()) +
                   "; expected prescribed displacements or contact that prevent it");
}

void require_solved(const Scene& scene, const Results& r, const StackedCoupling& coupling,
                    const SaddlePointSolution& solution) {
  using Status = SaddlePointSolution::Status;
  if (solution.status == Status::not_positive_definite) {
    const int node = solution.failed_at / 2;
    throw InputError(scene.path + ": the stiffness is not positive definite " + near_node(r.mesh, node) +
                     ": a part of a body that nothing holds, or elements far out of shape there");
  }
  if (solution.status == Status::dependent_constraints) {
    std::size_t k = 0;
    while (coupling.first_row[k + 1] <= solution.failed_at) ++k;
    const Coupling& c = r.pairs[k].coupling;
    std::size_t a = 0;
    while (c.row[a] != solution.failed_at - coupling.first_row[k]) ++a;
    throw InputError(scene.path + ": " + r.pairs[k].spec.key + ": the contact condition " +
                     near_node(r.mesh, c.node[a]) +
                     " already follows from the others: prescribed displacements or other contact pairs hold the "
                     "same nodes; put the multipliers on the other curve or release the prescribed displacement");
  }
}

// What a user should know that no check fails for.
void add_notes(Results& r) {
  for (std::size_t k = 0; k < r.pairs.size(); ++k) {
    const ContactPair& pair = r.pairs[k];
    for (const DroppedMultiplier& d : pair.coupling.dropped)
      r.notes.push_back(pair.spec.key + ": multiplier " + near_node(r.mesh, d.node) + " " + d.reason);
    const double gap = std::max(std::abs(pair.coupling.gap_min), std::abs(pair.coupling.gap_max));
    double edge_size = 0;
    for (const Edge& edge : pair.multiplier.edges) edge_size = std::max(edge_size, edge_length(r.mesh.nodes, edge));
    const double displacement = r.u.cwiseAbs().maxCoeff();
    // A quadratic edge misses a smooth curve by far less than a percent of its length; a gap that small between
    // curves that differ everywhere is the meshes' own.
    if (pair.spec.initial_gap == InitialGap::measured && gap > 1e-3 * displacement && gap < 1e-2 * edge_size) {
      std::ostringstream text;
      text << pair.spec.key << ": the undeformed gap (up to " << gap << ") is small against the elements (" << edge_size
           << ") but not against the displacements (" << displacement
           << "); if the curves are one curve, set initial_gap = \"closed\"";
      r.notes.push_back(text.str());
    }
  }
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

Results solve_scene(const Scene& scene, const Progress& progress) {
  require_available(scene);
  Stopwatch watch;
  if (progress) progress("mesh");
  Mesh mesh = load_mesh(scene.mesh_file, scene.mesh_parameters);
  const double seconds = watch.lap();
  Results results = solve_scene(scene, std::move(mesh), progress);
  results.seconds.mesh = seconds;
  return results;
}

CheckedScene check_scene(const Scene& scene) {
  require_available(scene);
  CheckedScene checked{load_mesh(scene.mesh_file, scene.mesh_parameters), {}};
  const Constraints constraints = discretise(scene, checked.mesh).constraints;
  checked.pairs = couple_pairs(scene, checked.mesh, constraints);
  require_held(scene, checked.mesh, constraints, stack(checked.pairs, 2 * checked.mesh.nodes.rows()));
  return checked;
}

Results solve_scene(const Scene& scene, Mesh mesh, const Progress& progress) {
  require_available(scene);
  const auto stage = [&](const char* name) {
    if (progress) progress(name);
  };
  Results r;
  r.mesh = std::move(mesh);
  Stopwatch watch;

  stage("assemble");
  r.points = body_points(r.mesh);
  r.discretisation = discretise(scene, r.mesh);
  const Discretisation& d = r.discretisation;
  r.seconds.assemble = watch.lap();

  stage("couple");
  r.pairs = couple_pairs(scene, r.mesh, d.constraints);
  const StackedCoupling coupling = stack(r.pairs, d.load.size());
  require_held(scene, r.mesh, d.constraints, coupling);
  const auto floating = free_motions(r.mesh, d.constraints, SparseMatrix(0, d.load.size()));
  const std::vector<int> grounded = grounding_unknowns(r.mesh, d.constraints, floating);
  r.seconds.couple = watch.lap();

  stage("solve");
  double young = 0;
  for (const ElasticLaw& law : d.laws) young = std::max(young, law.young);
  const VecX g = -coupling.gap0;
  SaddlePointSolution solution = solve_saddle_point(
      {d.stiffness, d.load, coupling.B, g, d.constraints.fixed, d.constraints.value, young, coupling.scale, grounded});
  require_solved(scene, r, coupling, solution);
  r.u = solution.u;
  r.seconds.factorise = solution.factorise_seconds;
  r.seconds.solve = solution.solve_seconds;
  r.multipliers = int(coupling.B.rows());
  for (const char fixed : d.constraints.fixed) r.unknowns += !fixed;
  r.factor_bytes = solution.factor_bytes;
  watch.lap();

  stage("recover");
  r.stress = recover_stress(r.mesh, r.points, d.laws, r.u);
  r.energy = strain_energy(d, r.u);
  for (std::size_t k = 0; k < r.pairs.size(); ++k)
    r.contacts.push_back(contact_results(
        r.mesh, r.pairs[k], d.constraints, r.points, r.stress, r.u,
        solution.lambda.segment(coupling.first_row[k], coupling.first_row[k + 1] - coupling.first_row[k])));
  add_checks(solution, coupling, scene, r);
  add_notes(r);
  r.seconds.recover = watch.lap();
  return r;
}

}  // namespace mortise
