#include "base/dense.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace mortise {

SymmetricEigen symmetric_eigen(const MatX& A) {
  const Eigen::SelfAdjointEigenSolver<MatX> eigen(A);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

VecX solve_square(const MatX& A, const VecX& b) { return A.cols() > 0 ? VecX(A.partialPivLu().solve(b)) : b; }

}  // namespace mortise
