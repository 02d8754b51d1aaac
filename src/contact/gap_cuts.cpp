#include "contact/gap_cuts.hpp"

#include <cmath>

#include "fem/edges.hpp"

namespace mortise {

const Field& gap_field(const ContactGeometry& geometry) {
  return geometry.given ? *geometry.given : geometry.clearance;
}

std::array<double, 2> gap_slopes_at_ends(const Points& nodes, const Curve& multiplier,
                                         const ContactGeometry& geometry) {
  constexpr double step = 1e-4;  // of half an edge: of a cubic off by its square, with round-off of 1e-12 of the gap
  const Field& gap = gap_field(geometry);
  std::array<double, 2> slopes{0, 0};
  if (gap.is_constant() || multiplier.closed) return slopes;
  for (const int end : {0, 1}) {
    const int e = end == 0 ? 0 : int(multiplier.edges.size()) - 1;
    const auto at = [&](double away) {
      const double xi = end == 0 ? away - 1 : 1 - away;
      return gap(edge_point(nodes, multiplier.edges[e], xi).position, geometry.s ? geometry.s->at(e, xi) : 0);
    };
    const double half = edge_length(nodes, multiplier.edges[e]) / 2;
    const double slope = (4 * at(step) - 3 * at(0) - at(2 * step)) / (2 * step);  // of the parabola
    const double unknown = 1e-6 * std::abs(at(2) - at(0)) + 1e-11 * std::abs(at(0));
    if (std::abs(slope) > unknown) slopes[end] = slope / half;
  }
  return slopes;
}

LineFunction gap_along(const Points& nodes, const Curve& multiplier, const ContactGeometry& geometry, int edge,
                       const FieldRange& range) {
  return along_edge(nodes, multiplier.edges[edge], gap_field(geometry), range,
                    [&geometry, edge](double xi) { return geometry.s->at(edge, xi); });
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
  for (int e = 0; e < int(multiplier.edges.size()); ++e) {
    LineFunction gap = gap_along(nodes, multiplier, geometry, e, range);
    gap.scale = scale;
    cuts.push_back(resolving_cuts(gap));
  }
  return cuts;
}

}  // namespace mortise
