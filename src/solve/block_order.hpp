// In which order the unknowns of a stiffness are eliminated.
#pragma once

#include <vector>

#include "base/types.hpp"

namespace mortise {

/// From so many unknowns on, nested dissection: below, it takes longer than it saves.
inline constexpr int dissect_from = 40000;

/// The first n columns of `upper` (the upper triangle of a symmetric matrix), in the order that fills the factor
/// little: entry k is the column that comes k-th. `blocks`, n, groups unknowns that share a node (ascending, 0, 0, 1,
/// 1, 2, ...): they stay together. Approximate minimum degree (Amestoy, Davis & Duff 2004) on the graph of nodes, or
/// from `dissect_from` unknowns on nested dissection (George 1973; METIS: Karypis & Kumar 1998) on that of its corners.
std::vector<int> block_order(const SparseMatrix& upper, const std::vector<int>& blocks, int dissect = dissect_from);

/// An order cut by the first separator of its dissection: nothing couples the `first` unknowns that begin it with the
/// `second` that follow; the others, which come last, separate them. By minimum degree all are first.
struct Dissection {
  std::vector<int> order;
  int first = 0, second = 0;
};

/// block_order of some `unknowns` alone (ascending, nodes whole), which nothing couples with the others.
Dissection dissection(const SparseMatrix& upper, const std::vector<int>& blocks, const std::vector<int>& unknowns,
                      int dissect = dissect_from);

}  // namespace mortise
