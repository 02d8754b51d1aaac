// Threads of the dense kernels inside the factorisation.
#pragma once

namespace mortise {

/// 0 (the default): as many as there are cores where the work is worth it, else one.
void set_solver_threads(int threads);

/// For independent pieces of work.
int solver_threads();

/// Called before a factorisation of so many floating-point operations.
void apply_solver_threads(double operations);

}  // namespace mortise
