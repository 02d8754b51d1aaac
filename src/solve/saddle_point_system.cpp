#include "solve/saddle_point_system.hpp"

namespace mortise {
namespace {

// K u, and |K| |u|: the sizes of the terms that each entry is the sum of.
struct Product {
  VecX sum, size;
};

Product multiply(const SparseMatrix& lower, const VecX& u) {
  Product p{VecX::Zero(u.size()), VecX::Zero(u.size())};
  const auto add = [&](int row, double term) {
    p.sum(row) += term;
    p.size(row) += std::abs(term);
  };
  for (int j = 0; j < int(lower.cols()); ++j)
    for (SparseMatrix::InnerIterator it(lower, j); it; ++it) {
      add(int(it.row()), it.value() * u(j));
      if (it.row() != j) add(j, it.value() * u(it.row()));
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

void measure_residuals(const SaddlePointSystem& s, Solution& solution) {
  const Product Ku = multiply(s.K, solution.u);
  const VecX pressure = s.B.transpose() * solution.lambda;
  const double forces = largest({largest_entry(s.f), largest_entry(Ku.sum), largest_entry(pressure)});
  solution.force_residual = fraction(0, forces);
  std::vector<char> held = s.constraints.fixed;
  for (const int unknown : held_unknowns(s.grounded, solution)) held[unknown] = 1;
  for (Eigen::Index i = 0; i < pressure.size(); ++i)
    if (!held[i])
      solution.force_residual = largest(solution.force_residual, fraction(std::abs(s.f(i) - Ku.sum(i) - pressure(i)),
                                                                          largest(forces, rigid_part * Ku.size(i))));
  VecX open = (s.g - s.B * solution.u).cwiseQuotient(s.row_scale);
  for (Eigen::Index a = 0; a < open.size(); ++a)
    if (!solution.active[a]) open(a) = 0;
  solution.constraint_residual = fraction(largest_entry(open), largest_entry(solution.u));
}

}  // namespace mortise
