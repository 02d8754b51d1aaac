// The command line: mortise solve | check | mesh | sweep.
#pragma once

namespace mortise {

/// Runs one command. Returns the exit status: 0 solved and all checks hold; 1 bad input; 2 solved but a check fails
/// or an iteration did not converge; 3 internal error. Errors go to stderr, one line each.
int run_command_line(int argc, const char* const* argv);

}  // namespace mortise
