// Bodies that play one role, each solved alone: what a pressure does to their contact curves.
#pragma once

#include <algorithm>

#include "solve/bordered_system.hpp"

namespace mortise {

/// The load on a system's unknowns, and of its prescribed displacements, over the stiffness scale.
VecX load_of(const SaddlePointSystem& system);

/// Factorised once. With B the group's columns of the coupling, its displacements under the multipliers lambda are
///
///   u = K^-1 (f - B^T lambda) - R mu,   so that   B u = response - C lambda - H mu,   H = B R,
///
/// where R are the group's rigid motions that nothing but contact holds (floating bodies), K^-1 is taken with one
/// unknown a motion held, and the load must be in balance: H^T lambda = work (docs/theory.md eq. 29 and 30). Everything
/// is dimensionless, as the bordered system.
class BodyGroup {
 public:
  /// `member`: one entry an unknown of the system. The rows are the system's own.
  BodyGroup(const SaddlePointSystem& system, const std::vector<char>& member);

  /// -1, or the unknown at which the group's stiffness is not positive definite: nothing below may be used then.
  int failed_at = -1;
  Eigen::Index motions = 0;  ///< s
  MatX compliance;           ///< (m + s) x (m + s), lower triangle: [C; H^T, .]
  MatX C, H;                 ///< m x m (full), m x s

  /// What forces do to the free group, a column each: y = L^-1 f for the displacements, response (m), work (s).
  struct Answer {
    MatX y, response, work;
  };
  Answer load;  ///< to the system's own

  /// True of its free unknowns.
  bool has(int unknown) const { return std::binary_search(free_.begin(), free_.end(), unknown); }

  /// To forces on its unknowns, n, over the stiffness scale.
  Answer answer(const MatX& forces) const;
  /// R on a system's n unknowns, n x s.
  MatX motion_shapes(Eigen::Index unknowns) const;
  /// Adds the group's displacements under forces and the multipliers to u (n, length), column by column.
  void add_displacements(const Answer& forces, const MatX& lambda, const MatX& mu, Eigen::Ref<MatX> u) const;

 private:
  std::vector<int> free_;
  std::unique_ptr<BorderedCholesky> factor_;
};

}  // namespace mortise
