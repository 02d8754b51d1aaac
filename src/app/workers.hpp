// Work that is shared out over processes.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace mortise {

/// Gives a line without ends of line to the process that shares the work out.
using Answer = std::function<void(const std::string& line)>;

/// Calls work(i, answer) once for each i below count, in so many processes that are forked for it, and take(line) here
/// for each answer, those of one piece of work in order; with one process all of it here, without forking. What `work`
/// throws ends its process with a line on the standard error. False if a process ended before its work was done: then
/// the others have been ended too.
bool share_work(std::size_t count, int processes, const std::function<void(std::size_t, const Answer&)>& work,
                const std::function<void(const std::string& line)>& take);

}  // namespace mortise
