#include "contact/gap_cuts.hpp"

namespace mortise {

const Field& gap_field(const ContactGeometry& geometry) {
  return geometry.given ? *geometry.given : geometry.clearance;
}

LineFunction gap_along(const Points& nodes, const Curve& multiplier, const ContactGeometry& geometry, int edge,
                       const FieldRange& range, double scale) {
  return along_edge(
      nodes, multiplier.edges[edge], gap_field(geometry), range,
      [&geometry, edge](double xi) { return geometry.s->at(edge, xi); }, scale);
}

double gap_scale(const Points& nodes, const Curve& multiplier, const ContactGeometry& geometry,
                 const FieldRange& range) {
  LineScale scale;
  for (int e = 0; e < int(multiplier.edges.size()); ++e)
    scale.look_at(gap_along(nodes, multiplier, geometry, e, range));
  return scale.value();
}

std::vector<std::vector<double>> gap_cuts(const Points& nodes, const Curve& multiplier,
                                          const ContactGeometry& geometry) {
  std::vector<std::vector<double>> cuts;
  if (gap_field(geometry).is_constant()) return cuts;
  const FieldRange range(gap_field(geometry));
  const double scale = gap_scale(nodes, multiplier, geometry, range);
  for (int e = 0; e < int(multiplier.edges.size()); ++e)
    cuts.push_back(resolving_cuts(gap_along(nodes, multiplier, geometry, e, range, scale)));
  return cuts;
}

}  // namespace mortise
