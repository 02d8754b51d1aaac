#include "solve/inf_sup.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace mortise {

InfSup inf_sup(const SaddlePointSystem& s, const SparseMatrix& norm, const std::vector<char>& active) {
  const Eigen::Index m = s.B.rows(), springs = s.grounded.size();
  std::vector<int> rows;
  for (int a = 0; a < int(m); ++a)
    if (active[a]) rows.push_back(a);
  InfSup result;
  if (rows.empty()) return result;

  BorderedSystem reduced = bordered_system(s);
  BorderedCholesky factor(std::move(reduced.matrix), reduced.blocks);
  const MatX all = factor.take_border_compliance().selfadjointView<Eigen::Lower>();
  const VecX scale = s.row_scale(rows);
  MatX C = all(rows, rows), S = MatX(norm)(rows, rows);
  S = s.stiffness_scale * scale.cwiseInverse().asDiagonal() * S * scale.cwiseInverse().asDiagonal();
  // Multipliers in balance: the complement of H's columns, which stand in the border's last columns.
  MatX Z = MatX::Identity(C.rows(), C.rows());
  if (springs > 0) {
    std::vector<int> motions;
    for (Eigen::Index k = 0; k < springs; ++k) motions.push_back(int(m + k));
    const Eigen::ColPivHouseholderQR<MatX> qr(all(rows, motions));
    Z = (qr.householderQ() * Z).rightCols(C.rows() - qr.rank());
    if (Z.cols() == 0) return result;
  }
  C = Z.transpose() * C * Z;
  S = Z.transpose() * S * Z;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatX> eigen(C, S);
  result.beta = std::sqrt(largest(0, eigen.eigenvalues()(0)));
  const VecX q = (Z * eigen.eigenvectors().col(0)).cwiseQuotient(scale);
  Eigen::Index at = 0;
  q.cwiseAbs().maxCoeff(&at);
  result.mode = VecX::Zero(m);
  result.mode(rows) = q / q(at);
  return result;
}

}  // namespace mortise
