// The coupling of a contact pair, as data.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/types.hpp"

namespace mortise {

/// A multiplier that was left out or tied to its neighbour, and why.
struct DroppedMultiplier {
  int multiplier;      ///< in Coupling::node
  std::string reason;  ///< to be read after "40 multipliers"
  bool faces;          ///< the other side, and was left out all the same
  bool by_mesh;        ///< as of this mesh's edges: bars of p know it
};

/// Multipliers sit at nodes of the multiplier side; lambda = sum_a psi_a lambda_a (docs/theory.md eq. 10 to 12). Row r
/// of B belongs to all multipliers a with row[a] == r.
struct Coupling {
  SparseRows B;                             ///< rows x degrees of freedom: int psi (u_opposite - u_multiplier) . n dA
  SparseRows own;                           ///< the multiplier side's part of B: both sides share the tip of a crack
  VecX gap0;                                ///< rows: int psi g0 dA, length dA; zero where the gap is closed
  VecX scale;                               ///< rows: int |psi| dA, dA = ds times depth (model/model.hpp)
  std::vector<int> node;                    ///< multiplier -> node of the mesh
  std::vector<int> row;                     ///< multiplier -> row of B, or -1: no support, lambda = 0
  std::vector<std::array<int, 3>> on_edge;  ///< edge of the multiplier side -> its multipliers, -1 where none
  double covered_length = 0;                ///< of the multiplier side, where it faces the opposite side
  double gap_min = 0, gap_max = 0;          ///< undeformed, over all contact points
  std::vector<DroppedMultiplier> dropped;
};

}  // namespace mortise
