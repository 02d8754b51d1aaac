// The runs of a sweep: one scene with other values.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "app/run_row.hpp"
#include "app/solve_scene.hpp"

namespace mortise {

/// The message of the first of these runs where none can be read; nothing where one can.
std::string refusal_of(const std::string& path, const std::vector<std::vector<Override>>& runs);

/// One run: solved, to its accuracy where it asks for one, estimated and judged. Bad input is a row that says so.
RunRow solve_run(const std::string& path, const std::vector<Override>& overrides, bool diagnosed, CaseSolver& solver,
                 const Progress& progress = {});

/// Serves `mortise sweep` (src/python/sweeps) as one of its processes, until `in` ends. Runs come in groups: within
/// one, a run on the same mesh as the one before starts from its active set; what a group gives hangs on no other.
///   out {}                                    the command line has been understood
///   in  [[[KEY, VALUE], ...], ...]            a group: what each run overrides
///   out {"key": KEY}                          what its rows follow from: values, version and how the files stand;
///                                             "refused": MESSAGE besides, where no run can be read
///   in  solve, or keep                        whether they are wanted
///   out {"status": WORD, "figures": {...}}    of each run
void serve_sweep(const std::string& path, const std::vector<Override>& overrides, bool diagnosed, std::istream& in,
                 std::ostream& out);

}  // namespace mortise
