// The direct solver: one factorisation of all bodies, and the active set on the multipliers alone.
#pragma once

#include "solve/saddle_point_system.hpp"

namespace mortise {

/// docs/theory.md, sections 6 and 10. As a rule to round-off; one step of refinement where that is not reached.
Solution solve_directly(const SaddlePointSystem& system);

}  // namespace mortise
