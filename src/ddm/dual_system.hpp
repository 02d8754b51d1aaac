// The system of the multipliers, part by part: what the dual method iterates on.
#pragma once

#include "ddm/dual_part.hpp"
#include "ddm/slender_parts.hpp"

namespace mortise {

/// Each substructure factorised once, on its own, or once for all that are alike. Where contact closes all rows,
///
///   [C  H; H^T  0] (lambda, mu) = (r, h),   C = sum of the parts' B K^-1 B^T,   H = B R   (docs/theory.md eq. 51a)
///
/// with s rigid motions R that only contact holds, as in BodyGroup; dimensionless, as the bordered system. A column
/// each of several vectors.
class DualSystem {
 public:
  /// `slenderness`: as of solve_by_feti.
  DualSystem(const SaddlePointSystem& system, const std::vector<double>& slenderness);

  /// -1, or the unknown at which K is not positive definite: nothing below may be used then.
  int failed_at = -1;
  SparseMatrix H;  ///< m x s

  /// What forces on the parts make of the right-hand side. The parts alone open the rows by `response`, with the energy
  /// f^T K^-1 f: where springs hold a body against its load, both are far more than of its balance with lambda.
  struct Forces {
    MatX r, h, response;  ///< m, s, m
    VecX energy;
  };
  struct Answer : Forces {
    std::vector<BodyGroup::Answer> parts;
  };
  Answer load;  ///< to the system's own, and its gaps
  /// To forces, n, over the stiffness scale.
  Answer answer(const MatX& forces) const;

  /// B W^-1 B^T with W the diagonal of K: how a jump across the contact is shared by its two sides, by stiffness (Rixen
  /// & Farhat 1999); m x m, lower triangle.
  SparseMatrix sharing;

  VecX diagonal;         ///< of C, m; of slender parts only what the row's own pressure does near it
  SlenderParts slender;  ///< where there are any

  /// What displacements of the rows are compared with: `moved`, the largest of all parts together, or the largest of
  /// `terms`, which springs may make far larger, so that where bodies float only a part of it counts.
  double size(double moved, double terms) const {
    return H.cols() > 0 ? largest(moved, 1e-5 * terms) : largest(moved, terms);
  }

  /// C lambda, H motions, H^T lambda.
  MatX multiply(const MatX& lambda) const;
  MatX opening(const MatX& motions) const { return H * motions; }
  MatX resultants(const MatX& lambda) const { return H.transpose() * lambda; }
  /// [C, H; H^T, 0], m + s, lower triangle. A slender part's C takes a solve a row if these are many.
  SparseMatrix matrix() const;
  /// |h| + |H|^T |lambda|: what the work that lambda leaves of h is a difference of.
  VecX work_terms(const VecX& h, const VecX& lambda) const;
  /// s: diagonal of H^T D^-1 H, with D that of C.
  VecX stiffness() const;
  /// Of each part those of its rows that are closed (m).
  std::vector<SomeRows> closed_of_parts(const std::vector<char>& closed) const;
  /// On these rows, of vectors that are zero on all others, where the results mean nothing: C lambda.
  MatX multiply(const MatX& lambda, const std::vector<SomeRows>& closed) const;
  /// B W^-1 S W^-1 B^T x, likewise, with S the stiffness of the parts' contact nodes, all other nodes free (the Schur
  /// complement); of all parts but the slender ones.
  MatX multiply_stiffness(const MatX& x, const std::vector<SomeRows>& closed) const;

  /// Adds the displacements under forces and the multipliers to u (n, length).
  void add_displacements(const Answer& forces, const MatX& lambda, const MatX& mu, Eigen::Ref<MatX> u) const;

 private:
  void add_up(Eigen::Index count, Answer& answer) const;

  void factorise(const SaddlePointSystem& system, const std::vector<double>& slenderness);
  void gather(const SaddlePointSystem& system);

  std::vector<std::unique_ptr<DualPart>> parts_;
};

}  // namespace mortise
