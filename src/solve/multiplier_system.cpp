#include "solve/multiplier_system.hpp"

#include <cmath>

#include "base/columns.hpp"
#include "base/dense.hpp"
#include "solve/contact_rows.hpp"

namespace mortise {
namespace {

// Below this part of what one row alone could hold with, a motion is a rigid mode. It opens the rows by less than the
// root of this part of its size.
constexpr double rigid_limit = 1e-10;
constexpr double work_round_off = 1e-12;

}  // namespace

MultiplierSystem::MultiplierSystem(const MatX& compliance, Eigen::Index springs, std::vector<int> active)
    : m_(compliance.rows() - springs), springs_(springs), active_(std::move(active)) {
  const Eigen::Index count = active_.size();
  MatX C(count, count);
  H_.resize(count, springs_);
  for (Eigen::Index j = 0; j < count; ++j) {
    const int column = active_[j];
    for (Eigen::Index i = j; i < count; ++i) C(i, j) = compliance(active_[i], column);
    H_.row(j) = compliance.col(column).tail(springs_).transpose();
  }
  diagonal_ = C.diagonal();
  cholesky_ = DenseCholesky(std::move(C));
  if (springs_ == 0 || m_ == 0 || dependent_row() >= 0) return;

  MatX T = MatX::Zero(springs_, springs_);
  if (count > 0) {
    reduced_ = cholesky_.solve(H_);
    T = H_.transpose() * reduced_;
  }
  const double one_row =
      compliance.bottomLeftCorner(springs_, m_).cwiseAbs2().maxCoeff() / compliance.diagonal().head(m_).maxCoeff();
  const SymmetricEigen eigen = symmetric_eigen(T);
  Eigen::Index free = 0;
  while (free < springs_ && !(eigen.values(free) > rigid_limit * one_row)) ++free;
  rigid_modes_ = told_apart(eigen.vectors.leftCols(free));
  held_ = eigen.vectors.rightCols(springs_ - free);
  stiffness_ = eigen.values.tail(springs_ - free);
}

int MultiplierSystem::dependent_row() const {
  const Eigen::Index known = cholesky_.failed() < 0 ? diagonal_.size() : cholesky_.failed();
  for (Eigen::Index i = 0; i < known; ++i)  // a pivot that is round-off of its own size
    if (!(std::pow(cholesky_.pivot(i), 2) > 1e-13 * diagonal_(i))) return active_[i];
  return cholesky_.failed() < 0 ? -1 : active_[known];
}

VecX MultiplierSystem::on_active(const VecX& rhs) const {
  VecX r(active_.size());
  for (std::size_t i = 0; i < active_.size(); ++i) r(i) = rhs(active_[i]);
  return cholesky_.solve(r);
}

VecX MultiplierSystem::solve(const VecX& rhs) const {
  VecX x = VecX::Zero(m_ + springs_), lambda = on_active(rhs);
  if (springs_ > 0 && m_ > 0) {
    const VecX along = held_.transpose() * unbalanced(rhs, lambda);
    const VecX motion = held_ * along.cwiseQuotient(stiffness_);  // -mu
    x.tail(springs_) = -motion;
    if (!active_.empty()) lambda += reduced_ * motion;
  }
  for (std::size_t i = 0; i < active_.size(); ++i) x(active_[i]) = lambda(i);
  return x;
}

VecX MultiplierSystem::driven_mode(const VecX& rhs, const VecX& x, const VecX& lambda) const {
  VecX driven = VecX::Zero(springs_);
  if (rigid_modes_.cols() == 0) return driven;
  // Of the rows in balance with what they hold: springs make on_active(rhs) far larger, and its round-off with it.
  const VecX work = unbalanced(rhs, x(active_)), pressed = lambda(active_).cwiseAbs(),
             terms = rhs.tail(springs_).cwiseAbs() + H_.cwiseAbs().transpose() * pressed;
  const VecX most = H_.cwiseAbs().rowwise().maxCoeff();  // in any motion, of each row
  const MatX sees = (H_.cwiseAbs().array() > (work_round_off * most).replicate(1, springs_).array()).cast<double>();
  const VecX noise = normal_noise * sees.transpose() * most.cwiseProduct(pressed);
  const double round_off =
      work_round_off * largest_entry(terms);  // of bodies at which a mode is zero but for round-off
  for (const auto& motion : rigid_modes_.colwise())
    if (std::abs(motion.dot(work)) > std::max({std::sqrt(rigid_limit) * motion.cwiseAbs().dot(terms),
                                               motion.cwiseAbs().dot(noise), round_off * largest_entry(motion)}))
      driven += motion.dot(work) * motion;
  return driven;
}

}  // namespace mortise
