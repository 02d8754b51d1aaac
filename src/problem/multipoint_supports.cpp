#include "problem/multipoint_supports.hpp"

#include <numbers>

#include "base/vectors.hpp"
#include "fem/edges.hpp"
#include "problem/boundary_fields.hpp"
#include "problem/ties.hpp"

namespace mortise {
namespace {

const double corner = std::numbers::pi / 12;  // between the normals of one smooth curve at a node

// Outward normals of the edges at a node, of unit length: one, or two at a corner.
struct NodeNormals {
  std::vector<Vec2> sums;
  double value;

  void add(const Vec2& normal) {
    for (Vec2& sum : sums)
      if (angle_between(sum, normal) < corner) {
        sum += normal;
        return;
      }
    sums.push_back(normal);
  }
};

void prescribe_normals(const Mesh& mesh, int number, const BoundaryEntry& entry, const Field& along_normal,
                       MultipointBuilder& builder) {
  std::map<int, NodeNormals> normals;
  const std::map<int, double> values = prescribed_values(mesh, entry.curves, along_normal);
  for (const NamedBoundary& on : entry.curves)
    for (const CellSide& side : on.sides) {
      const Edge edge = side_edge(mesh.cells[side.cell], side.side);
      for (int a = 0; a < edge.node_count; ++a) {
        const int node = edge.nodes[a];
        NodeNormals& at = normals[node];
        at.add(edge_point(mesh.nodes, edge, xi_of_node(a)).normal());
        at.value = along_normal.is_constant() ? along_normal.constant() : values.at(node);
      }
    }
  for (const auto& [node, at] : normals)
    for (const Vec2& sum : at.sums) builder.prescribe(number, entry.spec.key, node, sum.normalized(), at.value);
}

void prescribe_direction(const Mesh& mesh, int number, const BoundaryEntry& entry, const DirectedDisplacement& u,
                         MultipointBuilder& builder) {
  const Field& along = u.value;
  std::map<int, double> values = prescribed_values(mesh, entry.curves, along);
  for (const NamedBoundary& on : entry.curves)
    for (const Edge& edge : mesh.boundaries[on.boundary].edges)
      for (int a = 0; a < edge.node_count && along.is_constant(); ++a) values[edge.nodes[a]] = along.constant();
  for (const int point : entry.points)
    for (const int node : mesh.points[point].nodes) values[node] = along(mesh.nodes.row(node).transpose());
  for (const auto& [node, value] : values) builder.prescribe(number, entry.spec.key, node, u.direction, value);
}

RigidCurve make_rigid(const Mesh& mesh, const BoundaryEntry& entry, const RigidSpec& rigid, MultipointBuilder& builder,
                      SaddlePointSystem& system) {
  const std::vector<Edge> edges = edges_of(mesh, entry);
  std::vector<int> nodes;
  for (const Edge& edge : edges) nodes.insert(nodes.end(), edge.nodes.begin(), edge.nodes.begin() + edge.node_count);
  const bool rings = system.constraints.rings;  // they move along the axis alone
  const auto in_plane = [&](const std::optional<double>& value) { return rings ? std::optional(0.0) : value; };
  RigidCurve curve =
      builder.make_rigid(entry.spec.key, std::move(nodes), rigid.about.value_or(centre_of(mesh.nodes, edges)),
                         {in_plane(rigid.x), rigid.y, in_plane(rigid.rotation)});
  add_rigid_load(mesh, curve, rigid.force, rigid.moment, system.f);
  return curve;
}

// Of the ties whose overlap is unknown: pairs of forces that are in balance.
void add_pretensions(const Mesh& mesh, MultipointSupports& supports, SaddlePointSystem& system) {
  if (supports.overlaps.empty()) return;
  supports.pretension = VecX::Zero(system.f.size());
  for (const auto& [k, overlap] : supports.overlaps)
    if (const Pretension& given = *mesh.ties[k].pretension; !given.overlap)
      supports.pretension +=
          *given.force / overlap.part * system.constraints.multipoint->inverse.row(overlap.q).transpose();
  system.f += supports.pretension;
}

}  // namespace

MultipointSupports add_multipoint_supports(const std::vector<BoundaryEntry>& entries, const Mesh& mesh,
                                           SaddlePointSystem& system) {
  MultipointSupports supports;
  MultipointBuilder builder(mesh, system.constraints);
  for (int i = 0; i < int(entries.size()); ++i) {
    const BoundaryEntry& entry = entries[i];
    if (const auto* rigid = std::get_if<RigidSpec>(&entry.spec.what))
      supports.rigid_curves.push_back({i, make_rigid(mesh, entry, *rigid, builder, system)});
    else if (const auto* normal = std::get_if<NormalDisplacement>(&entry.spec.what))
      prescribe_normals(mesh, i, entry, normal->value, builder);
    else if (const auto* directed = std::get_if<DirectedDisplacement>(&entry.spec.what))
      prescribe_direction(mesh, i, entry, *directed, builder);
  }
  supports.overlaps = add_ties(mesh, builder);
  supports.held_twice = builder.finish();
  add_pretensions(mesh, supports, system);
  return supports;
}

}  // namespace mortise
