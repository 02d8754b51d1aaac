// Surface layers as unknowns of their own.
#pragma once

#include "solve/saddle_point_system.hpp"

namespace mortise {

/// The system of (u, d), d the compressions of its layers: stiffness [K 0; 0 K_d], rows [B B_d], so that all that
/// solves it has rows that give way, C + B_d K_d^-1 B_d^T. The same loads; no layers left.
SaddlePointSystem layered_system(const SaddlePointSystem& system);

/// B_d d, m x count, of the compressions d that multipliers `lambda` (m x count) cause; 0 without layers.
MatX layer_openings(const SurfaceLayers& layers, const MatX& lambda);

/// n x (n + l): u of (u, d).
SparseRows without_layers(Eigen::Index unknowns, Eigen::Index all);

/// f, g, prescribed values and the rows to start from of a system into the layered one that was made of it.
void take_loads(const SaddlePointSystem& system, SaddlePointSystem& layered);

}  // namespace mortise
