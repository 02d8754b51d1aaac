// gmsh may crash, run for ever or end the process: no run of ours ends without a word for that.
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
class GmshGuard {
 public:
  /// `file` is named in the line; `seconds` > 0 is the time limit.
  GmshGuard(const std::string& file, double seconds);
  ~GmshGuard();
  GmshGuard(const GmshGuard&) = delete;
  GmshGuard& operator=(const GmshGuard&) = delete;

 private:
  std::vector<char> stack_;  // on which the handlers run
  stack_t old_stack_{};
  std::vector<struct sigaction> old_actions_;
  int old_output_ = -1, old_error_ = -1;
};

}  // namespace mortise
