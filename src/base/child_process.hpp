// A piece of work in a child process: whatever crashes, ends or never returns there leaves this one as it was.
#pragma once

#include <functional>
#include <string>

#include "base/errors.hpp"

namespace mortise {

/// Work on a file by somebody else's library, and how its failures are reported: "FILE: LIBRARY crashed (...)".
struct ChildWork {
  std::string file;
  std::string library = "gmsh";
  double seconds = 600;                      ///< time limit, > 0
  std::string limit = "mesh.time_limit = ";  ///< its name, put before the seconds
};

/// The work did what its process was not allowed to do (base/sandbox.hpp): what() says what.
class ForbiddenAct : public InputError {
 public:
  using InputError::InputError;
};

/// Runs `work` in a child process and returns the bytes that it returns. What it throws comes through as an InputError,
/// std::domain_error, std::bad_alloc or otherwise std::runtime_error of the same words. Throws InputError, with the
/// last line that was written to the standard output or error meanwhile, if the child crashes, ends (exit) or is
/// killed, or if it takes longer than the time limit, at which it and all that it has started are killed; ForbiddenAct.
/// The child's output does not reach the terminal. It does not outlive this thread.
std::string run_in_child(const ChildWork& child, const std::function<std::string()>& work);

/// In the child only: ends it, and run_in_child throws ForbiddenAct of these words. May be called by a signal handler.
[[noreturn]] void end_child_by_forbidden_act(const char* act);

}  // namespace mortise
