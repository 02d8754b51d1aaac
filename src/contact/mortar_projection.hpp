// The mortar projection from one curve to another: mesh tying.
#pragma once

#include "contact/segments.hpp"

namespace mortise {

/// int psi_a (u_multiplier - u_opposite) dA = 0 for all dual multipliers psi_a, whose matrix D is diagonal:
/// u_a = sum_c M_ac / D_a u_c (Wohlmuth 2000; Puso 2004). Of each node that faces the opposite side, with a tenth
/// of its share of an edge or more.
std::vector<TiedNode> mortar_projection(const Points& nodes, const Curve& multiplier, const Curve& opposite,
                                        const Model& model);

}  // namespace mortise
