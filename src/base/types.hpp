// Eigen aliases used in every room.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <vector>

namespace mortise {

using Vec2 = Eigen::Vector2d;
using Vec4 = Eigen::Vector4d;
using Mat4 = Eigen::Matrix4d;
using VecX = Eigen::VectorXd;
using MatX = Eigen::MatrixXd;

/// n x 2, a row a point: coordinates or displacements, in the scene's length unit.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// n x 4, a row a place: stresses (11, 22, 33, 12), tension positive.
using Stresses = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// Eigen 3.4's own sparse matrices are copied where they should be moved.
template <int Order>
class MovableSparse : public Eigen::SparseMatrix<double, Order, int> {
 public:
  using Base = Eigen::SparseMatrix<double, Order, int>;
  using Base::Base;
  using Base::operator=;
  MovableSparse() = default;
  MovableSparse(const MovableSparse&) = default;
  MovableSparse(MovableSparse&& other) noexcept { this->swap(other); }
  MovableSparse& operator=(const MovableSparse&) = default;
  MovableSparse& operator=(MovableSparse&& other) noexcept {
    this->swap(other);
    return *this;
  }
};

/// Compressed columns, int indices. Symmetric matrices store their lower triangle only.
using SparseMatrix = MovableSparse<Eigen::ColMajor>;

/// Compressed rows: few of them with many columns, at no cost for the columns that are empty.
using SparseRows = MovableSparse<Eigen::RowMajor>;

/// Entries of a sparse matrix (row, column, value), in any order; those of one place add up.
using Triplets = std::vector<Eigen::Triplet<double>>;

template <typename Matrix = SparseMatrix>
Matrix filled(Eigen::Index rows, Eigen::Index columns, const Triplets& entries) {
  Matrix A(rows, columns);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

/// Calls visit(row, column, value) for each entry of a sparse matrix, int row and column.
template <typename Matrix, typename Visit>
void for_each_entry(const Matrix& A, Visit visit) {
  for (Eigen::Index k = 0; k < A.outerSize(); ++k)
    for (typename Matrix::InnerIterator it(A, k); it; ++it) visit(int(it.row()), int(it.col()), it.value());
}

/// Largest absolute value; 0 of an empty vector, NaN where there is one.
inline double largest_entry(const VecX& v) { return v.size() > 0 ? v.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() : 0; }

/// (a, b).
inline VecX stacked(const VecX& a, const VecX& b) {
  VecX both(a.size() + b.size());
  both << a, b;
  return both;
}

/// The larger one; NaN where either is. std::max keeps whichever came first.
inline double largest(double a, double b) { return std::isnan(a) || a > b ? a : b; }

/// The largest of one or more; NaN where there is one.
inline double largest(std::initializer_list<double> values) {
  double found = *values.begin();
  for (const double value : values) found = largest(found, value);
  return found;
}

/// value / size; 0 of 0 over 0. NaN where either is not finite: finite over infinite would pass for small.
inline double fraction(double value, double size) {
  if (!std::isfinite(value) || !std::isfinite(size)) return std::numeric_limits<double>::quiet_NaN();
  return value == 0 ? 0 : value / size;
}

}  // namespace mortise
