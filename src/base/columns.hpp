// Vectors that span a space, in a form that does not depend on how they were found.
#pragma once

#include "base/types.hpp"

namespace mortise {

/// The same space of columns (n x k, independent) with a row for each column where it is 1 and the others are 0
/// (reduced column echelon form, pivots the largest that are left): motions of two bodies that an eigensolver has mixed
/// come apart.
MatX told_apart(MatX columns);

}  // namespace mortise
