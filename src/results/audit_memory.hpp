// What audits of solutions on one mesh share.
#pragma once

#include <memory>

#include "problem/audited_bodies.hpp"

namespace mortise {

/// An edge of the outlines, and another piece.
struct EdgeAndPiece {
  int edge, piece;
};

struct AuditMemory {
  std::unique_ptr<const AuditedBodies> bodies;  ///< none before the first audit
  /// Those that displacements up to a largest one may bring into one another where no pair stands between them.
  std::vector<EdgeAndPiece> may_cross;
  double up_to = 0;
  /// Pairs that patterns mean, at which bodies of the last solution go through one another.
  std::vector<KnownPair> missed;
};

}  // namespace mortise
