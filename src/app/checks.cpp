#include "app/checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mortise {
namespace {

// Force and moment of nodal forces, and the sum of their sizes.
struct Resultant {
  Vec2 force = Vec2::Zero();
  double moment = 0, size = 0;

  void add(const Vec2& at, const Vec2& f) {
    force += f;
    moment += at.x() * f.y() - at.y() * f.x();
    size += f.norm();
  }
};

// Nodes of each body, those of bodies that hang together as one: their common nodes' forces belong to both.
std::vector<std::vector<int>> nodes_of_bodies(const Results& r) {
  const std::vector<int> first = bonded_to(r.mesh, r.points);
  std::vector<std::vector<int>> nodes(first.size());
  std::vector<char> counted(r.mesh.nodes.rows(), 0);
  for (int b = 0; b < int(first.size()); ++b)
    for (int p = r.points.first[b]; p < r.points.first[b + 1]; ++p) {
      const int node = r.points.node[p];
      if (!counted[node]) nodes[first[b]].push_back(node);
      counted[node] = 1;
    }
  return nodes;
}

// Largest out-of-balance force and moment of any body, over the sum of the forces on it (times its size).
void balance_of_bodies(const SaddlePointSolution& solution, const SparseMatrix& B, double limit, Results& r) {
  const Discretisation& d = r.discretisation;
  const VecX contact = -(B.transpose() * solution.lambda);
  VecX forces = d.load + contact;
  const VecX Ku = d.stiffness.selfadjointView<Eigen::Lower>() * solution.u;
  for (Eigen::Index i = 0; i < forces.size(); ++i)
    if (d.constraints.fixed[i]) forces(i) = Ku(i);  // load + contact + reaction
  double force = 0, moment = 0;
  const double rigid = rigid_part * largest_young(d) * largest_entry(solution.u);
  for (const std::vector<int>& nodes : nodes_of_bodies(r)) {
    if (nodes.empty()) continue;  // counted with another body
    Vec2 low(1e300, 1e300), high(-1e300, -1e300);
    for (const int node : nodes) {
      low = low.cwiseMin(r.mesh.nodes.row(node).transpose());
      high = high.cwiseMax(r.mesh.nodes.row(node).transpose());
    }
    Resultant sum;
    for (const int node : nodes)
      sum.add(r.mesh.nodes.row(node).transpose() - (low + high) / 2, forces.segment<2>(2 * node));
    const double size = largest(sum.size, rigid);
    force = largest(force, fraction(sum.force.norm(), size));
    moment = largest(moment, fraction(std::abs(sum.moment), size * (high - low).norm()));
  }
  r.checks.push_back({"force balance of each body", force, limit});
  r.checks.push_back({"moment balance of each body", moment, limit});
}

// What the contact puts on both sides of a pair, together: it must vanish.
void balance_of_contact(const SaddlePointSolution& solution, const StackedCoupling& coupling, Results& r) {
  double force = 0, moment = 0;
  for (std::size_t k = 0; k < r.pairs.size(); ++k) {
    const int first = coupling.first_row[k], rows = coupling.first_row[k + 1] - first;
    const VecX contact = r.pairs[k].coupling.B.transpose() * solution.lambda.segment(first, rows);
    const ContactResults& c = r.contacts[k];
    const Vec2 centre = c.multiplier.nodes[c.multiplier.nodes.size() / 2].position;
    Resultant sum;
    double on_multiplier_side = 0;
    for (Eigen::Index node = 0; node < r.mesh.nodes.rows(); ++node)
      sum.add(r.mesh.nodes.row(node).transpose() - centre, contact.segment<2>(2 * node));
    for (const ContactNode& n : c.multiplier.nodes) on_multiplier_side += contact.segment<2>(2 * n.node).norm();
    force = largest(force, fraction(sum.force.norm(), on_multiplier_side));
    moment = largest(moment, fraction(std::abs(sum.moment), on_multiplier_side * c.length));
  }
  r.checks.push_back({"contact forces equal and opposite", force, 1e-10});
  r.checks.push_back({"contact moments equal and opposite", moment, 1e-10});
}

// p >= 0, gap >= 0 and p gap = 0 on unilateral rows, in the sense of the multipliers (docs/theory.md eq. 24).
void unilateral_checks(const SaddlePointSolution& solution, const StackedCoupling& coupling, double limit, Results& r) {
  const std::vector<char> unilateral = unilateral_rows(r.pairs);
  if (std::find(unilateral.begin(), unilateral.end(), 1) == unilateral.end()) return;
  const VecX gap = (coupling.B * solution.u + coupling.gap0).cwiseQuotient(coupling.scale);
  const double displacement = largest_entry(solution.u), least = negligible_pressure(r),
               p_size = largest(10 * least, largest_entry(solution.lambda));
  double pull = 0, penetration = 0, product = 0, dip = 0;
  for (Eigen::Index a = 0; a < gap.size(); ++a) {
    if (!unilateral[a]) continue;
    pull = largest(pull, solution.lambda(a));
    penetration = largest(penetration, -gap(a));
    product = largest(product, std::abs(solution.lambda(a) * gap(a)));
  }
  for (std::size_t k = 0; k < r.pairs.size(); ++k)
    if (r.pairs[k].spec.condition == Condition::unilateral)
      dip = largest(dip, fraction(-r.contacts[k].p_least, largest(10 * least, largest_entry(r.contacts[k].pressure))));
  r.checks.push_back({"p >= 0 at the multipliers", fraction(pull, p_size), limit});
  r.checks.push_back({"weighted gap >= 0", fraction(penetration, displacement), limit});
  r.checks.push_back({"p gap = 0", fraction(product, p_size * displacement), limit});
  r.checks.push_back({"p >= 0 between the multipliers", dip, 0.125 + 1e-9});
}

void coverage_check(const Scene& scene, Results& r) {
  if (r.pairs.empty()) return;
  double uncovered = 0;
  for (std::size_t k = 0; k < r.pairs.size(); ++k) {
    const ContactPair& pair = r.pairs[k];
    if (pair.spec.initial_gap != InitialGap::closed) continue;
    const double facing = std::min(r.contacts[k].length, curve_length(r.mesh.nodes, pair.opposite));
    uncovered = largest(uncovered, std::abs(1 - pair.coupling.covered_length / facing));
  }
  // A closed curve meshed twice: the chords' lengths differ by their geometric error.
  r.checks.push_back({scene.method.integration == Integration::segments ? "segments cover the closed contact curve"
                                                                        : "points cover the closed contact curve",
                      uncovered, 1e-2});
}

// What of the results is not a number, or beyond any; empty if nothing is.
std::string not_finite(const SaddlePointSolution& solution, const Results& r) {
  if (!solution.u.allFinite()) return "displacements";
  if (!solution.lambda.allFinite()) return "contact pressures";
  if (!std::isfinite(solution.force_residual) || !std::isfinite(solution.constraint_residual)) return "residuals";
  if (!r.stress.points.allFinite() || !r.stress.centres.allFinite()) return "stresses";
  if (!std::isfinite(r.energy)) return "the energy";
  for (const ContactResults& c : r.contacts)
    for (const double figure : {c.length_in_contact, c.force.x(), c.force.y(), c.p_min, c.p_mean, c.p_max, c.p_least})
      if (!std::isfinite(figure)) return "contact pressures or forces";
  return "";
}

}  // namespace

