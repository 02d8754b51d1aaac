// The interface between two groups of bodies: the equation of its pressure, and the iterations that solve it.
#pragma once

#include <cmath>
#include <memory>

#include "ddm/body_group.hpp"
#include "preprint_solvers/relaxation.hpp"
#include "solve/multiplier_system.hpp"

namespace mortise {

/// What a group does on some rows, as BodyGroup.
struct GroupRows {
  MatX C, H;
  VecX response, work;
};

/// Closed rows, and the gaps that the multipliers lambda leave of them: (C_N + C_D) lambda + H mu = gap with
/// H^T lambda = work closes them (docs/theory.md eq. 31). Dimensionless, as BodyGroup.
struct Interface {
  GroupRows neumann;    ///< takes the pressure
  GroupRows dirichlet;  ///< takes the displacement
  VecX gap;             ///< open without pressure, initial gaps and prescribed displacements included
  VecX gap0;            ///< the part of it that is not the groups' response
  VecX scale;           ///< lambda over it is what is compared with other rows'
  MatX H;               ///< rigid motions, the Neumann group's first
  VecX work;
  /// [C_D H; H^T .]: the multipliers with which the Dirichlet group closes a gap.
  std::shared_ptr<const MultiplierSystem> dirichlet_closed;
};

/// Of the rows `closed`; `gap0` and `scale` of all rows.
Interface make_interface(const BodyGroup& neumann, const BodyGroup& dirichlet, const VecX& gap0, const VecX& scale,
                         const std::vector<int>& closed);

/// An iteration x := x + beta z(x) for the interface, which its functions refer to.
struct InterfaceIteration {
  /// -1, or the closed row that others imply in a group which takes a displacement (that group does not feel the row by
  /// itself): nothing below is given then.
  int dependent_row = -1;
  std::function<VecX(const VecX& lambda)> start;   ///< x, from multipliers that are near the solution or zero
  Correction correction;                           ///< z(x)
  std::function<VecX(const VecX& x)> multipliers;  ///< lambda of an iterate
};

/// x = lambda; z = r - lambda, r the multipliers that the Dirichlet group takes where the Neumann group has moved under
/// lambda (Aronov & Rodin 2019, section 5; Toselli & Widlund 2005, section 1.3.3).
InterfaceIteration neumann_dirichlet(const Interface& interface);

/// x = B u of the Neumann group, which closed contact gives the other too; z = both groups' displacements, weighted,
/// under the jump of the multipliers (Toselli & Widlund 2005, section 1.3.4; balanced for floating bodies: Mandel
/// 1993).
InterfaceIteration neumann_neumann(const Interface& interface);

/// x = lambda; z = both groups' multipliers, weighted, under the gap that lambda leaves (Toselli & Widlund 2005,
/// section 1.3.5: FETI with the Dirichlet preconditioner, Farhat & Roux 1991).
InterfaceIteration dirichlet_dirichlet(const Interface& interface);

InterfaceIteration make_iteration(Scheme scheme, const Interface& interface);

/// The Dirichlet group's multipliers after the Neumann group has moved under lambda, and the motions of the floating
/// bodies.
struct DirichletSolution {
  VecX lambda, mu;
};

DirichletSolution solve_dirichlet(const Interface& interface, const VecX& lambda);

/// Of lambda, where the Dirichlet group takes lambda + z. Force: largest z over the largest multiplier (each over its
/// row's scale); kinematic: the largest gap that lambda leaves, C_D z, or lambda + z does, C_N z, over the largest
/// normal displacement.
Residuals residuals(const Interface& interface, const VecX& lambda, const VecX& z);

/// Ends of the spectrum of an iteration's x -> z(0) - z(x), by 25 steps of Arnoldi's method: with a fixed beta
/// a step multiplies the error by up to max |1 - beta eigenvalue|.
struct Spectrum {
  double smallest = 0, largest = 0;  ///< 0: not estimated

  double best_beta() const { return 2 / (smallest + largest); }
  double largest_beta() const { return 2 / largest; }  ///< beta must be below
  double convergence_rate(double beta) const {
    return std::max(std::abs(1 - beta * smallest), std::abs(1 - beta * largest));
  }
};

Spectrum spectrum(const InterfaceIteration& iteration, Eigen::Index rows);

}  // namespace mortise
