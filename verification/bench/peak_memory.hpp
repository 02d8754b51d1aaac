// How much memory a piece of work takes at its peak.
#pragma once

#include <functional>

namespace mortise::bench {

/// Peak resident memory, MB, of a child process that calls `prepare`, then `work`; what only `prepare` needed does
/// not count (Linux). The child starts with what this process holds, so call this before anything big is done here.
/// Throws std::runtime_error if the child fails.
double peak_megabytes(const std::function<void()>& prepare, const std::function<void()>& work);

}  // namespace mortise::bench
