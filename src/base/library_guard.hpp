// gmsh may crash, run for ever or end the process, VTK on a damaged file too: no run of ours ends without a word for
// that.
#pragma once

#include <csignal>
#include <cstddef>
#include <string>
#include <vector>

namespace mortise {

/// While it lives, one at a time: a crash (SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT; also by a stack that is used up),
/// a call of exit() and the time limit each end the process with exit status 1 and one line on the standard error: the
/// file, what happened, and the last message if there is one. What is written to the standard output and error
/// meanwhile is kept from the terminal, as the place where that message is found. The destructor puts back handlers,
/// timer, output and error.
class LibraryGuard {
 public:
  /// `file` is named in the line, and the `library`; `seconds` > 0 is the time limit, `limit` what it is called.
  LibraryGuard(const std::string& file, double seconds, const std::string& library = "gmsh",
               const std::string& limit = "mesh.time_limit = ");
  ~LibraryGuard();
  LibraryGuard(const LibraryGuard&) = delete;
  LibraryGuard& operator=(const LibraryGuard&) = delete;

 private:
  std::vector<char> stack_;  // on which the handlers run
  stack_t old_stack_{};
  std::vector<struct sigaction> old_actions_;
  int old_output_ = -1, old_error_ = -1;
};

}  // namespace mortise
