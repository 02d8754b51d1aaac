#include "results/extremes.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

namespace mortise {

Extremes find_extremes(const Mesh& mesh, const BodyPoints& points, const StressField& stress) {
  int von_mises_at = 0, max_at = 0, min_at = 0;
  double largest_von_mises = -1, max = -std::numeric_limits<double>::infinity(), min = -max;
  for (int p = 0; p < int(points.node.size()); ++p) {
    const Vec4 s = stress.points.row(p).transpose();
    const auto [smallest, largest] = principal_stresses(s);
    const double v = von_mises(s);
    if (v > largest_von_mises) std::tie(largest_von_mises, von_mises_at) = std::tie(v, p);
    if (largest > max) std::tie(max, max_at) = std::tie(largest, p);
    if (smallest < min) std::tie(min, min_at) = std::tie(smallest, p);
  }
  const auto at = [&](double value, int p) {
    const int body = int(std::ranges::upper_bound(points.first, p) - points.first.begin()) - 1, node = points.node[p];
    return Extreme{value, body, node, mesh.nodes.row(node).transpose()};
  };
  return {at(largest_von_mises, von_mises_at), at(max, max_at), at(min, min_at)};
}

std::optional<Extreme> largest_pressure(const std::vector<ContactResults>& contacts) {
  if (contacts.empty()) return {};
  const auto pair = std::ranges::max_element(contacts, {}, &ContactResults::p_max);
  const ContactNode* most = &pair->multiplier.nodes.front();
  for (const ContactNode* node : nodes_of_extremes(*pair))
    if (node->p > most->p) most = node;
  return Extreme{pair->p_max, int(pair - contacts.begin()), most->node, most->position};
}

}  // namespace mortise
