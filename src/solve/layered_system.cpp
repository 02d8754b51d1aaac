#include "solve/layered_system.hpp"

#include <Eigen/SparseCholesky>

namespace mortise {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

void append(const SparseMatrix& A, Eigen::Index row, Eigen::Index column, Triplets& entries) {
  for (int j = 0; j < A.cols(); ++j)
    for (SparseMatrix::InnerIterator it(A, j); it; ++it)
      entries.emplace_back(int(row + it.row()), int(column + j), it.value());
}

SparseMatrix filled(Eigen::Index rows, Eigen::Index columns, const Triplets& entries) {
  SparseMatrix A(rows, columns);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

}  // namespace

SaddlePointSystem layered_system(const SaddlePointSystem& s) {
  const SurfaceLayers& layers = s.layers;
  const Eigen::Index n = s.K.cols(), count = layers.K.cols(), all = n + count + count % 2;  // unknowns come in pairs
  SaddlePointSystem layered{.K = {},
                            .f = VecX::Zero(all),
                            .constraints = s.constraints,
                            .stiffness_scale = s.stiffness_scale,
                            .grounded = s.grounded,
                            .B = {},
                            .g = {},
                            .row_scale = s.row_scale,
                            .unilateral = s.unilateral,
                            .start = {}};
  Triplets K, B;
  append(s.K, 0, 0, K);
  append(layers.K, n, n, K);
  // Zeros, so that what looks for the parts of the matrix finds a layer in one with the body that it lies on.
  for (int d = 0; d < int(count); ++d) K.emplace_back(int(n) + d, layers.beside[d], 0.0);
  append(s.B, 0, 0, B);
  append(layers.B, 0, n, B);
  layered.K = filled(all, all, K);
  layered.B = filled(s.B.rows(), all, B);
  layered.constraints.fixed.resize(std::size_t(n + count), 0);
  layered.constraints.fixed.resize(std::size_t(all), 1);
  layered.constraints.value = VecX::Zero(all);
  take_loads(s, layered);
  return layered;
}

MatX layer_openings(const SurfaceLayers& layers, const MatX& lambda) {
  if (layers.K.cols() == 0) return MatX::Zero(lambda.rows(), lambda.cols());
  const Eigen::SimplicialLDLT<SparseMatrix> factor(layers.K);
  return -(layers.B * factor.solve(layers.B.transpose() * lambda));
}

SparseRows without_layers(Eigen::Index unknowns, Eigen::Index all) {
  SparseRows T(unknowns, all);
  for (int i = 0; i < int(unknowns); ++i) {
    T.startVec(i);
    T.insertBack(i, i) = 1;
  }
  T.finalize();
  return T;
}

void take_loads(const SaddlePointSystem& s, SaddlePointSystem& layered) {
  layered.f.head(s.f.size()) = s.f;
  layered.g = s.g;
  layered.constraints.value.head(s.f.size()) = s.constraints.value;
  layered.start = s.start;
}

}  // namespace mortise
