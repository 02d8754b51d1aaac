// What cells about the tip of a crack do to a window's mean.
#pragma once

#include "error/pressure_estimate.hpp"

namespace mortise {

/// Of each cell the ring about a tip at which p_h swings (SingularPoint::is_swinging) that it lies in, numbered from 0;
/// -1 of others. Empty where there is no such tip.
std::vector<int> tip_rings(const Mesh& mesh, const std::vector<PressureEstimate>& pressures);

/// As off_by(parts), but for the cells of a ring: they err by one field, the tip's, which a dual sees with both signs.
VecX off_by(const MatX& parts, const std::vector<int>& rings);

}  // namespace mortise
