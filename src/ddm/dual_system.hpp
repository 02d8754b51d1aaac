// The system of the multipliers, part by part: what the dual method iterates on.
#pragma once

#include "ddm/body_group.hpp"
#include "ddm/ranks.hpp"
#include "ddm/substructures.hpp"

namespace mortise {

/// Each substructure factorised once, on its own. Where contact closes all rows,
///
///   [C  H; H^T  0] (lambda, mu) = (r, h),   C = sum of the parts' B K^-1 B^T,   H = B R   (docs/theory.md eq. 51)
///
/// with s rigid motions R that only contact holds, as in BodyGroup; dimensionless, as the bordered system. Each rank
/// has the parts of its block; what has m or s entries is on all of them, unless it says "own" (DealtRows).
class DualSystem {
 public:
  explicit DualSystem(const SaddlePointSystem& system);

  /// -1, or the unknown at which K is not positive definite: nothing below may be used then.
  int failed_at = -1;
  SparseMatrix H;  ///< own rows x s

  /// What forces on the parts make of the right-hand side: r (m), h (s).
  struct Answer {
    std::vector<BodyGroup::Answer> parts;  // of this rank
    VecX r, h;
  };
  Answer load;  ///< to the system's own, and its gaps
  /// To forces, n, over the stiffness scale.
  Answer answer(const VecX& force) const;

  /// B W^-1 B^T with W the diagonal of K: how a jump across the contact is shared by its two sides, by stiffness (Rixen
  /// & Farhat 1999); m x m, lower triangle.
  SparseMatrix sharing;

  const DealtRows& rows() const { return *rows_; }
  /// C lambda; own of both.
  VecX multiply(const VecX& lambda) const;
  /// C lambda + H mu, m.
  VecX closing(const VecX& lambda, const VecX& mu) const;
  /// B W^-1 S W^-1 B^T x, likewise own, with S the stiffness of the parts' contact nodes, all other nodes free (the
  /// Schur complement).
  VecX multiply_stiffness(const VecX& x) const;

  /// Adds the displacements under forces and the multipliers to u (n, length).
  void add_displacements(const Answer& forces, const VecX& lambda, const VecX& mu, VecX& u) const;

 private:
  struct Part {
    std::vector<int> unknowns, rows, springs;
    std::vector<int> places;  // of the rows, in the vectors that this rank's parts see
    BodyGroup group;
    MatX stiffness;  // of multiply_stiffness, full
  };

  void deal_rows(Eigen::Index m);
  static void sum_over_ranks(Answer& answer);

  std::vector<Part> parts_;
  std::unique_ptr<const DealtRows> rows_;
};

}  // namespace mortise
