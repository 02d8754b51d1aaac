// A contact curve: the edges of a boundary, strung into one chain.
#pragma once

#include <memory>
#include <vector>

#include "mesh/side_table.hpp"

namespace mortise {

class BodyOutline;  // mesh/thickness.hpp

/// Edges in the order and direction in which the body lies on the left, so that the outward normal is on the right.
/// edges[i].nodes[1] == edges[i+1].nodes[0].
struct Curve {
  int boundary;  ///< index into Mesh::boundaries
  int body;      ///< index into Mesh::bodies
  std::vector<Edge> edges;
  std::vector<CellSide> sides;         ///< the cell side of each edge
  bool closed;                         ///< the last edge ends where the first begins
  std::vector<EdgeSamples> samples{};  ///< of each edge, from its start to its end; empty: only the mesh is known
  /// Thickness of the body behind each edge, length (mesh/thickness.hpp); empty: not asked for, without limit.
  std::vector<double> thickness{};
  std::shared_ptr<const BodyOutline> outline{};  ///< of the body; none: not asked for
  /// How far along the chain each edge begins and the last ends, length: sums of the edges' control polygons, which are
  /// no shorter than the edges. Empty: not known.
  std::vector<double> along{};
};

/// The edges of a boundary by the pieces that hang together, from that with the leftmost, then lowest node on.
std::vector<std::vector<int>> pieces_of(const Mesh& mesh, int boundary);

/// The boundary's edges as one chain.
/// Throws InputError, with coordinates, where they branch, fall into pieces, or belong to more than one body.
Curve contact_curve(const Mesh& mesh, int boundary, const SideTable& table);

/// The same of a single boundary.
Curve contact_curve(const Mesh& mesh, int boundary);

/// Whether the arc length s of the output runs against the edges: from the end with the smaller x, then y.
bool runs_backwards(const Points& nodes, const Curve& curve);

/// Whether a node ends the chain.
bool is_end(const Curve& curve, int node);

/// Whether the chains share an end, as the faces of a crack do its tip.
bool meet_at_a_tip(const Curve& one, const Curve& other);

/// Nodes along the chain, ends and middles, each once.
std::vector<int> curve_nodes(const Curve& curve);

}  // namespace mortise
