// Threads of independent pieces of work.
#pragma once

namespace mortise {

/// Debian's OpenBLAS has tables for so many callers at a time, and crashes at more.
constexpr int most_threads = 128;

/// 0 (the default): as many as there are cores. At most most_threads in any case.
/// Any thread may call it, also while others solve: what they begin next takes it.
void set_solver_threads(int threads);

/// For bodies, parts of a system, estimates beside each other.
int solver_threads();

/// Called before a factorisation: its dense products on one thread. CHOLMOD's own OpenMP loops and the threads of
/// OpenBLAS wait for each other by running idle: on a busy machine that takes many times longer than one thread.
/// Throws std::bad_alloc where there is no memory for them.
void apply_solver_threads();

}  // namespace mortise
