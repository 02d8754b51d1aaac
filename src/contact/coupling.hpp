// The coupling of one contact pair: B u + gap0 = 0 closes the gap in the sense of the multiplier space.
#pragma once

#include <string>
#include <vector>

#include "contact/segments.hpp"
#include "fem/constraints.hpp"

namespace mortise {

struct CouplingOptions {
  Multipliers multipliers = Multipliers::linear;
  InitialGap initial_gap = InitialGap::measured;
};

/// A multiplier that was left out or tied to its neighbour, and why.
struct DroppedMultiplier {
  int node;            ///< of the mesh
  std::string reason;  ///< to be read after "40 multipliers"
};

/// Multipliers sit at nodes of the multiplier side; lambda = sum_a psi_a lambda_a (docs/theory.md eq. 10 to 12). Row r
/// of B belongs to all multipliers a with row[a] == r.
struct Coupling {
  SparseMatrix B;                           ///< rows x degrees of freedom: int psi (u_opposite - u_multiplier) . n ds
  VecX gap0;                                ///< rows: int psi g0 ds, length^2; zero where the gap is closed
  VecX scale;                               ///< rows: int |psi| ds, length
  std::vector<int> node;                    ///< multiplier -> node of the mesh
  std::vector<int> row;                     ///< multiplier -> row of B, or -1: no support, lambda = 0
  std::vector<std::array<int, 3>> on_edge;  ///< edge of the multiplier side -> its multipliers, -1 where none
  double covered_length = 0;                ///< of the multiplier side, where it faces the opposite side
  double gap_min = 0, gap_max = 0;          ///< undeformed, over all contact points
  std::vector<DroppedMultiplier> dropped;
};

/// Throws InputError if the curves do not face each other anywhere.
Coupling couple(const Mesh& mesh, const Curve& multiplier, const Curve& opposite,
                const std::vector<ContactPoint>& points, const Constraints& constraints,
                const CouplingOptions& options);

/// For each row the node of its first multiplier.
std::vector<int> row_nodes(const Coupling& coupling);

/// Multipliers from the rows' values: value[row[a]], zero without support.
VecX multiplier_values(const Coupling& coupling, const VecX& row_values);

/// The multipliers' values interpolated at a point of the multiplier side with the Lagrange functions of their nodes,
/// also where psi is dual (its own functions jump between edges).
double interpolate(const Coupling& coupling, const Curve& multiplier, const VecX& values, int edge, double xi);

}  // namespace mortise
