// Domain decomposition: each body solved alone, the interface brought to agreement by iteration.
#pragma once

#include "solve/saddle_point_system.hpp"

namespace mortise {

/// Solves the saddle-point system by iterations between two groups of bodies. `dirichlet`: n, the unknowns of the group
/// that takes the displacement; the other group takes the pressure. No row of B may lie within one group.
/// beta is estimated as the best one for the spectrum.
/// Where rows may open, Newton's method finds the closed ones with `krylov`; the other accelerations solve the
/// bilateral problem first and iterate on the projected pressure if that is in tension (docs/theory.md, section 11).
/// dependent_row: a group that takes a displacement (the Dirichlet group; in Neumann-Neumann and Dirichlet-Dirichlet
/// both) does not feel it. in_tension: contact opens, and the scheme is for bilateral contact.
/// Figures of the iteration: beta (0 where none is used), eigenvalue.smallest and eigenvalue.largest of the interface
/// with all contact closed (0 where they were not needed).
Solution solve_by_ddm(const SaddlePointSystem& system, const std::vector<char>& dirichlet, const DdmOptions& options);

}  // namespace mortise
