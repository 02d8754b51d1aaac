// p*: the pressure of a pair, closer than its multiplier has it, from the same solve. docs/theory.md, section 14.
#pragma once

#include <vector>

#include "error/pressure_estimate.hpp"
#include "error/pressure_form.hpp"
#include "problem/problem.hpp"

namespace mortise {

/// p* between two places of a line, where it is credible.
struct FittedPiece {
  PressureForm form;
  std::array<double, 2> vertices;  ///< s of the first and the last vertex that has p* and not the multiplier
  double fluid = 0;                ///< pressure of the fluid beside it, from which p rises
};

struct FittedPressure {
  std::vector<FittedPiece> pieces;  ///< by s
  double around = 0;                ///< length of a closed curve, whose s goes on beyond its first vertex; else 0

  /// p* at s of the line, stress; nothing where p is the multiplier's.
  std::optional<double> at(double s) const;
};

/// Of a pair with linear multipliers between bodies that do not give way on their surface; of others no piece, and none
/// that has fluid on one side alone. p* of a
/// piece is credible if it differs from p_h, at 95 % of the vertices that count, by no more than p_h may miss along the
/// line as the estimate has it, the bodies' errors apart, and is nowhere tension in a unilateral pair. Time as the
/// vertices.
FittedPressure fitted_pressure(const Problem& problem, const ContactPair& pair, const PressureEstimate& estimate);

}  // namespace mortise
