// Parts far longer than thick: solved with all that they touch, where the dual method preconditions.
#pragma once

#include <Eigen/SparseCholesky>

#include "ddm/substructures.hpp"

namespace mortise {

/// Slender parts bend so easily that their contact nodes' stiffness says little of what their pressures do. They have
/// a full compliance, as compact parts do, where their rows are few.
enum class PartKind { compact, slender, slender_with_many_rows };

/// `slenderness`: of the whole system's nodes (mesh/slenderness.hpp); none of those beyond its end.
PartKind kind_of(const Substructure& part, const std::vector<double>& slenderness);

/// The slender parts; dimensionless, as the bordered system.
struct SlenderParts {
  std::vector<int> rows;   ///< that they see, ascending
  std::vector<int> place;  ///< m: of each row in these, or -1
  SparseMatrix K;          ///< free unknowns of those with many rows, lower triangle; not held where they float
  SparseMatrix B;          ///< rows x these unknowns
  SparseMatrix D;          ///< rows x rows, lower triangle: compliance of all other parts
  SparseMatrix H;          ///< rows x motions of other parts that these rows alone hold
  /// Unknown and spring of the whole system; the springs of the columns of H.
  std::vector<std::pair<int, int>> springs;
  std::vector<int> springs_of_H;

  bool empty() const { return rows.empty(); }
};

/// A slender part's stiffness, in unknowns of the whole system.
void add_stiffness(const Substructure& part, Triplets& entries);

/// `rows`: of all of them, ascending; `stiffness`: of those with many. D and H are left empty.
SlenderParts slender_parts(std::vector<int> rows, Triplets stiffness, const SaddlePointSystem& s);

/// What a part with a full compliance C of its rows adds: that, and its motions H where slender parts see all of its
/// rows. (Others hold the rest as well as its springs do.)
struct TouchingParts {
  Triplets D;  ///< rows, lower triangle
  Triplets H;  ///< row, spring of the whole system

  void add(const SlenderParts& parts, const std::vector<int>& rows, const MatX& C, const MatX& of_motions,
           const std::vector<int>& springs);
};

/// D and H. `local`: m, a small compliance of each row.
void set_touching(SlenderParts& parts, TouchingParts touching, const VecX& local);

/// (B K^-1 B^T + D)^-1 on closed rows, 0 on the others: what pressures without work on H close given gaps. With C the
/// compliance of all parts it is exact but for rows that slender parts do not see. As one sparse quasidefinite
/// factorisation (Vanderbei 1995),
///
///   [K  .  B^T; .  0  -H^T; B  -H  -D] (u, mu, lambda) = (0, 0, -gap),
///
/// with springs that are next to none at the motions.
class SlenderInverse {
 public:
  SlenderInverse(const SlenderParts& parts, const std::vector<char>& closed);
  /// Both of all rows, column by column.
  MatX multiply(const MatX& gaps) const;

 private:
  std::vector<int> rows_;
  VecX closed_;
  Eigen::Index unknowns_ = 0;
  Eigen::SimplicialLDLT<SparseMatrix> factor_;
};

}  // namespace mortise
