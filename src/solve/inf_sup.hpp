// How well the multipliers are controlled by the displacements: the inf-sup constant of a mesh.
#pragma once

#include "solve/bordered_system.hpp"

namespace mortise {

/// The smallest eigenvalue beta^2 of B K^-1 B^T q = beta^2 S q over the multipliers q that do no work on motions which
/// only contact holds: the numerical inf-sup test (Chapelle & Bathe 1993; docs/theory.md eq. 41).
struct InfSup {
  double beta = 0;
  VecX mode;  ///< m: the q of it, largest entry 1; zero on rows that are not active. Empty if no row is active
};

/// `norm`: S, m x m, length^2 / stress. `active`: m, rows that take part. The stiffness must have proved positive
/// definite, and the active rows independent (solve_directly).
InfSup inf_sup(const SaddlePointSystem& system, const SparseMatrix& norm, const std::vector<char>& active);

}  // namespace mortise
