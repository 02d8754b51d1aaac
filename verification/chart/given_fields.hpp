// Another program's answer in the place of mortise's, so that both have their errors from the same code.
#pragma once

#include <string>

#include "results/results.hpp"

namespace mortise::chart {

/// Puts displacements (FILES_bodies.txt: body x y u1 u2 a line) and contact pressures (FILES_contact.txt: pair x y p
/// and another value) into the results of a run with the same nodes and multipliers. Throws std::runtime_error where a
/// node has no partner.
void take_fields(Results& results, const std::string& files);

}  // namespace mortise::chart
