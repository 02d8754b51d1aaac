// Rows of contact whose closed ones are solved by an iteration between two groups of bodies.
#pragma once

#include "preprint_solvers/interface.hpp"
#include "solve/dense_rows.hpp"

namespace mortise {

/// All rows of two groups: what lambda leaves open of them, w = gap - C lambda - H mu with C = C_N + C_D. Its motions
/// are the Neumann group's first.
struct GroupPair {
  BodyGroup neumann, dirichlet;
  VecX gap0;  ///< open without the groups' response
  ComplementarityProblem problem;
  VecX rhs;  ///< gap and work
};

GroupPair group_pair(BodyGroup neumann, BodyGroup dirichlet, const SaddlePointSystem& system);

/// As FetiRows: each solve starts from the last multipliers, and is loose until no row changes.
class DdmRows : public DenseRows {
 public:
  /// Keeps references to both.
  DdmRows(const GroupPair& groups, const DdmOptions& options);

  Answer solve(const std::vector<char>& closed, const VecX& at) override;
  bool refine() override;
  void go_on_to(double tolerance) { asked_ = tolerance_ = tolerance; }  ///< below that of the options
  MatX free_motions() const override { return interface_.dirichlet_closed->rigid_modes(); }

  /// Of all solves.
  const std::vector<IterationStep>& history() const { return history_; }
  /// Of the last one.
  double beta() const { return beta_; }  ///< 0: none
  double convergence_rate() const { return convergence_rate_; }
  const Spectrum& interface_spectrum() const { return spectrum_; }  ///< zero where it was not needed
  Spectrum closed_spectrum() const;                                 ///< found now

 private:
  // From lambda to what the Dirichlet group takes in the end.
  SolveStatus iterate(const InterfaceIteration& iteration, VecX& lambda);
  RelaxationOptions relaxation(const InterfaceIteration& iteration);

  const GroupPair& groups_;
  const DdmOptions& options_;
  double asked_, tolerance_;
  VecX lambda_;
  Interface interface_;
  std::vector<IterationStep> history_;
  double beta_ = 0, convergence_rate_ = 0;
  Spectrum spectrum_;
};

}  // namespace mortise
