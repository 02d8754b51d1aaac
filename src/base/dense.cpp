#include "base/dense.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace mortise {

SymmetricEigen symmetric_eigen(const MatX& A) {
  const Eigen::SelfAdjointEigenSolver<MatX> eigen(A);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

VecX solve_square(const MatX& A, const VecX& b) { return A.cols() > 0 ? VecX(A.partialPivLu().solve(b)) : b; }

MatX inverse_of(const MatX& A) { return A.partialPivLu().inverse(); }

MatX orthonormal(const MatX& columns) {
  return Eigen::HouseholderQR<MatX>(columns).householderQ() * MatX::Identity(columns.rows(), columns.cols());
}

}  // namespace mortise
