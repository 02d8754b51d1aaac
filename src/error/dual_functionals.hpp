// The functionals of p whose dual solutions an estimate asks for.
#pragma once

#include "error/pressure_estimate.hpp"
#include "error/shared_duals.hpp"
#include "problem/problem.hpp"

namespace mortise {

/// In the rows of all pairs a column a dual: those that the windows share, each the sum of their weights; the
/// fluctuation of each pair that has one; those of `also`; the goals.
MatX dual_functionals(const Problem& problem, const std::vector<PressureEstimate>& pressures,
                      const SharedDuals& windows, const MatX& also, const MatX& goals);

}  // namespace mortise
