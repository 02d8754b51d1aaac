// The coupling of one contact pair: B u + gap0 = 0 closes the gap in the sense of the multiplier space.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "contact/coupling_rows.hpp"
#include "contact/segments.hpp"
#include "fem/constraints.hpp"

namespace mortise {

struct CouplingOptions {
  Multipliers multipliers = Multipliers::linear;
  InitialGap initial_gap = InitialGap::curve;  ///< closed: the points' gaps are left out
};

/// The rows of an interface that has its points. Throws InputError if the curves do not face each other anywhere.
Coupling couple(const Mesh& mesh, const ContactInterface& interface, const Constraints& constraints,
                const CouplingOptions& options);

/// For each row the node of its first multiplier.
std::vector<int> row_nodes(const Coupling& coupling);

/// Multipliers from the rows' values: value[row[a]], zero without support.
VecX multiplier_values(const Coupling& coupling, const VecX& row_values);

/// Forces of the rows' values on the nodes, -B^T row_values, times depth; by node. B: the coupling's, or its own.
std::map<int, Vec2> contact_forces(const SparseRows& B, const VecX& row_values);

/// The multipliers' values interpolated at a point of the multiplier side with the Lagrange functions of their nodes,
/// also where psi is dual (its own functions jump between edges).
double interpolate(const ContactInterface& interface, const VecX& values, const Place& at);

}  // namespace mortise
