#include "preprint_solvers/interface.hpp"

#include <memory>
#include <numeric>

#include "base/dense.hpp"

namespace mortise {
namespace {

std::vector<int> all_rows(Eigen::Index m) {
  std::vector<int> rows(m);
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

// [C H; H^T .] of a group with other motions than its own, lower triangle.
MatX with_motions(const MatX& C, const MatX& H) {
  const Eigen::Index m = C.rows(), s = H.cols();
  MatX compliance = MatX::Zero(m + s, m + s);
  compliance.topLeftCorner(m, m) = C;
  compliance.bottomLeftCorner(s, m) = H.transpose();
  return compliance;
}

// What lambda leaves open, but for the motions.
VecX open(const Interface& s, const VecX& lambda) { return s.gap - s.neumann.C * lambda - s.dirichlet.C * lambda; }

// Multipliers that a group takes for given displacements (the inverse of its C, its own motions free), and its share of
// a gap or a jump: by `weight`.
struct Share {
  std::shared_ptr<const MultiplierSystem> stiffness;
  const BodyGroup* group;
  double weight;

  VecX multipliers(const VecX& displacement) const {
    return stiffness->solve(stacked(displacement, VecX::Zero(group->motions))).head(displacement.size());
  }
};

// `soft`: the softer group gets the larger share (of gaps), else the stiffer one (of jumps).
std::array<Share, 2> shares(const Interface& s, bool soft) {
  const double n = s.neumann.C.trace(), d = s.dirichlet.C.trace();
  std::array<Share, 2> both{Share{nullptr, &s.neumann, (soft ? n : d) / (n + d)},
                            Share{nullptr, &s.dirichlet, (soft ? d : n) / (n + d)}};
  for (Share& share : both)
    share.stiffness =
        std::make_shared<MultiplierSystem>(share.group->compliance, share.group->motions, all_rows(s.gap.size()));
  return both;
}

int dependent_row(const std::array<Share, 2>& both) {
  const int first = both[0].stiffness->dependent_row();
  return first >= 0 ? first : both[1].stiffness->dependent_row();
}

}  // namespace

Interface make_interface(BodyGroup neumann, BodyGroup dirichlet, const SaddlePointSystem& s) {
  const VecX gap0 = (s.B * s.constraints.value - s.g).cwiseQuotient(s.row_scale);
  MatX H(gap0.size(), neumann.motions + dirichlet.motions);
  H << neumann.H, dirichlet.H;
  MatX compliance = with_motions(dirichlet.C, H);
  auto closed = std::make_shared<MultiplierSystem>(compliance, H.cols(), all_rows(gap0.size()));
  const VecX gap = gap0 + neumann.load.response + dirichlet.load.response,
             work = stacked(neumann.load.work, dirichlet.load.work);
  return {.neumann = std::move(neumann),
          .dirichlet = std::move(dirichlet),
          .gap = gap,
          .gap0 = gap0,
          .H = H,
          .work = work,
          .dirichlet_problem = {.compliance = std::move(compliance),
                                .scale = s.row_scale,
                                .unilateral = s.unilateral.empty() ? std::vector<char>(gap0.size(), 0) : s.unilateral},
          .dirichlet_closed = std::move(closed)};
}

DirichletSolution solve_dirichlet(const Interface& s, Rows rows, const VecX& lambda, const std::vector<char>& start) {
  const Eigen::Index m = s.gap.size();
  const VecX rhs = stacked(s.gap - s.neumann.C * lambda, s.work);
  if (rows == Rows::closed) {
    const VecX x = s.dirichlet_closed->solve(rhs);
    return {.lambda = x.head(m), .mu = x.tail(s.H.cols()), .active = {}, .closed = {}};
  }
  ActiveSetResult set = find_active_set(s.dirichlet_problem, rhs, start);
  if (set.status == SolveStatus::unconstrained || set.status == SolveStatus::dependent_row)
    return {.lambda = VecX::Constant(m, std::nan("")),
            .mu = VecX::Zero(s.H.cols()),
            .active = {},
            .held = false,
            .closed = {}};
  return {.lambda = std::move(set.lambda),
          .mu = std::move(set.mu),
          .active = std::move(set.active),
          .closed = std::move(set.system)};
}

Residuals residuals(const Interface& s, const VecX& lambda, const VecX& z) {
  const VecX taken = lambda + z;
  double displacement = 0;  // where it is zero, that of its terms: they leave round-off
  for (const BodyGroup* group : {&s.neumann, &s.dirichlet}) {
    const VecX pressed = group->C * taken;
    const double terms = largest(largest_entry(group->load.response), largest_entry(pressed));
    displacement = largest({displacement, largest_entry(group->load.response - pressed), rigid_part * terms});
  }
  const double multiplier = largest_entry(taken.cwiseQuotient(s.dirichlet_problem.scale));
  const double gap = largest(largest_entry(s.dirichlet.C * z), largest_entry(s.neumann.C * z));
  const double force = largest_entry(z.cwiseQuotient(s.dirichlet_problem.scale));
  return {fraction(gap, displacement), fraction(force, multiplier)};
}

InterfaceIteration neumann_dirichlet(const Interface& s, Rows rows) {
  const Eigen::Index m = s.gap.size();
  InterfaceIteration iteration;
  iteration.dependent_row = s.dirichlet_closed->dependent_row();
  if (iteration.dependent_row >= 0) return iteration;
  iteration.multipliers = [](const VecX& lambda) { return lambda; };
  // A floating Neumann group needs a load in balance from the start.
  iteration.start = VecX::Zero(m);
  if (s.neumann.motions > 0) iteration.start = s.dirichlet_closed->solve(stacked(iteration.start, s.work)).head(m);
  auto closed = std::make_shared<std::vector<char>>();  // of the last step, to start the next from
  iteration.correction = [&s, rows, closed](const VecX& x) -> VecX {
    VecX lambda = x;  // without rows that an accelerated step has left in tension
    if (rows == Rows::unilateral)
      for (Eigen::Index a = 0; a < lambda.size(); ++a)
        if (s.dirichlet_problem.unilateral[a]) lambda(a) = std::min(lambda(a), 0.0);
    DirichletSolution taken = solve_dirichlet(s, rows, lambda, *closed);
    *closed = std::move(taken.active);
    return taken.lambda - x;
  };
  return iteration;
}

InterfaceIteration neumann_dirichlet(const Interface& s, MultiplierSystem closed, VecX start) {
  InterfaceIteration iteration;
  iteration.multipliers = [](const VecX& lambda) { return lambda; };
  iteration.start = std::move(start);
  iteration.correction = [&s, closed = std::move(closed)](const VecX& x) -> VecX {
    return closed.solve(stacked(s.gap - s.neumann.C * x, s.work)).head(x.size()) - x;
  };
  return iteration;
}

InterfaceIteration neumann_neumann(const Interface& s) {
  const auto both = shares(s, false);
  const Eigen::Index m = s.gap.size();
  InterfaceIteration iteration;
  iteration.dependent_row = dependent_row(both);
  if (iteration.dependent_row >= 0) return iteration;
  // The multipliers of each group where B u of the Neumann group is x and contact is closed.
  const auto taken = [&s, both, m](const VecX& x) -> std::array<VecX, 2> {
    const VecX first = s.neumann.load.response - x, second = s.dirichlet.load.response + s.gap0 + x;
    return {both[0].stiffness->solve(stacked(first, s.neumann.load.work)).head(m),
            both[1].stiffness->solve(stacked(second, s.dirichlet.load.work)).head(m)};
  };
  // x also moves along with the floating bodies, so that the jump does no work on their motions.
  MatX SH(m, s.H.cols());
  for (Eigen::Index k = 0; k < s.H.cols(); ++k)
    SH.col(k) = both[0].multipliers(s.H.col(k)) + both[1].multipliers(s.H.col(k));
  const MatX HSH = s.H.transpose() * SH;
  iteration.start = VecX::Zero(m);
  iteration.multipliers = [both, taken](const VecX& x) -> VecX {
    const auto lambda = taken(x);
    return both[1].weight * lambda[0] + both[0].weight * lambda[1];
  };
  iteration.correction = [&s, both, taken, SH, HSH](const VecX& x) -> VecX {
    const auto lambda = taken(x);
    VecX jump = lambda[0] - lambda[1];
    const VecX along = solve_square(HSH, s.H.transpose() * jump);
    jump -= SH * along;
    VecX z = s.H * along;
    for (const Share& share : both) z += share.weight * share.weight * (share.group->C * jump);
    return z;
  };
  return iteration;
}

InterfaceIteration dirichlet_dirichlet(const Interface& s) {
  const auto both = shares(s, true);
  const Eigen::Index m = s.gap.size();
  InterfaceIteration iteration;
  iteration.dependent_row = dependent_row(both);
  if (iteration.dependent_row >= 0) return iteration;
  const auto precondition = [both](const VecX& gap) {
    VecX z = VecX::Zero(gap.size());
    for (const Share& share : both) z += share.weight * share.weight * share.multipliers(gap);
    return z;
  };
  MatX MH(m, s.H.cols());
  for (Eigen::Index k = 0; k < s.H.cols(); ++k) MH.col(k) = precondition(s.H.col(k));
  const MatX HMH = s.H.transpose() * MH;
  iteration.multipliers = [](const VecX& lambda) { return lambda; };
  iteration.start = MH * solve_square(HMH, s.work);  // in balance
  iteration.correction = [&s, precondition, MH, HMH](const VecX& lambda) -> VecX {
    const VecX z = precondition(open(s, lambda));
    return z + MH * solve_square(HMH, s.work - s.H.transpose() * (lambda + z));
  };
  return iteration;
}

Spectrum spectrum(const InterfaceIteration& iteration) {
  const VecX at_start = iteration.correction(iteration.start);
  if (at_start.size() == 0 || !at_start.allFinite()) return {};
  const Eigen::Index n = at_start.size(), most = std::min<Eigen::Index>(n, 25);
  MatX V = MatX::Zero(n, most + 1), hessenberg = MatX::Zero(most + 1, most);
  for (Eigen::Index i = 0; i < n; ++i) V(i, 0) = std::sin(double(i * i) + 1);  // something of every eigenvector
  V.col(0).normalize();
  Eigen::Index steps = 0;
  while (steps < most) {
    VecX image = at_start - iteration.correction(iteration.start + V.col(steps));
    for (int twice = 0; twice < 2; ++twice) {
      const VecX along = V.leftCols(steps + 1).transpose() * image;
      image -= V.leftCols(steps + 1) * along;
      hessenberg.col(steps).head(steps + 1) += along;
    }
    const double left = image.norm();
    hessenberg(steps + 1, steps) = left;
    ++steps;
    if (!(left > 1e-12 * hessenberg.cwiseAbs().maxCoeff())) break;
    V.col(steps) = image / left;
  }
  const VecX sizes = eigenvalue_moduli(hessenberg.topLeftCorner(steps, steps));
  return {sizes.minCoeff(), sizes.maxCoeff()};
}

}  // namespace mortise
