// Domain decomposition: each body solved alone, the interface brought to agreement by iteration.
#pragma once

#include "solve/saddle_point_system.hpp"

namespace mortise {

/// Solves the saddle-point system by iterations between two groups of bodies. `dirichlet`: n, the unknowns of the group
/// that takes the displacement; the other group takes the pressure. No row of B may lie within one group.
/// beta is estimated as the best one for the spectrum of the closed rows. Rows that may open are found by the active
/// set method around the iteration (docs/theory.md, section 11). dependent_row: a group that takes a displacement (the
/// Dirichlet group; in Neumann-Neumann and Dirichlet-Dirichlet both) does not feel it. Figures of the iteration: beta
/// (0 where none is used), eigenvalue.smallest and eigenvalue.largest of the interface with the last closed rows (0
/// where they were not needed).
Solution solve_by_ddm(const SaddlePointSystem& system, const std::vector<char>& dirichlet, const DdmOptions& options);

}  // namespace mortise
