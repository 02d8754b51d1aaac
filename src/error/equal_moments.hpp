// p*, the contact pressure of the form that it has between the places where contact ends or p has no limit, with the
// moments of the multiplier.
#pragma once

#include "error/pressure_estimate.hpp"
#include "error/pressure_form.hpp"

namespace mortise {

/// Where contact ends within the line.
struct BorderPlace {
  Eigen::Index edge;  ///< on which that of the multiplier lies
  double length;      ///< in contact beyond the last vertex of it that the multiplier loads; negative: less
  Vec2 position;
  double bar;  ///< what it may be off by along the line, length
};

/// p* of one pair (docs/theory.md section 14). Edges and vertices as PressureLine numbers them.
struct EqualMoments {
  std::vector<PressureForm> forms;  ///< of the pieces that have one
  std::vector<int> form_of_edge;    ///< -1: p there is the multiplier's
  VecX start;                       ///< of each edge, arc length in its form
  VecX lengths;                     ///< of the edges
  VecX p, bar;                      ///< at the vertices, stress; where there is no p* the multiplier's and its bar
  std::vector<BorderPlace> borders;

  /// At a part `t` of an edge, from its start to its end. None where there is no form, or p* has no limit.
  std::optional<double> at(Eigen::Index edge, double t) const;
};

/// Pieces of which p* is not where the bar of the multiplier says that p is, or negative where contact is unilateral,
/// keep the multiplier.
EqualMoments equal_moments(const ContactPair& pair, Multipliers space, const Model& model,
                           const PressureEstimate& estimate);

}  // namespace mortise
