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

// [C H; H^T .], lower triangle.
MatX with_motions(const MatX& C, const MatX& H) {
  const Eigen::Index m = C.rows(), s = H.cols();
  MatX compliance = MatX::Zero(m + s, m + s);
  compliance.topLeftCorner(m, m) = C;
  compliance.bottomLeftCorner(s, m) = H.transpose();
  return compliance;
}

GroupRows on_rows(const BodyGroup& group, const std::vector<int>& rows) {
  return {.C = group.C(rows, rows),
          .H = group.H(rows, Eigen::all),
          .response = group.load.response(rows, 0),
          .work = group.load.work};
}

// What lambda leaves open, but for the motions.
VecX open(const Interface& s, const VecX& lambda) { return s.gap - s.neumann.C * lambda - s.dirichlet.C * lambda; }

// Multipliers that a group takes for given displacements (the inverse of its C, its own motions free), and its share of
// a gap or a jump: by `weight`.
struct Share {
  std::shared_ptr<const MultiplierSystem> stiffness;
  const GroupRows* group;
  double weight;

  VecX multipliers(const VecX& displacement) const {
    return stiffness->solve(stacked(displacement, VecX::Zero(group->work.size()))).head(displacement.size());
  }
};

// `soft`: the softer group gets the larger share (of gaps), else the stiffer one (of jumps).
std::array<Share, 2> shares(const Interface& s, bool soft) {
  const double n = s.neumann.C.trace(), d = s.dirichlet.C.trace();
  std::array<Share, 2> both{Share{nullptr, &s.neumann, (soft ? n : d) / (n + d)},
                            Share{nullptr, &s.dirichlet, (soft ? d : n) / (n + d)}};
  for (Share& share : both)
    share.stiffness = std::make_shared<MultiplierSystem>(with_motions(share.group->C, share.group->H),
                                                         share.group->work.size(), all_rows(s.gap.size()));
  return both;
}

int dependent_row(const std::array<Share, 2>& both) {
  const int first = both[0].stiffness->dependent_row();
  return first >= 0 ? first : both[1].stiffness->dependent_row();
}

// A^-1; least squares where A is singular, as closed rows leave a motion free.
std::function<VecX(const VecX& b)> inverse(const MatX& A) {
  if (A.size() == 0) return [](const VecX& b) { return b; };
  return [factor = std::make_shared<LeastSquares>(A)](const VecX& b) { return factor->solve(b); };
}

}  // namespace

Interface make_interface(const BodyGroup& neumann, const BodyGroup& dirichlet, const VecX& gap0, const VecX& scale,
                         const std::vector<int>& closed) {
  Interface s{.neumann = on_rows(neumann, closed),
              .dirichlet = on_rows(dirichlet, closed),
              .gap = {},
              .gap0 = gap0(closed),
              .scale = scale(closed),
              .H = {},
              .work = stacked(neumann.load.work, dirichlet.load.work),
              .dirichlet_closed = {}};
  s.gap = s.gap0 + s.neumann.response + s.dirichlet.response;
  s.H.resize(s.gap.size(), s.work.size());
  s.H << s.neumann.H, s.dirichlet.H;
  s.dirichlet_closed =
      std::make_shared<MultiplierSystem>(with_motions(s.dirichlet.C, s.H), s.H.cols(), all_rows(s.gap.size()));
  return s;
}

DirichletSolution solve_dirichlet(const Interface& s, const VecX& lambda) {
  const VecX x = s.dirichlet_closed->solve(stacked(s.gap - s.neumann.C * lambda, s.work));
  return {.lambda = x.head(lambda.size()), .mu = x.tail(s.H.cols())};
}

Residuals residuals(const Interface& s, const VecX& lambda, const VecX& z) {
  const VecX taken = lambda + z;
  double displacement = 0;  // where it is zero, that of its terms: they leave round-off
  for (const GroupRows* group : {&s.neumann, &s.dirichlet}) {
    const VecX pressed = group->C * taken;
    const double terms = largest(largest_entry(group->response), largest_entry(pressed));
    displacement = largest({displacement, largest_entry(group->response - pressed), rigid_part * terms});
  }
  const double gap = largest(largest_entry(s.dirichlet.C * z), largest_entry(s.neumann.C * z));
  return {.kinematic = fraction(gap, displacement),
          .force = fraction(largest_entry(z.cwiseQuotient(s.scale)), largest_entry(taken.cwiseQuotient(s.scale)))};
}

