// Which forces equilibrium fixes.
#pragma once

#include <optional>

#include "base/dense.hpp"
#include "mesh/body_points.hpp"
#include "solve/saddle_point_system.hpp"

namespace mortise {

/// Of unknown i in a motion by 1 of component c: along x, y, or a turn about the centre.
double unit_motion(const Mesh& mesh, int i, int c, const Vec2& centre);

/// Whether equilibrium fixes a force: a rigid motion of the bodies opens the rows as the functional asks, and moves
/// nothing that is prescribed.
class Statics {
 public:
  /// Of the system B, the row scales and what is fixed count, but for unknowns at which idle motions are held: these
  /// bear nothing.
  Statics(const Mesh& mesh, const BodyPoints& points, const SaddlePointSystem& system, const std::vector<int>& idle);

  /// That motion, n; `rows`: by how much they are to open.
  std::optional<VecX> motion(const VecX& rows) const;

 private:
  VecX row_scale_;
  MatX motions_, all_;  // n x motions; of these what is held at zero
  std::optional<LeastSquares> factor_;
};

}  // namespace mortise
