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

BodyGroup::Answer BodyGroup::answer(const MatX& forces) const {
  Answer to{.y = factor_->forward(forces(free_, Eigen::all)), .response = {}, .work = {}};
  const MatX all = factor_->at_border(to.y);
  to.response = all.topRows(all.rows() - motions);
  to.work = all.bottomRows(motions);
  return to;
}

MatX BodyGroup::motion_shapes(Eigen::Index unknowns) const {
  const Eigen::Index rows = C.rows();
  MatX border = MatX::Zero(rows + motions, motions), R = MatX::Zero(unknowns, motions);
  border.bottomRows(motions) = -MatX::Identity(motions, motions);
  const MatX shapes = factor_->backward(factor_->forward(MatX::Zero(Eigen::Index(free_.size()), motions)), border);
  for (std::size_t i = 0; i < free_.size(); ++i) R.row(free_[i]) = shapes.row(i);
  return R;
}

void BodyGroup::add_displacements(const Answer& forces, const MatX& lambda, const MatX& mu, Eigen::Ref<MatX> u) const {
  MatX border(lambda.rows() + mu.rows(), u.cols());
  border.topRows(lambda.rows()) = lambda;
  border.bottomRows(mu.rows()) = mu;
  u(free_, Eigen::all) += factor_->backward(forces.y, border);
}

}  // namespace mortise
