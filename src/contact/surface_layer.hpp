// Two rough surfaces between the sides of a pair: p grows with their approach.
#pragma once

#include "contact/contact_interface.hpp"

namespace mortise {

/// The layer is compressed by d at each of the pair's points, under the pressure that the multipliers have there,
/// -sum N_a lambda_a (docs/theory.md eq. 13a, 19). Entries of the rows: row, point: int N_a dA, length times depth.
Triplets surface_layer(const ContactInterface& interface);

/// What is left of openings at the pair's points (a row a point, a column a field) once the layer has followed them
/// between `closed` vertices of the multiplier side: less their means with the hat functions of these.
MatX less_layer(const ContactInterface& interface, const std::vector<char>& closed, MatX opened);

}  // namespace mortise
