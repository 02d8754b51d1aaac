// Where along a contact line the corners of the bodies do what the windows' means tell of them: docs/theory.md, section
// 14.
#pragma once

#include "error/corner_tails.hpp"
#include "error/pressure_windows.hpp"

namespace mortise {

/// What a corner near a window does to p there: amplitude r^(-1 - exponent), r the distance from the corner; within the
/// cells at the corner, which show no such shape, what it is at their radius. Its mean over the window is the corner's
/// tail.
struct LocalTail {
  Vec2 position;
  double exponent;
  double radius;  ///< of the cells at the corner, length
  int window;     ///< of the pair
  double amplitude;

  double at(const Vec2& x) const;
};

/// Of one pair.
struct TailShares {
  VecX means;                    ///< of each window, stress: of all corners too far away to show a shape
  std::vector<LocalTail> local;  ///< of the others
};

/// What the bodies' own corners do to the windows' means.
struct CornerTails {
  std::vector<CornerRings> corners;  ///< but for those that contact reaches
  MatX parts;                        ///< corners x duals, stress, without sign
  MatX goal;                         ///< corners x components of what is asked for, likewise
  VecX norms;                        ///< of each corner: of the p that it makes along all lines, stress length^(1/2)
};

/// The lines of all pairs with their windows, as `windows` numbers them. Sets tails.norms. Time as the corners times
/// the duals and the windows near them.
std::vector<TailShares> tail_shares(const Mesh& mesh, const std::vector<const PressureLine*>& lines,
                                    const std::vector<const std::vector<PressureWindow>*>& windows,
                                    const SharedDuals& duals, CornerTails& tails);

}  // namespace mortise
