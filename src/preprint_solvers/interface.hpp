// The interface between two groups of bodies: the equation of its pressure, and the iterations that solve it.
#pragma once

#include <cmath>
#include <memory>

#include "ddm/body_group.hpp"
#include "preprint_solvers/relaxation.hpp"
#include "solve/active_set.hpp"

namespace mortise {

/// The gaps that the multipliers lambda leave, (C_N + C_D) lambda + H mu = gap with H^T lambda = work closing it
/// (docs/theory.md eq. 31). Dimensionless, as BodyGroup.
struct Interface {
  BodyGroup neumann;    ///< takes the pressure
  BodyGroup dirichlet;  ///< takes the displacement
  VecX gap;             ///< m: open without pressure, initial gaps and prescribed displacements included
  VecX gap0;            ///< m: the part of it that is not the groups' response
  MatX H;               ///< m x s: rigid motions, the Neumann group's first
  VecX work;            ///< s
  /// The multipliers with which the Dirichlet group closes a gap: [C_D H; H^T .] and which rows may open; and its
  /// solution with all rows closed.
  ComplementarityProblem dirichlet_problem;
  std::shared_ptr<const MultiplierSystem> dirichlet_closed;
};

/// An iteration's `dependent_row` must be asked before anything else is.
Interface make_interface(BodyGroup neumann, BodyGroup dirichlet, const SaddlePointSystem& system);

/// An iteration x := x + beta z(x) for the interface, which its functions refer to.
struct InterfaceIteration {
  /// -1, or a row of B that others imply in a group which takes a displacement (that group does not feel the row by
  /// itself): nothing below is given then.
  int dependent_row = -1;
  VecX start;
  Correction correction;                           ///< z(x)
  std::function<VecX(const VecX& x)> multipliers;  ///< lambda of an iterate
};

/// Which contact an iteration or a body solves: all rows closed, or those open that may be.
enum class Rows { closed, unilateral };

/// x = lambda; z = r - lambda, r the multipliers that the Dirichlet group takes where the Neumann group has moved under
/// lambda (Aronov & Rodin 2019, section 5; Toselli & Widlund 2005, section 1.3.3). With unilateral rows the Dirichlet
/// group is in unilateral contact with the moved Neumann group (Krause & Wohlmuth 2002).
InterfaceIteration neumann_dirichlet(const Interface& interface, Rows rows);

/// The same with the closed rows kept: those of `closed`, a system of [C_D H; H^T .]. x is zero on the other rows.
InterfaceIteration neumann_dirichlet(const Interface& interface, MultiplierSystem closed, VecX start);

/// x = B u of the Neumann group, which closed contact gives the other too; z = both groups' displacements, weighted,
/// under the jump of the multipliers (Toselli & Widlund 2005, section 1.3.4; balanced for floating bodies: Mandel
/// 1993). Bilateral.
InterfaceIteration neumann_neumann(const Interface& interface);

/// x = lambda; z = both groups' multipliers, weighted, under the gap that lambda leaves (Toselli & Widlund 2005,
/// section 1.3.5: FETI with the Dirichlet preconditioner, Farhat & Roux 1991). Bilateral.
InterfaceIteration dirichlet_dirichlet(const Interface& interface);

/// The Dirichlet group's multipliers after the Neumann group has moved under lambda.
struct DirichletSolution {
  VecX lambda, mu;           ///< m, s: its multipliers, and the motions of the floating bodies
  std::vector<char> active;  ///< m: its closed rows; empty: all
  bool held = true;          ///< false: contact opens until nothing holds a body; lambda is not a number then
  std::optional<MultiplierSystem> closed;  ///< [C_D H; H^T .] on the closed rows, of Rows::unilateral
};

/// `start`: closed rows to start from, of Rows::unilateral.
DirichletSolution solve_dirichlet(const Interface& interface, Rows rows, const VecX& lambda,
                                  const std::vector<char>& start = {});

/// Of lambda, where the Dirichlet group takes lambda + z. Force: largest z over the largest multiplier (each over its
/// row's scale); kinematic: the largest gap that lambda leaves, C_D z, or lambda + z does, C_N z, over the largest
/// normal displacement.
Residuals residuals(const Interface& interface, const VecX& lambda, const VecX& z);

/// Ends of the spectrum of a bilateral iteration's x -> z(0) - z(x), by 25 steps of Arnoldi's method: with a fixed beta
/// a step multiplies the error by up to max |1 - beta eigenvalue|.
struct Spectrum {
  double smallest = 0, largest = 0;  ///< 0: not estimated

  double best_beta() const { return 2 / (smallest + largest); }
  double largest_beta() const { return 2 / largest; }  ///< beta must be below
  double convergence_rate(double beta) const {
    return std::max(std::abs(1 - beta * smallest), std::abs(1 - beta * largest));
  }
};

Spectrum spectrum(const InterfaceIteration& iteration);

}  // namespace mortise
