// How much longer than thick bodies are, however they are meshed.
#pragma once

#include "mesh/mesh.hpp"

namespace mortise {

/// For each node that of the piece that it belongs to, all that hangs together by common nodes: the longest of the
/// shortest ways within it, squared, over its area. About length over thickness of what is long, a quarter of girth
/// over thickness of a ring; 2 of a square.
std::vector<double> slenderness(const Mesh& mesh);

}  // namespace mortise
