// Errors of a run against what is known of the problem.
#pragma once

#include "problems.hpp"

namespace mortise::chart {

/// At each end of the contact line this part of its length is left out of the errors that are called inner.
inline constexpr double left_out = 0.1;

/// All relative, NaN where nothing is known. Of p: of the multiplier side, against its own norm or largest value there.
struct RunErrors {
  double energy;  ///< energy norm
  double p_l2;    ///< whole contact line
  double p_l2_inner;
  double p_max_inner;  ///< over quadrature points and nodes
};

RunErrors run_errors(const Results& results, const Problem& problem);

/// x,p along the multiplier side by x: 16 points an edge of 3 nodes, the ends of one of 2 (p is linear between).
void write_pressure(const Results& results, const std::string& path);

}  // namespace mortise::chart
