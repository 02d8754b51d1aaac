#include "solve/saddle_point.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>

#include "base/stopwatch.hpp"

namespace mortise {
namespace {

// The system on the free unknowns, dimensionless, as BorderedCholesky wants it: the border is the rows of B and one
// unit row for each spring.
struct Reduced {
  SparseMatrix matrix;
  std::vector<int> free;    // reduced -> full
  std::vector<int> blocks;  // reduced -> node, densely numbered
};

Reduced reduce(const SaddlePointSystem& s) {
  Reduced r;
  const int n = int(s.K.cols());
  std::vector<int> to_reduced(std::size_t(n), -1);
  int last_node = -1, block = -1;
  for (int i = 0; i < n; ++i) {
    if (s.fixed[std::size_t(i)]) continue;
    to_reduced[std::size_t(i)] = int(r.free.size());
    if (i / 2 != last_node) ++block;
    last_node = i / 2;
    r.free.push_back(i);
    r.blocks.push_back(block);
  }
  std::vector<int> spring(std::size_t(n), -1);
  for (std::size_t k = 0; k < s.grounded.size(); ++k) spring[std::size_t(s.grounded[k])] = int(k);

  const int count = int(r.free.size()), m = int(s.B.rows()), border = m + int(s.grounded.size());
  // The columns below the diagonal, read as rows above it: an entry (i, j) goes to column i, and comes in order.
  const auto for_each_entry = [&](auto visit) {
    for (int j = 0; j < count; ++j) {
      const int column = r.free[std::size_t(j)], held = spring[std::size_t(column)];
      for (SparseMatrix::InnerIterator it(s.K, column); it; ++it) {
        const int i = to_reduced[std::size_t(it.row())];
        if (i >= 0) visit(i, j, it.value() / s.stiffness_scale + (i == j && held >= 0 ? 1 : 0));
      }
      for (SparseMatrix::InnerIterator it(s.B, column); it; ++it)
        visit(count + int(it.row()), j, it.value() / s.row_scale(it.row()));
      if (held >= 0) visit(count + m + held, j, 1.0);
    }
    for (int i = count; i < count + border; ++i) visit(i, i, border_diagonal);
  };
  r.matrix.resize(count + border, count + border);
  int* start = r.matrix.outerIndexPtr();
  for_each_entry([&](int i, int, double) { ++start[i + 1]; });
  for (int i = 0; i < count + border; ++i) start[i + 1] += start[i];
  r.matrix.resizeNonZeros(start[count + border]);
  std::vector<int> next(start, start + count + border);
  for_each_entry([&](int i, int j, double value) {
    const int at = next[std::size_t(i)]++;
    r.matrix.innerIndexPtr()[at] = j;
    r.matrix.valuePtr()[at] = value;
  });
  return r;
}

// Solves [C, C_s; C_s^T, S - 1] (lambda, mu) = rhs for the multipliers and the springs' forces mu (theory eq. 18),
// where all blocks but the 1 are in `compliance`. The first m rows are positive definite.
class MultiplierSystem {
 public:
  MultiplierSystem(const MatX& compliance, Eigen::Index m) : m_(m), springs_(compliance.rows() - m) {
    if (m_ == 0) return;  // without rows nothing needs springs
    cholesky_.compute(compliance.topLeftCorner(m, m));
    diagonal_ = compliance.diagonal().head(m);
    if (springs_ == 0) return;
    coupling_ = compliance.bottomLeftCorner(springs_, m).transpose();
    reduced_ = cholesky_.solve(coupling_);
    MatX corner = compliance.bottomRightCorner(springs_, springs_).selfadjointView<Eigen::Lower>();
    corner -= MatX::Identity(springs_, springs_) + coupling_.transpose() * reduced_;
    corner_.compute(corner);
  }

