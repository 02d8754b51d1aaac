// Parts far longer than thick: solved with all that they touch, where the dual method preconditions.
#pragma once

#include <Eigen/SparseCholesky>

#include "ddm/ranks.hpp"
#include "ddm/substructures.hpp"

namespace mortise {

/// Whether a part bends so easily that its contact nodes' stiffness says little of what its pressures do.
bool is_slender(const Substructure& part);

/// The slender parts of all ranks, on each of them; dimensionless, as the bordered system.
struct SlenderParts {
  std::vector<int> rows;   ///< that they see, ascending
  std::vector<int> place;  ///< m: of each row in these, or -1
  SparseMatrix K;          ///< of their free unknowns, lower triangle, held by soft springs
  SparseMatrix B;          ///< rows x these unknowns
  SparseMatrix D;          ///< rows x rows, lower triangle: compliance of all other parts

  bool empty() const { return rows.empty(); }
};

/// A slender part's stiffness, in unknowns of the whole system.
void add_stiffness(const Substructure& part, Triplets& entries);

/// `stiffness`: of this rank's; D is left empty.
SlenderParts slender_parts(Triplets stiffness, const SaddlePointSystem& s);

/// Adds the compliance C of a part's rows, and that of its motions H (the work of which the multipliers have none),
/// many times over, so that the parts' balance is no concern of the inverse; in places of rows.
void add_compliance(const SlenderParts& parts, const std::vector<int>& rows, const MatX& C, const MatX& H,
                    Triplets& entries);

/// D of this rank's entries. `local`: m, a small compliance of each row.
void set_compliance(SlenderParts& parts, Triplets entries, const VecX& local);

/// (B K^-1 B^T + D)^-1 on closed rows, 0 on the others: what pressures on these rows close given gaps. With C the
/// compliance of all parts it is exact but for rows that slender parts do not see. As one sparse quasidefinite
/// factorisation (Vanderbei 1995),
///
///   [K  B^T; B  -D] (u, lambda) = (0, -gap).
class SlenderInverse {
 public:
  SlenderInverse(const SlenderParts& parts, const std::vector<char>& closed);
  /// Both of all rows.
  VecX multiply(const VecX& gap) const;

 private:
  std::vector<int> rows_;
  VecX closed_;
  Eigen::Index unknowns_ = 0;
  Eigen::SimplicialLDLT<SparseMatrix> factor_;
};

}  // namespace mortise
