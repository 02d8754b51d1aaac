// The pressure of contact as the recovered stresses of the two bodies have it.
#pragma once

#include <array>

#include "error/pressure_swing.hpp"
#include "fem/patch_recovery.hpp"
#include "problem/problem.hpp"

namespace mortise {

/// The body points of both curves' vertices: where patches are needed.
std::vector<int> points_of_pair(const BodyPoints& points, const ContactPair& pair);

/// -n . sigma* . n at each node of the multiplier side, in its own body and where its normal meets the other one,
/// stress; NaN where it meets nothing.
std::array<VecX, 2> recovered_pressures(const Problem& problem, const StressPatches& patches, const ContactPair& pair,
                                        const PressureNodes& nodes);

/// The line of a pair, flags of its vertices that are left out, and the local error.
struct JudgedLine {
  const PressureLine& line;
  const std::vector<char>& excluded;
  LineError& local;
};

/// What p swings by at each vertex and the bodies do not: the least of the swing and of what p differs by from the
/// recovered stresses of either body, each a mean over nine nodes (docs/theory.md eq. 47a). Only where the swing is
/// more than the local error of some vertex are stresses recovered, beside the pairs' curves. Sets the swing of
/// `lines[k].local`, k the number of the pair. `known`: kept for the next solution on the mesh.
void add_swings(const Problem& problem, const VecX& u, const std::vector<JudgedLine>& lines,
                std::optional<LocalRecovery>& known);

}  // namespace mortise
