#include "app/checks.hpp"

#include <algorithm>
#include <cmath>

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

double relative(double value, double size) { return size > 0 ? value / size : 0; }

// Forces that the contact, or everything but the body's own stiffness, puts on the nodes of a body.
Resultant resultant(const Results& r, int body, const Vec2& centre, const VecX& forces) {
  Resultant sum;
  for (int p = r.points.first[std::size_t(body)]; p < r.points.first[std::size_t(body) + 1]; ++p) {
    const int node = r.points.node[std::size_t(p)];
    sum.add(r.mesh.nodes.row(node).transpose() - centre, forces.segment<2>(2 * node));
  }
  return sum;
}

// Largest out-of-balance force and moment of any body, over the sum of the forces on it (times its size).
void balance_of_bodies(const SaddlePointSolution& solution, const SparseMatrix& B, double limit, Results& r) {
  const Discretisation& d = r.discretisation;
  const VecX contact = -(B.transpose() * solution.lambda);
  VecX forces = d.load + contact;
  const VecX Ku = d.stiffness.selfadjointView<Eigen::Lower>() * solution.u;
  for (Eigen::Index i = 0; i < forces.size(); ++i)
    if (d.constraints.fixed[std::size_t(i)]) forces(i) = Ku(i);  // load + contact + reaction
  double force = 0, moment = 0;
  const double rigid = rigid_part * largest_young(d) * solution.u.cwiseAbs().maxCoeff();
  for (int b = 0; b < int(r.mesh.bodies.size()); ++b) {
    Vec2 low(1e300, 1e300), high(-1e300, -1e300);
    for (int p = r.points.first[std::size_t(b)]; p < r.points.first[std::size_t(b) + 1]; ++p) {
      const Vec2 x = r.mesh.nodes.row(r.points.node[std::size_t(p)]).transpose();
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    const Resultant sum = resultant(r, b, (low + high) / 2, forces);
    const double size = std::max(sum.size, rigid);
    force = std::max(force, relative(sum.force.norm(), size));
    moment = std::max(moment, relative(std::abs(sum.moment), size * (high - low).norm()));
  }
  r.checks.push_back({"force balance of each body", force, limit});
  r.checks.push_back({"moment balance of each body", moment, limit});
}

// A pressure that would matter to the bodies: where contact carries none, p is round-off of this.
double least_pressure(const Results& r) {
  const auto size = r.mesh.nodes.colwise().maxCoeff() - r.mesh.nodes.colwise().minCoeff();
  return rigid_part * largest_young(r.discretisation) * r.u.cwiseAbs().maxCoeff() / size.norm();
}

// What the contact puts on both sides of a pair, together: it must vanish.
void balance_of_contact(const SaddlePointSolution& solution, const StackedCoupling& coupling, Results& r) {
  double force = 0, moment = 0;
  for (std::size_t k = 0; k < r.pairs.size(); ++k) {
    const int first = coupling.first_row[k], rows = coupling.first_row[k + 1] - first;
    const VecX contact = load_rows(r.pairs[k].coupling).transpose() * solution.lambda.segment(first, rows);
    const ContactResults& c = r.contacts[k];
    const Vec2 centre = c.multiplier.nodes[c.multiplier.nodes.size() / 2].position;
    Resultant sum;
    double on_multiplier_side = 0;
    for (Eigen::Index node = 0; node < r.mesh.nodes.rows(); ++node)
      sum.add(r.mesh.nodes.row(node).transpose() - centre, contact.segment<2>(2 * node));
    for (const ContactNode& n : c.multiplier.nodes) on_multiplier_side += contact.segment<2>(2 * n.node).norm();
    force = std::max(force, relative(sum.force.norm(), on_multiplier_side));
    moment = std::max(moment, relative(std::abs(sum.moment), on_multiplier_side * c.length));
  }
  r.checks.push_back({"contact forces equal and opposite", force, 1e-10});
  r.checks.push_back({"contact moments equal and opposite", moment, 1e-10});
}

// p >= 0, gap >= 0 and p gap = 0 on unilateral rows, in the sense of the multipliers (docs/theory.md eq. 24).
void unilateral_checks(const SaddlePointSolution& solution, const StackedCoupling& coupling, double limit, Results& r) {
  const std::vector<char> unilateral = unilateral_rows(r.pairs);
  if (std::find(unilateral.begin(), unilateral.end(), 1) == unilateral.end()) return;
  const VecX gap = (coupling.B * solution.u + coupling.gap0).cwiseQuotient(coupling.scale);
  const double displacement = solution.u.cwiseAbs().maxCoeff(), least = least_pressure(r),
               p_size = std::max(10 * least, solution.lambda.cwiseAbs().maxCoeff());
  double pull = 0, penetration = 0, product = 0, dip = 0;
  for (Eigen::Index a = 0; a < gap.size(); ++a) {
    if (!unilateral[std::size_t(a)]) continue;
    pull = std::max(pull, solution.lambda(a));
    penetration = std::max(penetration, -gap(a));
    product = std::max(product, std::abs(solution.lambda(a) * gap(a)));
  }
  for (std::size_t k = 0; k < r.pairs.size(); ++k)
    if (r.pairs[k].spec.condition == Condition::unilateral)
      dip = std::max(dip, relative(-r.contacts[k].p_least, std::max(10 * least, r.contacts[k].pressure.maxCoeff())));
  r.checks.push_back({"p >= 0 at the multipliers", relative(pull, p_size), limit});
  r.checks.push_back({"weighted gap >= 0", relative(penetration, displacement), limit});
  r.checks.push_back({"p gap = 0", relative(product, p_size * displacement), limit});
  r.checks.push_back({"p >= 0 between the multipliers", dip, 0.125 + 1e-9});
}

void contact_checks(const Scene& scene, Results& r) {
  const double least = least_pressure(r);
  double uncovered = 0, difference = 0;
  for (std::size_t k = 0; k < r.pairs.size(); ++k) {
    const ContactPair& pair = r.pairs[k];
    const ContactResults& c = r.contacts[k];
    if (pair.spec.initial_gap == InitialGap::closed) {
      const double facing = std::min(c.length, curve_length(r.mesh.nodes, pair.opposite));
      uncovered = std::max(uncovered, std::abs(1 - pair.coupling.covered_length / facing));
    }
    if (largest_entry(c.pressure) > least) difference = std::max(difference, c.sigma_n_difference);
  }
  if (r.pairs.empty()) return;
  // A closed curve meshed twice: the chords' lengths differ by their geometric error.
  r.checks.push_back({scene.method.integration == Integration::segments ? "segments cover the closed contact curve"
                                                                        : "points cover the closed contact curve",
                      uncovered, 1e-2});
  r.checks.push_back({"p against the bodies' sigma_n on 90 % of the length", difference, 0.1});
}

}  // namespace

void add_checks(const SaddlePointSolution& solution, const StackedCoupling& coupling, const Scene& scene, Results& r) {
  // An iteration is held to what it was asked for; that between bodies solves for the forces in each directly.
  const bool ddm = scene.method.kind == MethodKind::ddm, mssor = scene.method.solver == Solver::mssor;
  const double of_forces = mssor ? scene.method.mssor.tolerance : 1e-10;
  const double tolerance = ddm ? scene.method.ddm.tolerance : of_forces;
  r.checks.push_back({"residual of the forces", solution.force_residual, of_forces});
  r.checks.push_back({"residual of the contact condition", solution.constraint_residual, tolerance});
  balance_of_bodies(solution, load_rows(coupling), std::max(1e-9, 10 * of_forces), r);
  balance_of_contact(solution, coupling, r);
  contact_checks(scene, r);
  unilateral_checks(solution, coupling, std::max(tolerance, 1e-9), r);
  if (solution.status == SaddlePointSolution::Status::not_settled) r.status = Status::not_converged;
  const bool all = std::all_of(r.checks.begin(), r.checks.end(), [](const Check& c) { return c.ok(); });
  if (!all && r.status == Status::solved) r.status = Status::check_failed;
}

}  // namespace mortise
