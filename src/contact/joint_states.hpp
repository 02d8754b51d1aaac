// What bodies that meet at a point do where some of their joints open beside it.
#pragma once

#include "contact/williams.hpp"

namespace mortise {

/// Exponents with all joints closed, and of the modes that hold with some of them open if those are smaller. A mode of
/// closed joints that presses on some and pulls at others opens these, however little of it there is, and whatever its
/// sign. They stay open if a mode then presses on all others and opens them further.
/// docs/theory.md section 8. `joint`: a sliding one, in Fan::joints.
TipExponents exponents_of_states(const Fan& fan, std::size_t joint);

}  // namespace mortise
