// The limit that the whole solve is measured against: one sparse Cholesky solve of the same stiffness by CHOLMOD.
#pragma once

#include "problem/discretisation.hpp"

namespace mortise::bench {

/// The equations of the bodies alone, on the free unknowns.
struct GroundedSystem {
  SparseMatrix K;  ///< lower triangle, positive definite: a spring holds each motion that only contact resists
  VecX f;
};

GroundedSystem grounded_system(const Mesh& mesh, const Discretisation& discretisation);

/// CHOLMOD's analysis, supernodal factorisation and solution: ordering AMD, 32-bit indices, everything else its
/// default. Throws std::runtime_error if it fails.
VecX cholmod_solution(const GroundedSystem& system);

}  // namespace mortise::bench
