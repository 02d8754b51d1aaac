// What a solution leaves beside the ends of contact: bodies that overlap between the means in which contact is held.
#pragma once

#include "error/pressure_estimate.hpp"
#include "problem/problem.hpp"
#include "solve/contact_factor.hpp"

namespace mortise {

/// What overlaps at borders do to the windows' means.
struct WindowOverlaps {
  VecX windows;  ///< of each of all pairs, one after the other, stress
  VecX pairs;    ///< what is at the borders of each: its norm over the windows, stress length^(1/2)
};

/// Contact is held in the mean over a hat. Where the hat's edges are short beside the contact nothing is left of the
/// gap between. At an end of contact, and the more where a contact is less than an edge wide, the bodies overlap in a
/// part of the edge and are open in the rest; in truth they touch, and are that overlap farther apart. What this does
/// to functionals of the solution no dual of the closed rows shows (docs/theory.md eq. 48f).
class BorderOverlaps {
 public:
  /// `each`: what the overlaps of each pair do is found by itself; else what all of them do is, one dual in the place
  /// of one a pair, and a pair's share is that of its overlaps, length^2.
  BorderOverlaps(const Problem& problem, const Solution& solution, const std::vector<PressureEstimate>& pressures,
                 bool each = true);

  /// By how much the functionals loads^T u - rows^T lambda change if all edges at which contact ends are opened by the
  /// largest overlap on them, as shares of the pairs: pairs x F, in the functionals' units, no sign. Posts of one kind
  /// under a beam that all overlap alike change no force. `loads`: of the last functionals (n a column), those before
  /// have none.
  MatX changes(const MatX& rows, const MatX& loads) const;
  WindowOverlaps of_windows(const std::vector<ContactPair>& pairs,
                            const std::vector<PressureEstimate>& pressures) const;
  /// What it does to the displacements, n = `unknowns`.
  VecX motion(Eigen::Index unknowns) const;

 private:
  MatX shares_;  // pairs x answers, the columns' sums are 1
  DualAnswers answers_;
};

}  // namespace mortise
