// The rows of a complementarity problem whose compliance is dense.
#pragma once

#include <Eigen/Cholesky>

#include "solve/complementarity_problem.hpp"
#include "solve/contact_rows.hpp"
#include "solve/multiplier_system.hpp"

namespace mortise {

class DenseRows : public ContactRows {
 public:
  /// Keeps references to both. `rhs`: (r, h), m + s.
  DenseRows(const ComplementarityProblem& problem, const VecX& rhs);

  Answer solve(const std::vector<char>& closed, const VecX& at) override;
  const VecX& scale() const override { return p_.scale; }
  const std::vector<char>& unilateral() const override { return p_.unilateral; }
  Eigen::Index motions() const override { return springs(); }
  VecX diagonal() const override { return p_.compliance.diagonal().head(rows()); }
  VecX stiffness() const override { return Ht().cwiseAbs2() * diagonal().cwiseInverse(); }
  MatX openings() const override { return Ht().transpose(); }
  VecX gaps(const Forces& forces) const override;
  VecX unbalanced(const VecX& lambda) const override;
  bool soften(const VecX& compliance) override;
  Forces solve_softened(const VecX& gap, const VecX& work) override;
  MatX free_motions() const override { return system_->rigid_modes(); }

  /// Of the last closed rows.
  std::optional<MultiplierSystem> take_system() { return std::move(system_); }

 protected:
  const VecX& rhs() const { return rhs_; }

 private:
  Eigen::Index rows() const { return p_.scale.size(); }
  Eigen::Index springs() const { return rhs_.size() - rows(); }
  Eigen::Block<const MatX> Ht() const { return p_.compliance.bottomLeftCorner(springs(), rows()); }
  VecX opened(const VecX& motion) const { return Ht().transpose() * motion; }
  VecX unknown(const VecX& lambda) const { return p_.known.size() > 0 ? VecX(lambda - p_.known) : lambda; }

  const ComplementarityProblem& p_;
  const VecX& rhs_;
  double negligible_stress_ = 0;  // alone opens no row by more than round-off
  std::optional<MultiplierSystem> system_;
  // (lambda, mu) where soft rows press on motions alone.
  VecX uncoupled_solution(const VecX& gap, const VecX& work) const;

  VecX row_sums_;  // of |C|
  // Of rows that give way: by how much; those that press on others; their L L^T = C + compliance and L^-1 H; 1 /
  // compliance of the soft ones, 0 of others; what all do against motions.
  VecX compliance_;
  std::vector<int> coupled_;
  DenseCholesky softened_;
  MatX reduced_;
  VecX soft_;
  Eigen::LDLT<MatX> motions_;
};

}  // namespace mortise
