#include "base/dense.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <stdexcept>
#include <string>

extern "C" void dgeev_(const char* left, const char* right, const int* n, double* a, const int* lda, double* re,
                       double* im, double* vl, const int* ldvl, double* vr, const int* ldvr, double* work,
                       const int* lwork, int* info);

namespace mortise {

SymmetricEigen symmetric_eigen(const MatX& A) {
  const Eigen::SelfAdjointEigenSolver<MatX> eigen(A);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

VecX eigenvalue_moduli(MatX A) {
  const int n = int(A.rows()), one = 1, size = 64 * n + 1;
  VecX re(n), im(n), work(size);
  int info = 0;
  dgeev_("N", "N", &n, A.data(), &n, re.data(), im.data(), nullptr, &one, nullptr, &one, work.data(), &size, &info);
  if (info != 0) throw std::runtime_error("dgeev: " + std::to_string(info));
  return (re.array().square() + im.array().square()).sqrt();
}

VecX solve_square(const MatX& A, const VecX& b) { return A.cols() > 0 ? VecX(A.partialPivLu().solve(b)) : b; }

MatX inverse_of(const MatX& A) { return A.partialPivLu().inverse(); }

MatX orthonormal(const MatX& columns) {
  return Eigen::HouseholderQR<MatX>(columns).householderQ() * MatX::Identity(columns.rows(), columns.cols());
}

MatX kernel_of(const MatX& A, double threshold) {
  Eigen::FullPivLU<MatX> factor(A);
  if (threshold > 0) factor.setThreshold(threshold);
  return factor.dimensionOfKernel() > 0 ? MatX(factor.kernel()) : MatX(A.cols(), 0);
}

struct LeastSquares::Factor {
  Eigen::ColPivHouseholderQR<MatX> qr;
};

LeastSquares::LeastSquares(const MatX& A) : factor_(new Factor{Eigen::ColPivHouseholderQR<MatX>(A)}) {}
LeastSquares::~LeastSquares() = default;
VecX LeastSquares::solve(const VecX& b) const { return factor_->qr.solve(b); }

}  // namespace mortise
