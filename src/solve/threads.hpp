// Threads of the dense kernels inside the factorisation.
#pragma once

namespace mortise {

/// 0 (the default): as many as there are cores for independent pieces of work, one for each factorisation.
void set_solver_threads(int threads);

/// For independent pieces of work.
int solver_threads();

/// Called before a factorisation: its dense products on one thread, or on as many as were asked for where nothing else
/// runs beside it. The threads of OpenBLAS wait for each other by running idle: on a busy machine that takes many times
/// longer than one thread.
void apply_solver_threads();

}  // namespace mortise
