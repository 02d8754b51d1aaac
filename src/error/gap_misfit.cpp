#include "error/gap_misfit.hpp"

#include <algorithm>

#include "contact/gap_cuts.hpp"

namespace mortise {

GapErrors gap_errors(const Mesh& mesh, const ContactPair& pair, const std::vector<ElasticLaw>& laws) {
  constexpr double jump = 1e-6;  // of an edge: what happens within less is told from a jump by nothing
  GapErrors found;
  if (pair.spec.initial_gap == InitialGap::closed || gap_field(pair.geometry).is_constant()) return found;
  const auto cuts = gap_cuts(mesh.nodes, pair.multiplier, pair.geometry);
  const FieldRange range(gap_field(pair.geometry));
  const double modulus = contact_modulus(laws[pair.multiplier.body], laws[pair.opposite.body]);
  found.l2 = found.off = VecX::Zero(Eigen::Index(cuts.size()));
  for (std::size_t e = 0; e < cuts.size(); ++e) {
    if (cuts[e].size() == 2) continue;
    const Edge& edge = pair.multiplier.edges[e];
    const LineMisfit left = misfit(gap_along(mesh.nodes, pair.multiplier, pair.geometry, int(e), range), cuts[e]);
    const double h = edge_length(mesh.nodes, edge);
    const bool jumps = left.finest < jump;
    if (jumps) found.jumps.push_back({int(e), edge_point(mesh.nodes, edge, left.at).position});
    // A jump has no length of its own: beside what is left out around it the edge's counts.
    const double length = jumps ? h : left.finest / 2 * h, largest = std::min(left.mean * h / length, left.largest);
    found.off(Eigen::Index(e)) = left.largest;
    found.l2(Eigen::Index(e)) = modulus * largest / (2 * length) * std::sqrt(length);
  }
  if (!(found.l2.maxCoeff() > 0)) found.l2.resize(0);
  return found;
}

}  // namespace mortise
