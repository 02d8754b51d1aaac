// The equations of a scene, solved by the solver that it names.
#pragma once

#include "problem/problem.hpp"
#include "solve/direct.hpp"

namespace mortise {

/// The one that is named; else feti where three parts or more hang together by contact alone and it is faster than the
/// direct solver's dense compliance: rows that are many for the parts' unknowns. Else direct.
Solver solver_for(const Method& method, const SaddlePointSystem& system);

/// Solves one system under as many loads as come.
class SystemSolver {
 public:
  /// Keeps a reference. f, g, the prescribed values and the rows to start from may change between solves; by the direct
  /// solver all have one factor.
  explicit SystemSolver(const Problem& problem)
      : mesh_(problem.mesh),
        method_(problem.method),
        system_(problem.discretisation.system),
        dirichlet_(problem.dirichlet) {}

  /// By the direct solver after all where nobody named feti and it does not converge.
  Solution solve();

 private:
  Solution solve_layered(const SaddlePointSystem& system);
  Solution solve_independent(const SaddlePointSystem& system);
  Solution solve_by_factor(const SaddlePointSystem& system);

  const Mesh& mesh_;
  const Method& method_;
  const SaddlePointSystem& system_;
  const std::vector<char>& dirichlet_;              // bodies
  std::unique_ptr<SaddlePointSystem> independent_;  // of one with multi-point constraints
  std::unique_ptr<SaddlePointSystem> layered_;      // of one with surface layers
  std::optional<DirectSolver> direct_;
};

/// Throws SceneError, with the place, where the solver found none: what SolveStatus says of it; EdgesTooLong of a load
/// that a finer mesh carries.
void require_solution(const Problem& problem, const Solution& solution);

}  // namespace mortise
