// Multi-point constraints u = T q taken out of the equations: T^T K T q + (B T)^T lambda = T^T f, B T q = g.
#pragma once

#include "solve/saddle_point_system.hpp"

namespace mortise {

/// The equations of q, without multi-point constraints; of a system that has some.
SaddlePointSystem independent_system(const SaddlePointSystem& system);

}  // namespace mortise
