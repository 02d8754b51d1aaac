#include "base/columns.hpp"

namespace mortise {

MatX told_apart(MatX columns) {
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    Eigen::Index row = 0, column = 0;
    columns.rightCols(columns.cols() - k).cwiseAbs().maxCoeff(&row, &column);
    columns.col(k).swap(columns.col(k + column));
    columns.col(k) /= columns(row, k);
    for (Eigen::Index other = 0; other < columns.cols(); ++other)
      if (other != k) columns.col(other) -= columns(row, other) * VecX(columns.col(k));
  }
  return columns;
}

}  // namespace mortise
