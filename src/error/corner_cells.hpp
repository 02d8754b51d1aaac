// What recovered stresses do not see of the error about places where the stress has no limit: docs/theory.md, section
// 14.
#pragma once

#include "error/estimate_memory.hpp"
#include "error/pressure_estimate.hpp"

namespace mortise {

/// Of both bodies the cells that touch a point of contact where the stress has no limit, and those next to them, each
/// once.
std::vector<int> cells_at_contact(const Mesh& mesh, const SideTable& table, const std::vector<ContactPair>& pairs,
                                  const std::vector<PressureEstimate>& pressures);
/// These, and the same at the bodies' own corners.
std::vector<int> cells_at_corners(const Problem& problem, const std::vector<PressureEstimate>& pressures,
                                  EstimateMemory& memory);

/// Of F functionals what these cells do to each beyond what recovered stresses tell: `parts` (cells x F) as of
/// ErrorProducts; no signs. A polynomial over a patch does not turn about a place as the stress does: of the energy's
/// true error it showed 0.33 in the cells at a punch's corners, 3-node triangles, and 0.53 in those next to them. Of
/// quadratic cells the same once more is enough.
VecX unseen_at_corners(const Mesh& mesh, const std::vector<int>& cells, const MatX& parts);

}  // namespace mortise
