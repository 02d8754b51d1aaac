#include "problem/boundary_fields.hpp"

namespace mortise {
namespace {

std::function<double(double)> arc_along(const NamedBoundary& on, int e) {
  if (!on.s) return {};
  return [&on, e](double xi) { return on.s->at(e, xi); };
}

double scale_along(const Mesh& mesh, const std::vector<NamedBoundary>& boundaries, const Field& field,
                   const FieldRange& range) {
  LineScale scale;
  for (const NamedBoundary& on : boundaries) {
    const std::vector<Edge> edges = edges_of(mesh, on);
    for (int e = 0; e < int(edges.size()); ++e)
      scale.look_at(along_edge(mesh.nodes, edges[e], field, range, arc_along(on, e)));
  }
  return scale.value();
}

// The middle node's value that makes the mean of the edge that of the field.
double with_mean(const Mesh& mesh, const Edge& edge, const LineFunction& g, const std::vector<double>& cuts,
                 const std::array<double, 2>& ends) {
  const LineRule rule = cut_rule(cuts, 4);
  double integral = 0;
  std::array<double, 3> of_shape{};
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const double ds = rule.weights[q] * edge_point(mesh.nodes, edge, rule.points[q]).jacobian();
    const EdgeShape shape = edge_shape(3, rule.points[q]);
    integral += ds * g.at(rule.points[q]);
    for (int a = 0; a < 3; ++a) of_shape[a] += ds * shape.N[a];
  }
  return (integral - ends[0] * of_shape[0] - ends[1] * of_shape[1]) / of_shape[2];
}

}  // namespace

std::vector<Edge> edges_of(const Mesh& mesh, const NamedBoundary& on) {
  if (on.sides.empty()) return mesh.boundaries[on.boundary].edges;
  std::vector<Edge> edges;
  for (const CellSide& side : on.sides) edges.push_back(side_edge(mesh.cells[side.cell], side.side));
  return edges;
}

std::vector<Edge> edges_of(const Mesh& mesh, const BoundaryEntry& entry) {
  std::vector<Edge> edges;
  for (const NamedBoundary& on : entry.curves) {
    const std::vector<Edge>& more = mesh.boundaries[on.boundary].edges;
    edges.insert(edges.end(), more.begin(), more.end());
  }
  return edges;
}

BoundaryFields::BoundaryFields(const Mesh& mesh, const std::vector<NamedBoundary>& boundaries,
                               std::vector<const Field*> fields)
    : mesh_(mesh), fields_(std::move(fields)) {
  std::erase_if(fields_, [](const Field* field) { return field->is_constant(); });
  for (const Field* field : fields_) {
    ranges_.emplace_back(*field);
    scales_.push_back(scale_along(mesh, boundaries, *field, ranges_.back()));
  }
}

LineFunction BoundaryFields::along(std::size_t k, const NamedBoundary& on, int e, const Edge& edge) const {
  LineFunction f = along_edge(mesh_.nodes, edge, *fields_[k], ranges_[k], arc_along(on, e));
  f.scale = scales_[k];
  return f;
}

std::vector<double> BoundaryFields::cuts(const NamedBoundary& on, int e, const Edge& edge) const {
  std::vector<double> all{-1, 1};
  for (std::size_t k = 0; k < count(); ++k) all = merged(all, resolving_cuts(along(k, on, e, edge)));
  return all;
}

std::map<int, double> prescribed_values(const Mesh& mesh, const std::vector<NamedBoundary>& boundaries,
                                        const Field& field) {
  std::map<int, double> values;
  if (field.is_constant()) return values;
  const BoundaryFields fields(mesh, boundaries, {&field});
  for (const NamedBoundary& on : boundaries) {
    const std::vector<Edge> edges = edges_of(mesh, on);
    for (int e = 0; e < int(edges.size()); ++e) {
      const Edge& edge = edges[e];
      for (int a = 0; a < edge.node_count; ++a)
        values[edge.nodes[a]] = field(mesh.nodes.row(edge.nodes[a]).transpose(), on.s_at(edge.nodes[a]));
      if (edge.node_count != 3) continue;
      const LineFunction g = fields.along(0, on, e, edge);
      const double value = with_mean(mesh, edge, g, resolving_cuts(g), {values[edge.nodes[0]], values[edge.nodes[1]]});
      double& middle = values[edge.nodes[2]];
      if (std::abs(value - middle) > 1e-9 * g.scale) middle = value;  // else round-off
    }
  }
  return values;
}

}  // namespace mortise
