// Two rough surfaces between the sides of a pair: p in proportion to their approach.
#pragma once

#include "contact/contact_interface.hpp"
#include "model/choices.hpp"

namespace mortise {

/// The layer's compression d = sum N_b d_b, b of Coupling::node, has the energy 1/2 int k d^2 dA. A row holds the gap
/// open by int psi d dA less, so that p = k d in the mean (docs/theory.md eq. 13a). Lists of entries, 0 where a side
/// faces nothing but for a small diagonal.
struct SurfaceLayer {
  using Entries = std::vector<Eigen::Triplet<double>>;
  Entries stiffness;  ///< b, b' <= b: int k N_b N_b' dA, stress times depth
  Entries rows;       ///< row, b: int psi_row N_b dA, length times depth
};

/// Of an interface that has its rows. `stiffness`: k, stress over length.
SurfaceLayer surface_layer(const ContactInterface& interface, Multipliers space, double stiffness);

/// What is left of openings at the pair's points (a row a point, a column a field) once the layer has followed them
/// between `closed` vertices of the multiplier side: less their means with the hat functions of these.
MatX less_layer(const ContactInterface& interface, const std::vector<char>& closed, MatX opened);

}  // namespace mortise