InterfaceIteration neumann_dirichlet(const Interface& s) {
  InterfaceIteration iteration;
  iteration.dependent_row = s.dirichlet_closed->dependent_row();
  if (iteration.dependent_row >= 0) return iteration;
  iteration.multipliers = [](const VecX& lambda) { return lambda; };
  // A floating Neumann group needs a load in balance from the start.
  iteration.start = [&s](const VecX& lambda) -> VecX {
    if (s.neumann.work.size() == 0) return lambda;
    const VecX left = s.work - s.H.transpose() * lambda;
    return lambda + s.dirichlet_closed->solve(stacked(VecX::Zero(lambda.size()), left)).head(lambda.size());
  };
  iteration.correction = [&s](const VecX& lambda) -> VecX { return solve_dirichlet(s, lambda).lambda - lambda; };
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
    const VecX first = s.neumann.response - x, second = s.dirichlet.response + s.gap0 + x;
    return {both[0].stiffness->solve(stacked(first, s.neumann.work)).head(m),
            both[1].stiffness->solve(stacked(second, s.dirichlet.work)).head(m)};
  };
  // x also moves along with the floating bodies, so that the jump does no work on their motions.
  MatX SH(m, s.H.cols());
  for (Eigen::Index k = 0; k < s.H.cols(); ++k)
    SH.col(k) = both[0].multipliers(s.H.col(k)) + both[1].multipliers(s.H.col(k));
  const auto HSH = inverse(s.H.transpose() * SH);
  iteration.start = [&s](const VecX& lambda) -> VecX { return s.neumann.response - s.neumann.C * lambda; };
  iteration.multipliers = [both, taken](const VecX& x) -> VecX {
    const auto lambda = taken(x);
    return both[1].weight * lambda[0] + both[0].weight * lambda[1];
  };
  iteration.correction = [&s, both, taken, SH, HSH](const VecX& x) -> VecX {
    const auto lambda = taken(x);
    VecX jump = lambda[0] - lambda[1];
    const VecX along = HSH(s.H.transpose() * jump);
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
  const auto HMH = inverse(s.H.transpose() * MH);
  const auto balanced = [&s, MH, HMH](const VecX& lambda) -> VecX {
    return lambda + MH * HMH(s.work - s.H.transpose() * lambda);
  };
  iteration.multipliers = [](const VecX& lambda) { return lambda; };
  iteration.start = balanced;
  iteration.correction = [&s, precondition, balanced](const VecX& lambda) -> VecX {
    return balanced(lambda + precondition(open(s, lambda))) - lambda;
  };
  return iteration;
}

InterfaceIteration make_iteration(Scheme scheme, const Interface& interface) {
  switch (scheme) {
    case Scheme::neumann_dirichlet:
      return neumann_dirichlet(interface);
    case Scheme::neumann_neumann:
      return neumann_neumann(interface);
    case Scheme::dirichlet_dirichlet:
      return dirichlet_dirichlet(interface);
  }
  return {};
}

Spectrum spectrum(const InterfaceIteration& iteration, Eigen::Index rows) {
  const VecX start = iteration.start(VecX::Zero(rows)), at_start = iteration.correction(start);
  if (rows == 0 || !at_start.allFinite()) return {};
  const Eigen::Index n = rows, most = std::min<Eigen::Index>(n, 25);
  MatX V = MatX::Zero(n, most + 1), hessenberg = MatX::Zero(most + 1, most);
  for (Eigen::Index i = 0; i < n; ++i) V(i, 0) = std::sin(double(i * i) + 1);  // something of every eigenvector
  V.col(0).normalize();
  Eigen::Index steps = 0;
  while (steps < most) {
    VecX image = at_start - iteration.correction(start + V.col(steps));
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
  const VecX sizes = eigenvalues(hessenberg.topLeftCorner(steps, steps)).cwiseAbs();
  return {sizes.minCoeff(), sizes.maxCoeff()};
}

}  // namespace mortise
