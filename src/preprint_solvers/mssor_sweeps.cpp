#include "preprint_solvers/mssor_sweeps.hpp"

#include <Eigen/SparseCholesky>

#include "preprint_solvers/band_order.hpp"

namespace mortise {
namespace {

// The lower triangle of K on the free unknowns, which come in the order of `unknown`, over the stiffness scale.
SparseMatrix free_stiffness(const SaddlePointSystem& s, const std::vector<int>& unknown) {
  std::vector<int> place(s.K.cols(), -1);
  for (std::size_t k = 0; k < unknown.size(); ++k) place[unknown[k]] = int(k);
  Triplets entries;
  entries.reserve(s.K.nonZeros());
  for_each_entry(s.K, [&](int i, int j, double value) {
    const int a = place[i], b = place[j];
    if (a >= 0 && b >= 0) entries.emplace_back(std::max(a, b), std::min(a, b), value / s.stiffness_scale);
  });
  return filled(unknown.size(), unknown.size(), entries);
}

// D and the rows of L.
void split(const SparseMatrix& lower, SweepSystem& r) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> rows = lower;
  r.D = VecX::Zero(rows.rows());
  r.start.push_back(0);
  for (int i = 0; i < rows.rows(); ++i) {
    for (decltype(rows)::InnerIterator it(rows, i); it; ++it) {
      if (it.col() == i) {
        r.D(i) = it.value();
        continue;
      }
      r.column.push_back(int(it.col()));
      r.value.push_back(it.value());
    }
    r.start.push_back(int(r.column.size()));
    if (!(r.D(i) > 0) && r.not_positive < 0) r.not_positive = r.unknown[i];
  }
  r.D_inverse = r.D.cwiseInverse();
}

void set_rows(const SaddlePointSystem& s, SweepSystem& r) {
  Triplets entries;
  for (std::size_t k = 0; k < r.unknown.size(); ++k)
    for (SparseMatrix::InnerIterator it(s.B, r.unknown[k]); it; ++it)
      entries.emplace_back(int(it.row()), int(k), it.value() / s.row_scale(it.row()));
  r.B = filled<decltype(r.B)>(s.B.rows(), r.n(), entries);
}

// Prescribed displacements to the right-hand side.
void set_loads(const SaddlePointSystem& s, SweepSystem& r) {
  const VecX load = (s.f - s.K.selfadjointView<Eigen::Lower>() * s.constraints.value) / s.stiffness_scale;
  r.rhs.resize(r.n() + r.m());
  for (Eigen::Index k = 0; k < r.n(); ++k) r.rhs(k) = load(r.unknown[k]);
  r.rhs.tail(r.m()) = (s.g - s.B * s.constraints.value).cwiseQuotient(s.row_scale);
  r.largest_value = largest_entry(s.constraints.value);
}

// Row i of L times x. Four sums: one would have every addition wait for the one before.
double row_of_L(const SweepSystem& s, Eigen::Index i, const double* x) {
  const int end = s.start[i + 1];
  int k = s.start[i];
  const double* value = s.value.data();
  const int* column = s.column.data();
  double a = 0, b = 0, c = 0, d = 0;
  for (; k + 3 < end; k += 4) {
    a += value[k] * x[column[k]];
    b += value[k + 1] * x[column[k + 1]];
    c += value[k + 2] * x[column[k + 2]];
    d += value[k + 3] * x[column[k + 3]];
  }
  for (; k < end; ++k) a += value[k] * x[column[k]];
  return (a + b) + (c + d);
}

// y += column i of L^T times factor.
void add_row_of_L(const SweepSystem& s, Eigen::Index i, double factor, double* y) {
  const double* value = s.value.data();
  const int* column = s.column.data();
  for (int k = s.start[i]; k < s.start[i + 1]; ++k) y[column[k]] += value[k] * factor;
}

constexpr double pivot_round_off = 1e-12;

void factorise_S(SweepSystem& r) {
  const SparseMatrix S = r.B * r.D.cwiseInverse().asDiagonal() * r.B.transpose();
  const Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> factor(S);
  r.S_lower = factor.matrixL().nestedExpression();
  r.S_pivots = factor.vectorD();
  for (Eigen::Index a = 0; a < r.m() && r.dependent_row < 0; ++a)
    if (!(r.S_pivots(a) > pivot_round_off * S.coeff(a, a))) r.dependent_row = int(a);
}

}  // namespace

SweepSystem sweep_system(const SaddlePointSystem& s) {
  SweepSystem r;
  std::vector<int> free;
  for (int i = 0; i < int(s.constraints.fixed.size()); ++i)
    if (!s.constraints.fixed[i]) free.push_back(i);
  for (const int k : band_order(free_stiffness(s, free))) r.unknown.push_back(free[k]);
  split(free_stiffness(s, r.unknown), r);
  set_rows(s, r);
  set_loads(s, r);
  if (r.not_positive < 0 && r.m() > 0) factorise_S(r);
  return r;
}

void multiply(const SweepSystem& s, const VecX& x, VecX& y) {
  const Eigen::Index n = s.n();
  for (Eigen::Index i = 0; i < n; ++i) {
    add_row_of_L(s, i, x(i), y.data());  // to rows before i, which have their sums
    y(i) = s.D(i) * x(i) + row_of_L(s, i, x.data());
  }
  y.head(n).noalias() += s.B.transpose() * x.tail(s.m());
  y.tail(s.m()).noalias() = s.B * x.head(n);
}

void solve_Q(const SweepSystem& s, double omega, VecX& x) {
  const Eigen::Index n = s.n();
  for (Eigen::Index i = 0; i < n; ++i) {  // (D + omega L)^-1
    x(i) = (x(i) - omega * row_of_L(s, i, x.data())) * s.D_inverse(i);
  }
  x.array() *= omega * (2 - omega) * s.D.array();
  for (Eigen::Index i = n; i-- > 0;) {  // (D + omega L^T)^-1: row i of L is column i of L^T
    x(i) *= s.D_inverse(i);
    add_row_of_L(s, i, -omega * x(i), x.data());
  }
}

void solve_S(const SweepSystem& s, VecX& x) {
  if (s.m() == 0) return;
  s.S_lower.triangularView<Eigen::UnitLower>().solveInPlace(x);
  x.array() /= s.S_pivots.array();
  s.S_lower.transpose().triangularView<Eigen::UnitUpper>().solveInPlace(x);
}

void SweepPreconditioner::solve(const VecX& r, VecX& z) {
  const Eigen::Index n = system.n(), m = system.m();
  first = r.head(n);
  solve_Q(system, omega, first);
  row = -r.tail(m);
  row.noalias() += system.B * first;
  solve_S(system, row);
  row *= tau;
  second.noalias() = system.B.transpose() * row;
  solve_Q(system, omega, second);
  z.head(n) = first - second;
  z.tail(m) = row;
}

void SweepPreconditioner::solve_blocks(const VecX& r, VecX& z) {
  const Eigen::Index n = system.n(), m = system.m();
  first = r.head(n);
  solve_Q(system, omega, first);
  row = r.tail(m);
  solve_S(system, row);
  z.head(n) = first;
  z.tail(m) = tau * row;
}

}  // namespace mortise
