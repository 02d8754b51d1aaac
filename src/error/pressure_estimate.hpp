// What is known of the pressure of one pair.
#pragma once

#include "contact/singular_points.hpp"
#include "error/pressure_fluctuation.hpp"
#include "error/pressure_form.hpp"
#include "error/pressure_windows.hpp"
#include "error/tail_shares.hpp"

namespace mortise {

/// What is seen of the error that is asked: squares add up, to a tenth more.
inline constexpr double seen_of_asked = 1. / 3;

/// What the pressure of a pair is off by (docs/theory.md eq. 45 to 48): the local error of a piecewise linear function
/// along the line, and what the bodies' far field makes of it, seen by dual solutions of windowed means.
struct PressureEstimate {
  PressureLine line;
  LineError local;
  FittedPressure fitted;  ///< the pressure that is reported, where it is nearer
  std::vector<PressureWindow> windows;
  VecX far;  ///< of each window's mean, stress: what the cells' parts make it off by, and the sum of tails.means
  std::optional<PressureFluctuation> fluctuation;  ///< what they do not see, where each has a dual of its own
  TailShares tails;                                ///< what the mesh misses at the bodies' corners
  VecX bar;                                        ///< of p at each vertex of `line`, stress
  std::vector<SingularPoint> singular;             ///< of its loaded part
  std::vector<SingularPoint> weak;                 ///< likewise, where p goes as a small power: left out nowhere
  /// Of each vertex, whether p_h swings there from node to node however short the edges, which the line's own error
  /// tells.
  std::vector<char> swings;
  std::vector<double> left_out;  ///< of each of `singular`, length: p nearer to it is left out of the norm; 0: none is
  std::vector<char> excluded;    ///< of each vertex, whether p is left out there
  /// Squares of L2 norms along what is not excluded, stress^2 length: of the local error, the far field's and p. Where
  /// p is known at no vertex better than to its own size, the local error is no less than that.
  double local2 = 0, far2 = 0, p2 = 0;

  /// Whether a vertex is in these.
  bool counts(Eigen::Index i) const {
    return line.loaded[i] && !excluded[i] && !(line.closed && i == line.p.size() - 1);
  }
};

/// The singular point of contact at a place, nearer than this part of its edge; null where there is none.
inline const SingularPoint* singular_point_at(
    const std::vector<PressureEstimate>& pressures, const Vec2& place, double part_of_edge,
    std::vector<SingularPoint> PressureEstimate::*points = &PressureEstimate::singular) {
  for (const PressureEstimate& e : pressures)
    for (const SingularPoint& point : e.*points)
      if ((point.position - place).norm() < part_of_edge * point.edge) return &point;
  return nullptr;
}

}  // namespace mortise
