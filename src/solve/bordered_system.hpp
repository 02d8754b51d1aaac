// The bordered matrix of some unknowns: what BorderedCholesky factorises.
#pragma once

#include "solve/bordered_cholesky.hpp"
#include "solve/saddle_point_system.hpp"

namespace mortise {

/// The system on the free unknowns, dimensionless, as BorderedCholesky wants it: the border is the rows of B and one
/// unit row for each spring.
struct BorderedSystem {
  SparseMatrix matrix;
  std::vector<int> free;    ///< reduced -> full
  std::vector<int> blocks;  ///< reduced -> node, densely numbered
};

BorderedSystem bordered_system(const SaddlePointSystem& system);

/// The same of a part of the bodies: `left_out` unknowns, n, as if they were prescribed, and springs at `grounded`.
BorderedSystem bordered_system(const SaddlePointSystem& system, const std::vector<char>& left_out,
                               const std::vector<int>& grounded);

}  // namespace mortise
