#include "base/dense.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <stdexcept>
#include <string>

extern "C" {
void dpotrf_(const char* triangle, const int* n, double* a, const int* lda, int* info);
void dtrtrs_(const char* triangle, const char* transposed, const char* unit, const int* n, const int* columns,
             const double* a, const int* lda, double* b, const int* ldb, int* info);
void dgeev_(const char* left, const char* right, const int* n, double* a, const int* lda, double* re, double* im,
            double* vl, const int* ldvl, double* vr, const int* ldvr, double* work, const int* lwork, int* info);
}

namespace mortise {

SymmetricEigen symmetric_eigen(const MatX& A) {
  const Eigen::SelfAdjointEigenSolver<MatX> eigen(A);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Eigen::VectorXcd eigenvalues(MatX A) {
  const int n = int(A.rows()), one = 1, size = 64 * n + 1;
  VecX re(n), im(n), work(size);
  int info = 0;
  dgeev_("N", "N", &n, A.data(), &n, re.data(), im.data(), nullptr, &one, nullptr, &one, work.data(), &size, &info);
  if (info != 0) throw std::runtime_error("dgeev: " + std::to_string(info));
  Eigen::VectorXcd values(n);
  values.real() = re;
  values.imag() = im;
  return values;
}

MatX inverse_of(const MatX& A) { return A.partialPivLu().inverse(); }

MatX orthonormal(const MatX& columns) {
  return Eigen::HouseholderQR<MatX>(columns).householderQ() * MatX::Identity(columns.rows(), columns.cols());
}

MatX kernel_of(const MatX& A, double threshold) {
  Eigen::FullPivLU<MatX> factor(A);
  if (threshold > 0) factor.setThreshold(threshold);
  return factor.dimensionOfKernel() > 0 ? MatX(factor.kernel()) : MatX(A.cols(), 0);
}

DenseCholesky::DenseCholesky(MatX A) : L_(std::move(A)) {
  const int n = int(L_.rows());
  int info = 0;
  if (n > 0) dpotrf_("L", &n, L_.data(), &n, &info);
  failed_ = info - 1;
}

// Not BLAS's dtrsm, whose kernels for small matrices lose digits on some processors (OpenBLAS 0.3.21, SkylakeX).
MatX DenseCholesky::solve_triangle(const char* transposed, MatX b) const {
  const int n = int(b.rows()), columns = int(b.cols());
  int info = 0;
  if (b.size() > 0) dtrtrs_("L", transposed, "N", &n, &columns, L_.data(), &n, b.data(), &n, &info);
  return b;
}

MatX DenseCholesky::lower(MatX b) const { return solve_triangle("N", std::move(b)); }
MatX DenseCholesky::upper(MatX b) const { return solve_triangle("T", std::move(b)); }

MatX DenseCholesky::solve(MatX b) const { return upper(lower(std::move(b))); }

struct LeastSquares::Factor {
  Eigen::ColPivHouseholderQR<MatX> qr;
};

LeastSquares::LeastSquares(const MatX& A) : factor_(new Factor{Eigen::ColPivHouseholderQR<MatX>(A)}) {}
LeastSquares::~LeastSquares() = default;
VecX LeastSquares::solve(const VecX& b) const { return factor_->qr.solve(b); }

}  // namespace mortise
