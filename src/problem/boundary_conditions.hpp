// A [[boundary]] entry in the equations: prescribed displacements along x and y, loads, foundations.
#pragma once

#include "fem/foundation.hpp"
#include "model/resultant.hpp"
#include "problem/boundary_entries.hpp"
#include "solve/saddle_point_system.hpp"

namespace mortise {

/// Traction, stress, at a place of a curve with this outward unit normal and s.
using TractionField = std::function<Vec2(const Vec2& x, const Vec2& n, double s)>;

/// That of a load along curves; empty: the entry is none.
TractionField traction_of(const Mesh& mesh, const Model& model, const BoundaryEntry& entry);

/// Adds the entry's prescribed displacements along x and y and its loads to the system, and the stiffness of its
/// foundation or springs to `springs` (other displacements: multipoint_supports.hpp). Returns the sum of the forces
/// that it makes. Throws SceneError where two values are prescribed at one node, or a field has no value.
Resultant apply(const Mesh& mesh, const Model& model, const BoundaryEntry& entry, SaddlePointSystem& system,
                Triplets& springs);

}  // namespace mortise
