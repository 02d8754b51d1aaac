// The set-up of a scene, for its picture before it is solved (python/pictures/setup.py).
#pragma once

#include <filesystem>

#include "problem/problem.hpp"

namespace mortise {

/// Writes a JSON file: "title"; "nodes" [x, y]; "bodies", each with "name", "material" and "cells" (nodes round each);
/// "curves", by name the edges [start, end, middle or -1] of those that are named below, with the body on their left;
/// "points", the same way their nodes;
/// "supports" and "loads" ("on", "words", "sum" of a load); "contact" ("between", "words"); "ties" (two curves each);
/// "rest", lines of what acts on no curve. Lengths and forces in the scene's units. Throws InputError where it cannot
/// be written.
void write_setup(const Problem& problem, const std::filesystem::path& path);

}  // namespace mortise
