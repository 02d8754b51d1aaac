// An order of unknowns in which neighbours in a matrix stand near one another.
#pragma once

#include <vector>

#include "base/types.hpp"

namespace mortise {

/// Reverse Cuthill-McKee (Cuthill & McKee 1969, reversed: George 1971) of a symmetric matrix, n x n, of which the lower
/// triangle is given: entry k is the unknown that comes k-th. Parts that nothing couples come one after the other, each
/// from an end of the part, found as the last unknown of two searches in breadth (Gibbs, Poole & Stockmeyer 1976).
std::vector<int> band_order(const SparseMatrix& lower);

}  // namespace mortise
