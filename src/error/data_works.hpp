// What functions of place that the mesh does not resolve do to functionals, by their dual solutions.
#pragma once

#include "problem/problem.hpp"

namespace mortise {

/// Misfits (of the problem) x duals: at most what each does to the functional (docs/theory.md eq. 51), without sign; of
/// the outline (eq. 51c) what it does. `z`: the duals, n x F.
MatX data_works(const Problem& problem, const VecX& u, const MatX& z);

/// The largest displacement of the nodes on the side of a cell that a foundation's misfit is of.
double largest_on(const Mesh& mesh, const DataMisfit& part, const VecX& u);

}  // namespace mortise
