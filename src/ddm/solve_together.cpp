#include "ddm/solve_together.hpp"

namespace mortise {

MatX solve_together(const Eigen::SimplicialLDLT<SparseMatrix>& factor, const MatX& b) {
  if (b.cols() == 1) return factor.solve(b);
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto& L = factor.matrixL().nestedExpression();  // its diagonal of ones is not stored
  using Column = Eigen::SparseMatrix<double>::InnerIterator;
  Rows x = factor.permutationP() * b;
  for (Eigen::Index j = 0; j < L.cols(); ++j)
    for (Column it(L, j); it; ++it) x.row(it.row()) -= it.value() * x.row(j);
  x.array().colwise() /= factor.vectorD().array();
  for (Eigen::Index j = L.cols() - 1; j >= 0; --j)
    for (Column it(L, j); it; ++it) x.row(j) -= it.value() * x.row(it.row());
  return factor.permutationPinv() * x;
}

}  // namespace mortise
