// What a gap that is given, or added, does within edges of the multiplier side.
#pragma once

#include "problem/contact_pair.hpp"

namespace mortise {

struct GapErrors {
  /// Of each edge, what p is off by in L2 along it, stress sqrt(length): a difference d of the gap from a parabola over
  /// a length l makes pressures of E* d / (2 l) there. Empty where the gap is resolved everywhere.
  VecX l2;
  VecX off;  ///< likewise, the difference at its largest, length
  /// Edges on which the gap jumps, and where: bodies meet at a step there, beside which p grows as at the corner of a
  /// punch, as r^-1/2.
  struct Jump {
    int edge;
    Vec2 position;
  };
  std::vector<Jump> jumps;
};

GapErrors gap_errors(const Mesh& mesh, const ContactPair& pair, const std::vector<ElasticLaw>& laws);

}  // namespace mortise
