#include "solve/layered_system.hpp"

namespace mortise {
namespace {

constexpr double least_slope = 1e-9;  // of a layer's largest: open contact may have none

void append(const SparseMatrix& A, Eigen::Index row, Eigen::Index column, Triplets& entries) {
  for_each_entry(A, [&](int i, int j, double value) { entries.emplace_back(int(row) + i, int(column) + j, value); });
}

}  // namespace

VecX layer_forces(const SurfaceLayers& layers, const VecX& d) {
  VecX forces = layers.weight;
  int i = 0;
  for (const auto& [law, end] : layers.laws)
    for (; i < end; ++i) forces(i) *= law.pressure(d(i));
  return forces;
}

VecX layer_stiffness(const SurfaceLayers& layers, const VecX& d) {
  VecX slopes(d.size());
  int first = 0;
  for (const auto& [law, end] : layers.laws) {
    auto of_layer = slopes.segment(first, end - first);
    for (int i = 0; i < of_layer.size(); ++i) of_layer(i) = law.slope(d(first + i));
    if (!law.is_linear()) of_layer = of_layer.cwiseMax(least_slope * of_layer.maxCoeff()).eval();
    first = end;
  }
  return layers.weight.cwiseProduct(slopes);
}

SaddlePointSystem layered_system(const SaddlePointSystem& s, const VecX& stiffness) {
  const SurfaceLayers& layers = s.layers;
  const Eigen::Index n = s.K.cols(), count = layers.B.cols(), all = n + count + count % 2;  // unknowns come in pairs
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
  // Zeros, so that what looks for the parts of the matrix finds a layer in one with the body that it lies on.
  for (int d = 0; d < int(count); ++d) {
    K.emplace_back(int(n) + d, int(n) + d, stiffness(d));
    K.emplace_back(int(n) + d, layers.beside[d], 0.0);
  }
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

MatX layer_openings(const SurfaceLayers& layers, const VecX& d, const MatX& lambda) {
  if (layers.laws.empty()) return MatX::Zero(lambda.rows(), lambda.cols());
  return -(layers.B * layer_stiffness(layers, d).cwiseInverse().asDiagonal() * (layers.B.transpose() * lambda));
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
