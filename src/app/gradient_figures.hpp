// Figures of a solution as functions of it.
#pragma once

#include "results/results.hpp"

namespace mortise {

/// A figure by its column of cases.csv: "energy", "probe.I.u_x" or "u_y", "contact.K.force.x" or "y",
/// "contact.K.pressure.mean" of all that faces the other side; with two `numbers` the mean over a window, from and to
/// (s as in contact.csv, length). "contact.K.pressure.norm" with one, a power from 1 to 1000: (int p^power dA / int
/// dA)^(1 / power).
struct Figure {
  std::string name;
  std::vector<double> numbers;
};

struct LinearisedFigure {
  double value;
  VecX by_u, by_lambda;    ///< n and m: its derivatives
  bool is_energy = false;  ///< which the parameters change besides, at the same u
};

/// Throws InputError where there is none of that name, or it needs other numbers.
LinearisedFigure linearised(const Results& results, const Figure& figure);

}  // namespace mortise
