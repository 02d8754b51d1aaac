// What functions of place that the mesh does not resolve do to functionals, by their dual solutions.
#pragma once

#include "problem/problem.hpp"

namespace mortise {

/// Misfits (of the problem) x duals: at most what each does to the functional (docs/theory.md eq. 51), without sign.
/// `z`: the duals, n x F.
MatX data_works(const Problem& problem, const VecX& u, const MatX& z);

}  // namespace mortise
