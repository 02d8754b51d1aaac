#include "problem/multipoint_supports.hpp"

#include <cmath>
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

void prescribe_normals(const Mesh& mesh, int entry, const BoundarySpec& spec, const Places& on_all,
                       MultipointBuilder& builder) {
  std::map<int, NodeNormals> normals;
  const Field& along_normal = *spec.displacement_normal;
  const std::map<int, double> values = prescribed_values(mesh, on_all.boundaries, along_normal);
  for (const NamedBoundary& on : on_all.boundaries)
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
    for (const Vec2& sum : at.sums) builder.prescribe(entry, spec.key, node, sum.normalized(), at.value);
}

void prescribe_direction(const Mesh& mesh, int entry, const BoundarySpec& spec, const Places& on_all,
                         MultipointBuilder& builder) {
  const Field& along = *spec.displacement_along;
  std::map<int, double> values = prescribed_values(mesh, on_all.boundaries, along);
  for (const NamedBoundary& on : on_all.boundaries)
    for (const Edge& edge : mesh.boundaries[on.boundary].edges)
      for (int a = 0; a < edge.node_count && along.is_constant(); ++a) values[edge.nodes[a]] = along.constant();
  for (const NamedPoint* point : on_all.points)
    for (const int node : point->nodes) values[node] = along(mesh.nodes.row(node).transpose());
  for (const auto& [node, value] : values) builder.prescribe(entry, spec.key, node, *spec.direction, value);
}

RigidCurve make_rigid(const Mesh& mesh, const BoundarySpec& spec, const Places& on_all, MultipointBuilder& builder,
                      SaddlePointSystem& system) {
  const RigidSpec& rigid = *spec.rigid;
  std::vector<Edge> edges;
  for (const NamedBoundary& on : on_all.boundaries) {
    const std::vector<Edge>& more = mesh.boundaries[on.boundary].edges;
    edges.insert(edges.end(), more.begin(), more.end());
  }
  std::vector<int> nodes;
  for (const Edge& edge : edges) nodes.insert(nodes.end(), edge.nodes.begin(), edge.nodes.begin() + edge.node_count);
  const bool rings = system.constraints.rings;  // they move along the axis alone
  const auto in_plane = [&](const std::optional<double>& value) { return rings ? std::optional(0.0) : value; };
  RigidCurve curve = builder.make_rigid(spec.key, std::move(nodes), rigid.about.value_or(centre_of(mesh.nodes, edges)),
                                        {in_plane(rigid.x), rigid.y, in_plane(rigid.rotation)});
  add_rigid_load(mesh, curve, rigid.force, rigid.moment, system.f);
  return curve;
}

}  // namespace

MultipointSupports add_multipoint_supports(const Scene& scene, const Mesh& mesh, const SideTable& table,
                                           const SceneNames& names, SaddlePointSystem& system) {
  MultipointSupports supports;
  MultipointBuilder builder(mesh, system.constraints);
  for (std::size_t i = 0; i < scene.boundaries.size(); ++i) {
    const BoundarySpec& spec = scene.boundaries[i];
    if (!spec.is_skew() && !spec.rigid) continue;
    const Places on_all = places_of(mesh, table, names, spec);
    if (spec.rigid)
      supports.rigid_curves.push_back({int(i), make_rigid(mesh, spec, on_all, builder, system)});
    else if (spec.displacement_normal)
      prescribe_normals(mesh, int(i), spec, on_all, builder);
    else
      prescribe_direction(mesh, int(i), spec, on_all, builder);
  }
  add_ties(mesh, builder);
  supports.held_twice = builder.finish();
  return supports;
}

}  // namespace mortise
