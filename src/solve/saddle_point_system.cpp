#include "solve/saddle_point_system.hpp"

namespace mortise {
namespace {

// K u, and |K| |u|, the sizes of the terms that each entry is the sum of: a row an unknown.
Points multiply(const SparseMatrix& lower, const VecX& u) {
  Points p = Points::Zero(u.size(), 2);
  for (int j = 0; j < int(lower.cols()); ++j) {
    double sum = p(j, 0), size = p(j, 1);
    SparseMatrix::InnerIterator it(lower, j);
    const auto add = [&] {
      const double term = it.value() * u(it.row());
      sum += term;
      size += std::abs(term);
    };
    if (it && it.row() == j) {
      add();
      ++it;
    }
    for (; it; ++it) {
      add();
      const double across = it.value() * u(j);
      p(it.row(), 0) += across;
      p(it.row(), 1) += std::abs(across);
    }
    p.row(j) << sum, size;
  }
  return p;
}

}  // namespace

std::vector<int> held_unknowns(const std::vector<int>& grounded, const Solution& solution) {
  std::vector<int> held;
  for (Eigen::Index k = 0; k < solution.rigid_modes.rows(); ++k)
    if (solution.rigid_modes.cols() > 0 && largest_entry(solution.rigid_modes.row(k).transpose()) > 1e-6)
      held.push_back(grounded[k]);
  return held;
}

double largest_stiffness(const SparseMatrix& K) {
  double most = 0;
  for (int j = 0; j < int(K.cols()); ++j)  // whose first entry is on the diagonal, if it has that
    if (const SparseMatrix::InnerIterator it(K, j); it && it.row() == j) most = largest(most, std::abs(it.value()));
  return most;
}

VecX unbalanced_forces(const SaddlePointSystem& s, const Solution& solution) {
  if (solution.unbalanced.size() == s.f.size()) return solution.unbalanced;
  return s.f - s.K.selfadjointView<Eigen::Lower>() * solution.u - s.B.transpose() * solution.lambda;
}

void measure_residuals(const SaddlePointSystem& s, Solution& solution) {
  const Points Ku = multiply(s.K, solution.u);
  const VecX pressure = s.B.transpose() * solution.lambda;
  const double forces = largest({largest_entry(s.f), largest_entry(Ku.col(0)), largest_entry(pressure)});
  solution.unbalanced = s.f - Ku.col(0) - pressure;
  solution.force_residual = fraction(0, forces);
  std::vector<char> held = s.constraints.fixed;
  for (const int unknown : held_unknowns(s.grounded, solution)) held[unknown] = 1;
  for (Eigen::Index i = 0; i < pressure.size(); ++i)
    if (!held[i])
      solution.force_residual = largest(
          solution.force_residual, fraction(std::abs(solution.unbalanced(i)), largest(forces, rigid_part * Ku(i, 1))));
  VecX open = (s.g - s.B * solution.u).cwiseQuotient(s.row_scale);
  for (Eigen::Index a = 0; a < open.size(); ++a)
    if (!solution.active[a]) open(a) = 0;
  solution.constraint_residual = fraction(largest_entry(open), largest_entry(solution.u));
}

}  // namespace mortise
