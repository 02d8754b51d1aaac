// Contact pairs that find themselves.
#pragma once

#include <array>
#include <map>
#include <optional>

#include "mesh/curve.hpp"

namespace mortise {

/// How far apart curves may be that face each other.
struct Nearness {
  std::optional<double> within;  ///< length; none: half the mean edge of the shorter ones
  bool as_one_curve =
      false;  ///< without a length: no more than two meshes of one curve show (contact/curve_resolution)
};

/// Pairs of boundaries, one of each side, whose curves belong to two bodies and face each other somewhere: along a
/// normal of one, at an edge's middle or an end's quarter, the other is near and not almost at a right angle. By the
/// first, then the second; each two boundaries once. `curves`: of all boundaries of both sides. Time as the curves and
/// what is near each.
std::vector<std::array<int, 2>> facing_pairs(const Mesh& mesh, const std::map<int, Curve>& curves,
                                             const std::array<std::vector<int>, 2>& sides, const Nearness& near);

}  // namespace mortise
