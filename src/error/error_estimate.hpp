// How far a solution is from that of the problem: the stresses in the energy norm, the contact pressure node by node.
#pragma once

#include "contact/williams.hpp"
#include "error/border_overlaps.hpp"
#include "error/contact_reach.hpp"
#include "error/energy_estimate.hpp"
#include "error/estimate_memory.hpp"
#include "error/goal_estimate.hpp"
#include "error/pressure_estimate.hpp"
#include "error/shared_duals.hpp"
#include "mesh/body_points.hpp"
#include "model/method.hpp"

namespace mortise {

/// What the bodies' error does to the windows' means, cell by cell.
struct FarField {
  MatX parts;           ///< cells x duals, those of windows, then of fluctuations: int d_0 : C^-1 : d_k, stress
  SharedDuals windows;  ///< of all pairs, one after the other, and which of them the parts count for
  WindowOverlaps overlaps;
};

struct ErrorEstimate {
  EnergyEstimate energy;
  std::vector<PressureEstimate> pressures;  ///< one a pair
  FarField far;
  CornerTails tails;
  std::optional<GoalEstimate> goal;  ///< where one is asked for
  FoundDuals also;                   ///< of further functionals; corners and overlaps are in their sums
  MatX data_works;                   ///< misfits of data x (duals as of far.parts, then the goal's): data_works.hpp

  /// L2 norms of the estimated error of p over that of p on all contact lines, singular points left out: of the whole,
  /// and of its two parts before the safety factor. NaN where nothing is loaded or all is excluded.
  double pressure() const;
  double pressure_of(const std::vector<std::size_t>& pairs) const;  ///< likewise, of these pairs alone
  double line() const;
  double slopes() const;  ///< the line's part without what p swings by
  double far_field() const;
  VecX overlaps() const;  ///< of the latter the parts that are at the borders of each pair
  /// Of the largest pressure its bar, or by how much p may be more elsewhere, relative; of half the width of a contact
  /// the edges on which it ends, whose relative length is the largest: 0 where contact ends nowhere within a line.
  double peak() const;
  double half_width() const;
  double pressure_square() const;  ///< of p on these, stress^2 length
};

struct EstimateOptions {
  AccuracySpec spec = {};              ///< what is left out of the norm, and a functional that is asked for
  int own_duals = most_own_duals;      ///< as most_own of share_duals
  std::vector<FoundPoint> found = {};  ///< singular points of earlier meshes, which stay
  MatX also = {};                      ///< m x F: functionals whose duals are wanted besides
};

/// `solution`: converged or not; where it has no factor (iterative solvers) the whole system is factorised once. Throws
/// SceneError as goal_functionals does.
ErrorEstimate estimate_error(const Problem& problem, const Solution& solution, EstimateMemory& memory,
                             const EstimateOptions& options = {});

}  // namespace mortise