  // A row of B that the rows before it already imply: its pivot is round-off of its own size, or the factorisation
  // stopped there (its row of the factor does not give back the diagonal then).
  int dependent_row() const {
    const MatX& L = cholesky_.matrixLLT();
    for (Eigen::Index i = 0; i < m_; ++i) {
      const double pivot = L(i, i) * L(i, i), size = L.row(i).head(i + 1).squaredNorm();
      if (!(pivot > 1e-13 * diagonal_(i)) || !(std::abs(size - diagonal_(i)) < 1e-8 * diagonal_(i))) return int(i);
    }
    return -1;
  }

  VecX solve(const VecX& rhs) const {
    VecX x = rhs;
    if (m_ == 0) return x;
    x.head(m_) = cholesky_.solve(rhs.head(m_));
    if (springs_ == 0) return x;
    x.tail(springs_) = corner_.solve(rhs.tail(springs_) - coupling_.transpose() * x.head(m_));
    x.head(m_) -= reduced_ * x.tail(springs_);
    return x;
  }

 private:
  Eigen::Index m_, springs_;
  Eigen::LLT<MatX> cholesky_;
  VecX diagonal_;
  MatX coupling_, reduced_;
  Eigen::PartialPivLU<MatX> corner_;
};

double largest_entry(const VecX& v) { return v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0; }

}  // namespace

SaddlePointSolution solve_saddle_point(const SaddlePointSystem& s) {
  SaddlePointSolution solution;
  Stopwatch watch;
  const Eigen::Index m = s.B.rows();
  Reduced reduced = reduce(s);
  BorderedCholesky factor(std::move(reduced.matrix), reduced.blocks);
  const std::vector<int>& free = reduced.free;
  if (factor.failed_at() >= 0) {
    solution.status = SaddlePointSolution::Status::not_positive_definite;
    solution.failed_at = free[std::size_t(std::min<std::size_t>(std::size_t(factor.failed_at()), free.size() - 1))];
    return solution;
  }
  const MultiplierSystem multipliers(factor.border_compliance(), m);
  solution.factor_bytes = factor.factor_bytes();
  solution.factorise_seconds = watch.lap();
  if (multipliers.dependent_row() >= 0) {
    solution.status = SaddlePointSolution::Status::dependent_constraints;
    solution.failed_at = multipliers.dependent_row();
    return solution;
  }

  solution.u = s.value;
  solution.lambda = VecX::Zero(m);
  const auto symmetric = s.K.selfadjointView<Eigen::Lower>();
  VecX Ku = symmetric * solution.u;
  // The first pass solves, as a rule to round-off of the residual itself; a second one refines where it did not.
  for (int pass = 0; pass < 2; ++pass) {
    const VecX Bl = s.B.transpose() * solution.lambda;
    VecX force(Eigen::Index(free.size()));
    for (std::size_t i = 0; i < free.size(); ++i)
      force(Eigen::Index(i)) = (s.f(free[i]) - Ku(free[i]) - Bl(free[i])) / s.stiffness_scale;
    VecX rhs = factor.forward(force);
    rhs.head(m) -= (s.g - s.B * solution.u).cwiseQuotient(s.row_scale);
    const VecX lambda = multipliers.solve(rhs);
    const VecX u = factor.backward(lambda);
    for (std::size_t i = 0; i < free.size(); ++i) solution.u(free[i]) += u(Eigen::Index(i));
    solution.lambda += s.stiffness_scale * lambda.head(m).cwiseQuotient(s.row_scale);
    Ku = symmetric * solution.u;

    const VecX pressure = s.B.transpose() * solution.lambda;
    double worst = 0;
    for (const int i : free) worst = std::max(worst, std::abs(s.f(i) - Ku(i) - pressure(i)));
    const double size = std::max({largest_entry(s.f), largest_entry(Ku), largest_entry(pressure)});
    solution.force_residual = size > 0 ? worst / size : 0;
    const double largest = largest_entry(solution.u);
    const VecX open = (s.g - s.B * solution.u).cwiseQuotient(s.row_scale);
    solution.constraint_residual = largest > 0 ? largest_entry(open) / largest : 0;
    if (std::max(solution.force_residual, solution.constraint_residual) < 1e-11) break;
  }
  solution.solve_seconds = watch.lap();
  return solution;
}

}  // namespace mortise
