// One part of the dual method: what forces and multipliers do to it, by its kind.
#pragma once

#include "ddm/body_group.hpp"
#include "ddm/slender_parts.hpp"

namespace mortise {

/// Some rows of a part, places among its rows, and its matrices' entries between them; empty where they are all.
struct SomeRows {
  std::vector<int> rows;
  MatX C, stiffness;
};

/// A substructure, factorised. Its rows, unknowns and springs are those of the whole system that it has; vectors below
/// are of these alone, a column each of several, dimensionless as the bordered system.
class DualPart {
 public:
  virtual ~DualPart() = default;

  std::vector<int> unknowns, rows, springs;
  MatX H;                  ///< rows x springs: B R, as BodyGroup
  SparseMatrix sharing;    ///< rows x rows: B W^-1 B^T, as DualSystem
  VecX diagonal;           ///< of C; of a slender part what a row's pressure does near it
  BodyGroup::Answer load;  ///< to its own

  /// -1, or the unknown of the whole at which it is not positive definite: nothing else may be used then.
  int failed_at() const { return body_->failed_at < 0 ? -1 : unknowns[body_->failed_at]; }
  /// To forces on its unknowns, over the stiffness scale.
  virtual BodyGroup::Answer answer(const MatX& forces) const { return body_->answer(forces); }
  virtual MatX pressed(const MatX& lambda) const = 0;       ///< C lambda
  virtual MatX compliance() const = 0;                      ///< C, full; of a slender part with many rows a solve a row
  virtual SomeRows some(std::vector<int> which) const = 0;  ///< `which`: places among its rows, ascending
  /// On some rows, of vectors that are zero on the others, where the results mean nothing: C lambda; and
  /// B W^-1 S W^-1 B^T x, as DualSystem, 0 of a slender part.
  virtual MatX pressed(const MatX& lambda, const SomeRows& some) const = 0;
  virtual MatX stiffened(const MatX& x, const SomeRows& some) const = 0;
  virtual bool is_full() const { return true; }  ///< C is at hand
  virtual MatX displacements(const BodyGroup::Answer& forces, const MatX& lambda, const MatX& mu) const = 0;

 protected:
  MatX moved(const BodyGroup::Answer& forces, const MatX& lambda, const MatX& mu) const;

  std::shared_ptr<const BodyGroup> body_;
};

/// What parts that are alike have in common, with a unit row a contact unknown.
struct AlikeBody {
  std::vector<int> contact;  ///< unknowns, c of them
  SparseMatrix units;        ///< n x c, a unit column each
  std::shared_ptr<const BodyGroup> body;
  MatX stiffness;  ///< c x c: S

  explicit AlikeBody(SaddlePointSystem system);
};

/// For each of `parts` that is compact that of the first one alike, if this takes less than the parts one by one; else
/// empty.
std::vector<std::shared_ptr<const AlikeBody>> alike_bodies(const Substructures& parts,
                                                           const std::vector<PartKind>& kinds);

/// Factorises a part; `alike`: nullptr if it has a body of its own.
std::unique_ptr<DualPart> dual_part(Substructure part, PartKind kind, const AlikeBody* alike);

}  // namespace mortise
