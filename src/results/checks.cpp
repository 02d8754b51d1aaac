#include "results/checks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "results/line_checks.hpp"

namespace mortise {
namespace {

// What is left of a sum of forces, relative.
struct LeftOver {
  double force, moment;
};

// Of a sum about the middle of what the forces act on, `diagonal` in size; `size`: sum of their sizes. Of rings only
// what acts along the axis is in balance: radial forces and moments strain them.
LeftOver left_over(const Results& r, const Resultant& sum, double size, double diagonal) {
  if (r.problem.discretisation.model.axisymmetric()) return {fraction(std::abs(sum.force.y()), size), 0};
  return {fraction(sum.force.norm(), size), fraction(std::abs(sum.moment), size * diagonal)};
}

// Forces smaller than this are round-off of stiffness times displacement.
double rigid_force(const Results& r) {
  return rigid_part * largest_stiffness(r.problem.discretisation.system.K) * largest_entry(r.solution.u);
}

double balance_limit(const Results& r) { return std::max(1e-9, 10 * r.solution.force_tolerance); }

// Nodes of each body, those of bodies that hang together as one: their common nodes' forces belong to both.
std::vector<std::vector<int>> nodes_of_bodies(const Results& r) {
  const std::vector<int> first = bonded_to(r.problem.mesh, r.problem.points);
  std::vector<std::vector<int>> nodes(first.size());
  std::vector<char> counted(r.problem.mesh.nodes.rows(), 0);
  for (int b = 0; b < int(first.size()); ++b)
    for (int p = r.problem.points.first[b]; p < r.problem.points.first[b + 1]; ++p) {
      const int node = r.problem.points.node[p];
      if (!counted[node]) nodes[first[b]].push_back(node);
      counted[node] = 1;
    }
  return nodes;
}

// Largest out-of-balance force and moment of any body, over the sum of the forces on it (times its size).
void balance_of_bodies(const Results& r, double limit, std::vector<Check>& checks) {
  const SaddlePointSystem& s = r.problem.discretisation.system;
  const VecX forces = s.f - s.B.transpose() * r.solution.lambda + r.recovery.reactions.nodal;
  const double rigid = rigid_force(r);
  LeftOver worst{0, 0};
  for (const std::vector<int>& nodes : nodes_of_bodies(r)) {
    if (nodes.empty()) continue;  // counted with another body
    Eigen::AlignedBox2d box;
    for (const int node : nodes) box.extend(r.problem.mesh.nodes.row(node).transpose());
    Resultant sum;
    for (const int node : nodes)
      sum.add(r.problem.mesh.nodes.row(node).transpose() - (box.min() + box.max()) / 2, forces.segment<2>(2 * node));
    const LeftOver left = left_over(r, sum, largest(sum.size, rigid), box.diagonal().norm());
    worst = {largest(worst.force, left.force), largest(worst.moment, left.moment)};
  }
  checks.push_back({"force balance of each body", worst.force, limit});
  if (!r.problem.discretisation.model.axisymmetric())
    checks.push_back({"moment balance of each body", worst.moment, limit});
}

// Loads and reactions of all bodies, over the sizes of all forces, those of contact too.
void balance_of_all(const Results& r, double limit, std::vector<Check>& checks) {
  const SaddlePointSystem& s = r.problem.discretisation.system;
  const VecX contact = s.B.transpose() * r.solution.lambda;
  const Vec2 low = r.problem.mesh.nodes.colwise().minCoeff(), high = r.problem.mesh.nodes.colwise().maxCoeff();
  Resultant sum;
  double contact_size = 0;
  for (Eigen::Index i = 0; i < r.problem.mesh.nodes.rows(); ++i) {
    const Vec2 arm = r.problem.mesh.nodes.row(i).transpose() - (low + high) / 2;
    sum.add(arm, s.f.segment<2>(2 * i));
    sum.add(arm, r.recovery.reactions.nodal.segment<2>(2 * i));
    contact_size += contact.segment<2>(2 * i).norm();
  }
  const LeftOver left = left_over(r, sum, largest(sum.size + contact_size, rigid_force(r)), (high - low).norm());
  checks.push_back({balance_check, largest(left.force, left.moment), limit});
}

// What the contact puts on both sides of a pair, together: it must vanish.
void balance_of_contact(const Results& r, std::vector<Check>& checks) {
  struct Sums {
    Resultant both;
    double one_side = 0, length = 0;
  };
  std::vector<Sums> pairs;
  double round_off = 0;
  for (std::size_t k = 0; k < r.problem.pairs.size(); ++k) {
    const Coupling& coupling = r.problem.pairs[k].coupling;
    const std::map<int, Vec2> forces =
        contact_forces(coupling.B, r.solution.lambda.segment(r.problem.pairs[k].first_row, coupling.B.rows()));
    const ContactResults& c = r.recovery.contacts[k];
    const Vec2 centre = c.multiplier.nodes[c.multiplier.nodes.size() / 2].position;
    Sums& sums = pairs.emplace_back();
    sums.length = c.length;
    for (const auto& [node, contact] : forces)
      sums.both.add(r.problem.mesh.nodes.row(node).transpose() - centre, contact);
    for (const ContactNode& n : c.multiplier.nodes)
      if (const auto contact = forces.find(n.node); contact != forces.end()) sums.one_side += contact->second.norm();
    round_off = largest(round_off, std::numeric_limits<double>::epsilon() * sums.one_side);
  }
  double force = 0, moment = 0;
  for (const Sums& sums : pairs) {
    const double size = largest(sums.one_side, round_off);
    force = largest(force, fraction(sums.both.force.norm(), size));
    moment = largest(moment, fraction(std::abs(sums.both.moment), size * sums.length));
  }
  checks.push_back({"contact forces equal and opposite", force, 1e-10});
  checks.push_back({"contact moments equal and opposite", moment, 1e-10});
}

// p >= 0, gap >= 0 and p gap = 0 on unilateral rows, in the sense of the multipliers (docs/theory.md eq. 24).
void unilateral_checks(const Results& r, double limit, std::vector<Check>& checks) {
  const SaddlePointSystem& s = r.problem.discretisation.system;
  const Solution& solution = r.solution;
  const std::vector<char>& unilateral = s.unilateral;
  if (std::find(unilateral.begin(), unilateral.end(), 1) == unilateral.end()) return;
  VecX lambda = solution.lambda;
  if (r.problem.fluid.size() > 0) lambda += r.problem.fluid;  // what the faces press each other with
  VecX gap = s.B * solution.u - s.g;
  if (solution.compression.size() > 0) gap += s.layers.B * solution.compression;
  gap = gap.cwiseQuotient(s.row_scale).eval();
  const double displacement = largest_entry(solution.u);
  VecX round_off = VecX::Zero(gap.size());
  for (const ContactPair& pair : r.problem.pairs)
    round_off.segment(pair.first_row, pair.coupling.B.rows())
        .setConstant(round_off_pressure(r.problem.mesh, pair, r.problem.discretisation.laws, displacement));
  const double least = largest(negligible_pressure(r), largest_entry(round_off)),
               p_size = largest(10 * least, largest_entry(solution.lambda));
  double tension = 0, penetration = 0, product = 0, dip = 0;
  for (Eigen::Index a = 0; a < gap.size(); ++a) {
    if (!unilateral[a]) continue;
    tension = largest(tension, lambda(a) - round_off(a));
    penetration = largest(penetration, -gap(a));
    product = largest(product, std::abs(lambda(a) * gap(a)));
  }
  for (std::size_t k = 0; k < r.problem.pairs.size(); ++k)
    if (r.problem.pairs[k].spec.condition == Condition::unilateral)
      dip = largest(dip, fraction(-r.recovery.contacts[k].p_least,
                                  largest(10 * least, largest_entry(r.recovery.contacts[k].pressure))));
  checks.push_back({"p >= 0 at the multipliers", fraction(tension, p_size), limit});
  checks.push_back({"weighted gap >= 0", fraction(penetration, displacement), limit});
  checks.push_back({"p gap = 0", fraction(product, p_size * displacement), limit});
  checks.push_back({"p >= 0 between the multipliers", dip, 0.125 + 1e-9});
}

}  // namespace

double negligible_pressure(const Results& r) {
  return r.recovery.stress.points.size() > 0
             ? 1e-3 * r.recovery.stress.points.cwiseAbs().maxCoeff<Eigen::PropagateNaN>()
             : 0;
}

double unseen_force(const Results& r) { return balance_limit(r) * rigid_force(r); }

Seconds& Seconds::operator+=(const Seconds& other) {
  mesh += other.mesh;
  assemble += other.assemble;
  couple += other.couple;
  factorise += other.factorise;
  solve += other.solve;
  recover += other.recover;
  estimate += other.estimate;
  write += other.write;
  return *this;
}

int free_unknowns(const Results& r) {
  const std::vector<char>& fixed = r.problem.discretisation.system.constraints.fixed;
  return int(std::count(fixed.begin(), fixed.end(), 0));
}

std::vector<Check> checks(const Results& r) {
  const Solution& s = r.solution;
  std::vector<Check> list{{"residual of the forces", s.force_residual, s.force_tolerance},
                          {"residual of the contact condition", s.constraint_residual, s.constraint_tolerance}};
  balance_of_bodies(r, balance_limit(r), list);
  balance_of_all(r, s.iteration ? std::max(1e-10, 10 * s.force_tolerance) : 1e-10, list);
  balance_of_contact(r, list);
  if (!r.problem.pairs.empty()) list.push_back(coverage_check(r));
  unilateral_checks(r, std::max(s.constraint_tolerance, 1e-9), list);
  if (!r.problem.pairs.empty()) list.push_back(motion_check(r));
  return list;
}

Status verdict(const Results& r) {
  if (r.solution.status != SolveStatus::converged || !not_finite(r).empty()) return Status::not_converged;
  const bool all = std::all_of(r.checks.begin(), r.checks.end(), [](const Check& c) { return c.ok(); });
  return all ? Status::solved : Status::check_failed;
}

std::string not_finite(const Results& r) {
  const Solution& s = r.solution;
  if (!s.u.allFinite()) return "displacements";
  if (!s.lambda.allFinite()) return "contact pressures";
  if (!std::isfinite(s.force_residual) || !std::isfinite(s.constraint_residual)) return "residuals";
  if (!r.recovery.stress.points.allFinite() || !r.recovery.stress.centres.allFinite()) return "stresses";
  if (!std::isfinite(r.recovery.energy)) return "the energy";
  for (const ContactResults& c : r.recovery.contacts)
    for (const double figure : {c.length_in_contact, c.force.x(), c.force.y(), c.p_min, c.p_mean, c.p_max, c.p_least})
      if (!std::isfinite(figure)) return "contact pressures or forces";
  return "";
}

}  // namespace mortise
