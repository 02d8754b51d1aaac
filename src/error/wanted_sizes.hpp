// From where the error sits to the element sizes of the next mesh.
#pragma once

#include "error/error_estimate.hpp"
#include "mesh/size_field.hpp"

namespace mortise {

/// Elements grow by this part of the way away from where they must be small: neighbours differ by a half at most.
/// Around a border of contact, where u is as r^(3/2), the best sizes of 6-node triangles grow as r^(1/2), faster than
/// any such limit: it is there for the triangles' shape. With 0.3 the same error takes 1.6 times as many unknowns.
inline constexpr double size_growth = 0.5;

/// By which line() and far_field() of an estimate are to fall, and the error of p that is aimed at with that.
struct ErrorFactors {
  double line, far_field;
  double target;
  double border = 0;     ///< by which the edges are to shorten on which contact ends; 0: as the line's error asks
  double overlaps = 1;   ///< by which what overlaps at borders do to p elsewhere is to fall
  double goal_line = 1;  ///< of another functional than p by which what the lines do to it is to fall
};

struct WantedSizes {
  VecX sizes;  ///< one a node, length; of vertices
  /// Towards singular points and borders of contact whose place is known, and on the other side of other borders.
  std::vector<SizeLayers> layers;
};

/// The sizes with the fewest elements (docs/theory.md eq. 49, 50): the far field by each cell's part, which falls as
/// h^6; the local error by each vertex's, h^2.5; the border of contact in proportion; of another functional what each
/// vertex does to it, h^5, and each border, h^2; layers towards singular points so
/// small that what they do to p elsewhere is a part of the target. Elements may also grow.
WantedSizes wanted_sizes(const Mesh& mesh, const std::vector<ContactPair>& pairs, const ErrorEstimate& estimate,
                         const ErrorFactors& factors);

}  // namespace mortise
