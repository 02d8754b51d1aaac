// Surface layers as unknowns of their own.
#pragma once

#include "solve/saddle_point_system.hpp"

namespace mortise {

/// What compressions d press with, l: the derivative of their energy.
VecX layer_forces(const SurfaceLayers& layers, const VecX& d);

/// The diagonal of K_d, l, > 0: how these grow with d.
VecX layer_stiffness(const SurfaceLayers& layers, const VecX& d);

/// The system of (u, d), d the compressions of its layers: stiffness [K 0; 0 K_d], rows [B B_d], so that all that
/// solves it has rows that give way, C + B_d K_d^-1 B_d^T. The same loads; no layers left. `stiffness`: K_d.
SaddlePointSystem layered_system(const SaddlePointSystem& system, const VecX& stiffness);

/// B_d d, m x count, of what multipliers `lambda` (m x count) add to compressions d; 0 without layers.
MatX layer_openings(const SurfaceLayers& layers, const VecX& d, const MatX& lambda);

/// n x (n + l): u of (u, d).
SparseRows without_layers(Eigen::Index unknowns, Eigen::Index all);

/// f, g, prescribed values and the rows to start from of a system into the layered one that was made of it.
void take_loads(const SaddlePointSystem& system, SaddlePointSystem& layered);

}  // namespace mortise
