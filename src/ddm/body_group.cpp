#include "ddm/body_group.hpp"

namespace mortise {

VecX load_of(const SaddlePointSystem& s) {
  return (s.f - s.K.selfadjointView<Eigen::Lower>() * s.constraints.value) / s.stiffness_scale;
}

BodyGroup::BodyGroup(const SaddlePointSystem& s, const std::vector<char>& member) {
  std::vector<char> left_out = s.constraints.fixed;
  for (std::size_t i = 0; i < member.size(); ++i) left_out[i] = left_out[i] || !member[i];
  std::vector<int> grounded;
  for (const int i : s.grounded)
    if (member[i]) grounded.push_back(i);

  BorderedSystem system = bordered_system(s, left_out, grounded);
  free_ = std::move(system.free);
  factor_ = std::make_unique<BorderedCholesky>(std::move(system.matrix), system.blocks);
  if (factor_->failed_at() >= 0) {
    failed_at = free_[std::min(factor_->failed_at(), int(free_.size()) - 1)];
    return;
  }
  motions = grounded.size();
  const Eigen::Index m = s.B.rows();
  compliance = factor_->take_border_compliance();
  C = compliance.topLeftCorner(m, m).selfadjointView<Eigen::Lower>();
  H = compliance.bottomLeftCorner(motions, m).transpose();

  load = answer(load_of(s));
}

BodyGroup::Answer BodyGroup::answer(const VecX& force) const {
  Answer to{.y = factor_->forward(force(free_)), .response = {}, .work = {}};
  const VecX all = factor_->at_border(to.y);
  to.response = all.head(all.size() - motions);
  to.work = all.tail(motions);
  return to;
}

MatX BodyGroup::motion_shapes(Eigen::Index unknowns) const {
  const Eigen::Index rows = C.rows();
  MatX border = MatX::Zero(rows + motions, motions), R = MatX::Zero(unknowns, motions);
  border.bottomRows(motions) = -MatX::Identity(motions, motions);
  const MatX shapes = factor_->backward(factor_->forward(VecX::Zero(free_.size())).replicate(1, motions), border);
  for (std::size_t i = 0; i < free_.size(); ++i) R.row(free_[i]) = shapes.row(i);
  return R;
}

void BodyGroup::add_displacements(const Answer& forces, const VecX& lambda, const VecX& mu, VecX& u) const {
  VecX border(lambda.size() + mu.size());
  border << lambda, mu;
  u(free_) += factor_->backward(forces.y, border);
}

}  // namespace mortise