double negligible_pressure(const Results& r) {
  double edge = std::numeric_limits<double>::infinity();
  for (const ContactPair& pair : r.pairs)
    for (const Edge& e : pair.multiplier.edges) edge = std::min(edge, edge_length(r.mesh.nodes, e));
  const double round_off = 1e-12 * largest_young(r.discretisation) * largest_entry(r.u) / edge;
  const double stress = r.stress.points.size() > 0 ? r.stress.points.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() : 0;
  return largest(1e-3 * stress, round_off);
}

void add_checks(const SaddlePointSolution& solution, const StackedCoupling& coupling, const Scene& scene, Results& r) {
  // An iteration is held to what it was asked for; that between bodies solves for the forces in each directly.
  const bool ddm = scene.method.kind == MethodKind::ddm, mssor = scene.method.solver == Solver::mssor;
  const double of_forces = mssor ? scene.method.mssor.tolerance : 1e-10;
  const double tolerance = ddm ? scene.method.ddm.tolerance : of_forces;
  r.checks.push_back({"residual of the forces", solution.force_residual, of_forces});
  r.checks.push_back({"residual of the contact condition", solution.constraint_residual, tolerance});
  balance_of_bodies(solution, coupling.B, std::max(1e-9, 10 * of_forces), r);
  balance_of_contact(solution, coupling, r);
  coverage_check(scene, r);
  unilateral_checks(solution, coupling, std::max(tolerance, 1e-9), r);
  if (solution.status == SaddlePointSolution::Status::not_settled) r.status = Status::not_converged;
  if (const std::string what = not_finite(solution, r); !what.empty()) {
    r.status = Status::not_converged;
    r.notes.push_back("not finite: " + what +
                      "; nothing of these results can be used. Expected loads, prescribed "
                      "displacements and settings in proportion, and an iteration that converges");
  }
  const bool all = std::all_of(r.checks.begin(), r.checks.end(), [](const Check& c) { return c.ok(); });
  if (!all && r.status == Status::solved) r.status = Status::check_failed;
}

}  // namespace mortise
