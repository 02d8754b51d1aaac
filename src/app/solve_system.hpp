// The equations of a scene, solved by the solver that it names.
#pragma once

#include "problem/validate.hpp"

namespace mortise {

/// The one that is named; else feti from 1000 rows on, where three parts or more hang together by contact alone: from
/// there on it is faster than the direct solver's dense compliance. Else direct.
Solver solver_for(const Method& method, const SaddlePointSystem& system);

/// By the direct solver after all where nobody named feti and it does not converge. `dirichlet`: of domain
/// decomposition, n: the unknowns of the bodies that take the displacement.
Solution solve_system(const Method& method, const SaddlePointSystem& system, const std::vector<char>& dirichlet);

/// Throws SceneError, with the place, where the solver found none: what SolveStatus says of it.
void require_solution(const Mesh& mesh, const std::vector<ContactPair>& pairs, const Floating& floating,
                      const Solution& solution);

}  // namespace mortise
