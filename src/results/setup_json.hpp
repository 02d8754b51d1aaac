// What scripts draw before anything is solved: the set-up of a scene (python/pictures/setup.py), or a geometry alone
// (python/scenes).
#pragma once

#include <filesystem>

#include "problem/problem.hpp"

namespace mortise {

/// Writes a JSON file: "source", the mesh's file; "nodes" [x, y]; "bodies", each with "name" and "cells" (nodes round
/// each); "curves", by name all edges [start, end, middle or -1, body, places], with the body on their left; "places"
/// [x, y] along the drawn edge, none where that is straight or not known. Lengths in the file's unit. Throws InputError
/// where it cannot be written.
void write_geometry(const Mesh& mesh, const std::filesystem::path& path);

/// The same, and of each body its "material"; "title"; "points", by name the nodes of those that are named below;
/// "supports" and "loads" ("on", "words", "sum" of a load); "contact" ("between", "words"); "ties" (two curves each);
/// "rest", lines of what acts on no curve. Lengths and forces in the scene's units. Throws InputError where it cannot
/// be written.
void write_setup(const Problem& problem, const std::filesystem::path& path);

}  // namespace mortise
