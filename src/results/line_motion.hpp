// How far the contact line of a pair has moved as a whole, against the small displacements that its equations take.
#pragma once

#include <optional>

#include "problem/contact_pair.hpp"
#include "results/contact_results.hpp"

namespace mortise {

/// Means over the loaded part of a pair's contact line, weighted with the force of each place: a singular corner, whose
/// surroundings turn by more on every finer mesh, carries little of it. Contact is written on the undeformed bodies, so
/// each is about the part by which contact forces and their places are off.
struct LineMotion {
  double turned;  ///< radians: the turn of either side (the larger) that is nearest to its motion in least squares
  double slid;    ///< how far the sides slide along one another, over the loaded length
  double curved;  ///< how far they move against one another, over the line's radius of curvature: a turn of the normals
  Vec2 position;  ///< the middle of what is loaded
  double norm;    ///< root of the integral of p^2 dA, stress times root of length times depth
};

/// Places with less than a thousandth of the pair's largest pressure are not loaded. Nothing where none is.
std::optional<LineMotion> line_motion(const Points& nodes, const ContactPair& pair, const ContactResults& contact,
                                      const VecX& u);

/// Curvature of the line that each edge stands for, 1 / length, kinks left out.
std::vector<double> edge_curvatures(const Points& nodes, const Curve& curve);

}  // namespace mortise
