// What the pressure is off by where the gap between two lines is not known any better.
#pragma once

#include "error/pressure_line.hpp"
#include "fem/material.hpp"

namespace mortise {

/// At each vertex, stress: (pi / 2) E* d / h. A gap that is off by d in one edge and not in the next is a wave of
/// length 2 h, which half-planes of combined modulus E*, 1 / E* = sum (1 - nu^2) / E, need that pressure to close
/// (Johnson 1985, section 13.2). `d`: ContactPoint::unknown of the edges at the vertex; 0 where they stay open
/// whatever it is, and where all is known.
VecX gap_error(const ContactPair& pair, const std::vector<ElasticLaw>& laws, const PressureLine& line);

/// Adds it to the line's error.
void add_gap_error(const PressureLine& line, const VecX& gap_error, LineError& error);

}  // namespace mortise
