// What a displacement and a stress at places are off by, beside the values themselves.
#pragma once

#include <span>

#include "error/error_estimate.hpp"
#include "fem/locate.hpp"

namespace mortise {

/// Places that are looked at together: points, or a line in its order.
struct ProbedPlaces {
  std::vector<CellPlace> in;
  std::vector<Vec2> x;         ///< undeformed
  std::vector<double> spread;  ///< largest difference of a recovered component from the averages at the nodes, stress
  double angle;                ///< of the axes of the stress, radians counter-clockwise
};

struct PlaceError {
  Vec2 u;                  ///< along x and y, length
  Eigen::Vector3d stress;  ///< 11, 22, 12 in the turned axes; NaN at a corner where stresses have no limit
};

/// As the errors of one displacement or stress that an accuracy is asked of (docs/theory.md, section 14): what the
/// cells' errors do to it by a dual of each component, and for a stress by what the elements' own differs from the
/// recovered one. Of more than 8 places duals are solved for 8 of them; between two of these the larger error counts,
/// and the difference of each place's own stresses. What the error of p on the pairs' lines does is a part of each
/// (error/line_part.hpp), and of stresses in a cell on a line the bar of p there. `solution`: as of estimate_error;
/// `pressures`: estimated, one a pair.
std::vector<PlaceError> place_errors(const Problem& problem, const Solution& solution,
                                     const std::vector<PressureEstimate>& pressures,
                                     const std::vector<ProbedPlaces>& probes, EstimateMemory& memory);

}  // namespace mortise
