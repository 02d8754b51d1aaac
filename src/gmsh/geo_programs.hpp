// A .geo is a program: which of its commands reach beyond the mesh.
#pragma once

#include "gmsh/geo_text.hpp"

namespace mortise {

/// Throws InputError, with file and line, at a command that runs a program or writes a file (SystemCall, OnelabRun,
/// Save, Print, Printf > "file", Plugin, ...), and where the text hides what it does: a file to include whose name is
/// computed or that is neither geometry nor mesh, a macro made from a string. A list of known commands, not a wall:
/// what untrusted text may do in the end only a sandbox can bound.
void check_no_programs(const GeoText& geo);

}  // namespace mortise
