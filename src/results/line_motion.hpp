// How far the contact line of a pair has moved, against the small displacements that its equations take.
#pragma once

#include <optional>
#include <vector>

#include "problem/contact_pair.hpp"
#include "results/contact_results.hpp"

namespace mortise {

/// A loaded place of a contact line, and how it has moved.
struct PlaceMotion {
  Vec2 position;     ///< on the multiplier side
  double p, ds, dA;  ///< |p|, length and length times depth that the place stands for
  Vec2 facing;       ///< the place of the opposite side
  Vec2 u, facing_u;  ///< how far either has moved, the former without its curve's spin
  double slid;       ///< how far they slide along one another, with its sign
  double curved;     ///< how far they move against one another, over the line's radius of curvature; of rings also
                     ///< along the normal, over that of the line's circle round the axis
  double turned;     ///< radians: the turn of the edge of either side, the larger
  double stretched;  ///< by which part of its length that edge grows or shrinks, the larger
  int patch = 0;     ///< of loaded places one behind another, counted from 0; what lies apart slides by itself
};

/// Places with less than a thousandth of the pair's largest pressure are not loaded; tension loads bonded pairs as
/// pressure does, contact not at all. A multiplier side that is a whole circle may spin: that takes it and its normals,
/// along which contact acts, along themselves, so that gaps and p are what they were (hardly anything holds a roller
/// against it). `u`: all displacements, two a node.
std::vector<PlaceMotion> place_motions(const Points& nodes, const ContactPair& pair, const ContactResults& contact,
                                       const VecX& u);

/// What the spin of a curve that is a whole circle moves its nodes by; nothing of others.
std::vector<std::pair<int, Vec2>> moved_by_spin(const Points& nodes, const Curve& curve, const VecX& u);

/// Means over the loaded part of a pair's contact line, weighted with the force of each place: a singular corner, whose
/// surroundings turn by more on every finer mesh, carries little of it. Contact is written on the undeformed bodies, so
/// each is about the part by which contact forces and their places are off.
struct LineMotion {
  double turned;   ///< radians: the turn of either side (the larger) that is nearest to its motion in least squares
  double slid;     ///< how far the sides slide along one another, over the loaded length: of the patch that loses most
  Vec2 slid_at;    ///< the middle of that patch
  double shifted;  ///< the part of p, in L2, that such slides of each patch put in a wrong place: more where p ends
                   ///< within a curve
  double slid_as_one, shifted_as_one;  ///< both as if its patches were one: a small one may slide by all of its length
                                       ///< and leave p as it is, as a rim that moves along a straight wall
  double curved;  ///< how far they move against one another, over the line's radius of curvature: a turn of the normals
  double
      strained;   ///< the part of the force that is lost where edges turn (by the square) or stretch: at most all of it
  Vec2 position;  ///< the middle of what is loaded
  double norm;    ///< root of the integral of p^2 dA, stress times root of length times depth
};

/// Nothing where no place is loaded.
std::optional<LineMotion> line_motion(const Points& nodes, const ContactPair& pair, const ContactResults& contact,
                                      const VecX& u);

}  // namespace mortise
