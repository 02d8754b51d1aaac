#include "preprint_solvers/tau_limit.hpp"

#include <limits>

#include "base/dense.hpp"

namespace mortise {
namespace {

constexpr int conjugate_steps = 12, lanczos_steps = 30;

// B Q^-1 B^T y - B (2 Q - K)^-1 B^T y / 2.
VecX limit_operator(const SweepSystem& s, double omega, const VecX& y) {
  const Eigen::Index n = s.n(), m = s.m();
  VecX r = s.B.transpose() * y, z = r, x = VecX::Zero(n), Qp = r, Kp(n + m), p = VecX::Zero(n + m);
  solve_Q(s, omega, z);
  const VecX first = s.B * z;
  p.head(n) = z;
  double rho = r.dot(z);
  for (int k = 0; k < conjugate_steps && rho > 0; ++k) {
    multiply(s, p, Kp);
    const VecX Ap = 2 * Qp - Kp.head(n);
    const double alpha = rho / p.head(n).dot(Ap);
    x += alpha * p.head(n);
    r -= alpha * Ap;
    z = r;
    solve_Q(s, omega, z);
    const double next = r.dot(z), beta = next / rho;
    rho = next;
    p.head(n) = z + beta * p.head(n);
    Qp = r + beta * Qp;
  }
  return first - s.B * x / 2;
}

}  // namespace

double tau_limit(const SweepSystem& s, double omega) {
  const Eigen::Index m = s.m();
  if (m == 0) return std::numeric_limits<double>::infinity();
  // S-orthonormal v_k, and S v_k; the start is no eigenvector of a symmetric problem.
  VecX v(m);
  for (Eigen::Index a = 0; a < m; ++a) v(a) = 1 + 0.3 * double((7 * a) % 11) * (a % 2 == 0 ? 1 : -1);
  std::vector<VecX> basis, images;
  MatX T = MatX::Zero(lanczos_steps, lanczos_steps);
  int k = 0;
  const SparseMatrix S = s.B * s.D.cwiseInverse().asDiagonal() * s.B.transpose();
  VecX Sv = S * v;
  for (; k < std::min<Eigen::Index>(m, lanczos_steps); ++k) {
    const double size = std::sqrt(v.dot(Sv));
    if (k > 0 && !(size > 1e-10 * std::abs(T(k - 1, k - 1)))) break;
    if (k > 0) T(k, k - 1) = size;
    basis.push_back(v / size);
    images.push_back(Sv / size);
    v = limit_operator(s, omega, basis.back());
    solve_S(s, v);
    T(k, k) = images.back().dot(v);
    for (int twice = 0; twice < 2; ++twice)
      for (std::size_t i = 0; i < basis.size(); ++i) v -= images[i].dot(v) * basis[i];
    Sv = S * v;
  }
  return 1 / symmetric_eigen(T.topLeftCorner(k, k)).values(k - 1);
}

}  // namespace mortise
