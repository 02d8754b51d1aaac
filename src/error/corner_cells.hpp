// What recovered stresses do not see of the error about places where the stress has no limit: docs/theory.md, section
// 14.
#pragma once

#include "error/estimate_memory.hpp"
#include "error/pressure_estimate.hpp"

namespace mortise {

/// Cells that touch a place where the stress has no limit, and those next to them, each once.
std::vector<int> cells_at_corners(const Mesh& mesh, const SideTable& table, const std::vector<BodyCorner>& corners);
/// Where contact has such a place, of both bodies.
std::vector<int> cells_at_contact(const Mesh& mesh, const SideTable& table, const std::vector<ContactPair>& pairs,
                                  const std::vector<PressureEstimate>& pressures);
/// Both.
std::vector<int> cells_at_corners(const Problem& problem, const std::vector<PressureEstimate>& pressures,
                                  EstimateMemory& memory);

/// Of F functionals what the errors of these cells do to each beyond what recovered stresses tell, `parts` (cells x F)
/// of each cell, without sign. A polynomial over a patch follows no stress that turns about a place: of bodies that
/// displacements drive the part of the energy's error in both rings of cells was 2 to 4 times that, of 3-node
/// triangles, and up to 2 times of quadratic cells.
VecX unseen_at_corners(const Mesh& mesh, const std::vector<int>& cells, const MatX& parts);

}  // namespace mortise
