// Domain decomposition for any number of bodies: the dual method (FETI).
#pragma once

#include "solve/saddle_point_system.hpp"

namespace mortise {

/// Each connected part of the bodies is factorised alone; the multipliers are found by conjugate gradients, projected
/// on those that hold every part in balance: the rigid motions of all parts are the coarse problem, so that the number
/// of steps does not grow with that of the bodies (Farhat & Roux 1991; deviation from total FETI, Dostal, Horak &
/// Kucera 2006: prescribed displacements are eliminated, and springs hold what is left). Preconditioned by the
/// stiffness of the parts' contact nodes, jumps shared by stiffness (Farhat, Mandel & Roux 1994; Rixen & Farhat 1999;
/// for mortar rows Stefanica 2001). Unilateral rows by the primal-dual active set method around it (as
/// solve/active_set.hpp; Avery & Farhat 2009), each started from the one before. docs/theory.md eq. 51a to 54.
///
/// `system`: as for solve_directly; no dense matrix is larger than the rows of one part. `slenderness`: of each node
/// (mesh/slenderness.hpp), which says what parts bend; empty: none. Status as solve_directly's.
Solution solve_by_feti(const SaddlePointSystem& system, const FetiOptions& options,
                       const std::vector<double>& slenderness = {});

}  // namespace mortise
