// What is drawn far from the origin, where gmsh's tolerances fail. No gmsh header here.
#pragma once

#include "gmsh/gmsh_session.hpp"
#include "mesh/box_index.hpp"

namespace mortise {

/// Whether it lies farther from the origin than it is large. gmsh's tolerances are parts of the coordinates: at 1000
/// times the size it finds points in one place, at 1e6 times it divides an arc for minutes.
bool lies_far(const Box& box);

/// The geometry as a .geo without loops, variables and commands, one statement a line. Throws as GmshSession::run does.
std::string unrolled(GmshSession& session, const std::string& file);

/// Moves what was read to the origin if it lies far from there; returns by what. It stays where it is if a field says
/// how large elements are, a function of place, or if it is not all drawn by gmsh's own kernel (OpenCASCADE's geometry
/// would lose its groups). Throws as unrolled does.
Vec2 move_to_origin(GmshSession& session, const std::string& file);

}  // namespace mortise
