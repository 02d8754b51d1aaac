// The factor of a contact problem whose closed rows are known: what it answers to other weighted gaps.
#pragma once

#include "solve/multiplier_system.hpp"
#include "solve/saddle_point_system.hpp"
#include "solve/split_cholesky.hpp"

namespace mortise {

/// A column a question.
struct DualAnswers {
  MatX z;   ///< n
  MatX mu;  ///< m, 0 on open rows
};

class ContactFactor {
 public:
  virtual ~ContactFactor() = default;

  /// Columns z, n, of K z + B^T mu = g, no prescribed unknown moved, and B z = w on the closed rows (w a column of
  /// `functionals`, m; mu = 0 on the others): the dual solutions of the functionals g^T u - w^T lambda (Becker &
  /// Rannacher 2001). Rigid modes of the closed rows are zero in them. `loads`: the last of the g, n each; those before
  /// are zero.
  MatX duals(const MatX& functionals, const MatX& loads = {}) const { return answers(functionals, loads).z; }
  /// The same with mu.
  virtual DualAnswers answers(const MatX& functionals, const MatX& loads) const = 0;
  /// mu alone, which may cost half.
  virtual MatX multipliers(const MatX& functionals, const MatX& loads) const { return answers(functionals, loads).mu; }
};

/// The factor of the bodies, and their unknowns that it has.
struct FactoredBodies {
  std::vector<int> free;
  SplitCholesky factor;
};

/// That of DirectSolver: one backward substitution for all duals, and a forward one of each load.
class DirectFactor : public ContactFactor {
 public:
  /// `multipliers`: of the closed rows.
  DirectFactor(const SaddlePointSystem& system, std::shared_ptr<FactoredBodies> bodies, MultiplierSystem multipliers);

  DualAnswers answers(const MatX& functionals, const MatX& loads) const override;
  MatX multipliers(const MatX& functionals, const MatX& loads) const override;

 private:
  // Those of rows and springs, a column a question, and L^-1 of each load (BorderedCholesky).
  struct Border {
    MatX multipliers, y;
  };
  Border border(const MatX& functionals, const MatX& loads) const;
  MatX in_units(const MatX& multipliers) const;

  VecX row_scale_;
  double stiffness_scale_;
  Eigen::Index unknowns_, springs_;
  std::shared_ptr<FactoredBodies> bodies_;  // which learn from what they are asked
  MultiplierSystem multipliers_;
};

/// A factor of the equations of q (multipoint_system.hpp), asked in u = T q.
class MultipointFactor : public ContactFactor {
 public:
  MultipointFactor(const SparseRows& T, std::shared_ptr<const ContactFactor> of_q) : T_(T), of_q_(std::move(of_q)) {}

  DualAnswers answers(const MatX& functionals, const MatX& loads) const override;
  MatX multipliers(const MatX& functionals, const MatX& loads) const override;

 private:
  MatX loads_of_q(const MatX& loads) const { return loads.size() > 0 ? MatX(T_.transpose() * loads) : loads; }

  SparseRows T_;
  std::shared_ptr<const ContactFactor> of_q_;
};

/// Of a system whose stiffness proved positive definite and whose closed rows are independent (a converged Solution),
/// with its layers as they give way from `compression` (l) on.
std::shared_ptr<const ContactFactor> factorise_contact(const SaddlePointSystem& system, const std::vector<char>& closed,
                                                       const VecX& compression = {});

/// One whose answers are exact but for round-off: that of a direct solution whose layers are linear, or one made for
/// it.
std::shared_ptr<const ContactFactor> exact_factor(const SaddlePointSystem& system, const Solution& solution);

/// That which the solution has, or one made for it where its solver has none (iterative ones).
std::shared_ptr<const ContactFactor> contact_factor(const SaddlePointSystem& system, const Solution& solution);

}  // namespace mortise
