#include "ddm/body_group.hpp"

namespace mortise {

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

  const VecX force = s.f - s.K.selfadjointView<Eigen::Lower>() * s.constraints.value;
  load_ = factor_->forward(VecX(force(free_)) / s.stiffness_scale);
  const VecX all = factor_->at_border(load_);
  response = all.head(m);
  work = all.tail(motions);
}

void BodyGroup::add_displacements(const VecX& lambda, const VecX& mu, VecX& u) const {
  VecX border(lambda.size() + mu.size());
  border << lambda, mu;
  u(free_) += factor_->backward(load_, border);
}

void BodyGroup::refine(const VecX& unbalanced, VecX& u) const {
  u(free_) += factor_->backward(factor_->forward(unbalanced(free_)), VecX::Zero(C.rows() + motions));
}

}  // namespace mortise
