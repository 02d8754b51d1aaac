#include "solve/multipoint_system.hpp"

namespace mortise {

SaddlePointSystem independent_system(const SaddlePointSystem& s) {
  const SparseMatrix T = s.constraints.multipoint->T, K = s.K.selfadjointView<Eigen::Lower>();
  const SparseMatrix KT = K * T, whole = T.transpose() * KT;
  SaddlePointSystem independent{.K = whole.triangularView<Eigen::Lower>(),
                                .f = T.transpose() * s.f,
                                .constraints = s.constraints,
                                .stiffness_scale = s.stiffness_scale,
                                .grounded = s.grounded,
                                .B = s.B * T,
                                .g = s.g,
                                .row_scale = s.row_scale,
                                .unilateral = s.unilateral,
                                .start = s.start,
                                .layers = s.layers};
  independent.constraints.multipoint.reset();
  return independent;
}

}  // namespace mortise
