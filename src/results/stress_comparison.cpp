#include "results/stress_comparison.hpp"

#include <algorithm>
#include <cmath>

namespace mortise {
namespace {

bool near_singular(const Vec2& x, const std::vector<SingularPoint>& singular) {
  return std::any_of(singular.begin(), singular.end(),
                     [&](const SingularPoint& s) { return (x - s.position).norm() < 2.01 * s.edge; });
}

std::optional<StressComparison> compare(const ContactSide& side, const std::vector<SingularPoint>& singular) {
  struct Place {
    double difference, width;
    const ContactNode* node;
  };
  const std::vector<ContactNode>& nodes = side.nodes;
  std::vector<Place> places;
  double length = 0, force = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const ContactNode& n = nodes[i];
    if (std::isnan(n.gap) || n.p == 0 || near_singular(n.position, singular)) continue;
    const double width = (nodes[std::min(i + 1, nodes.size() - 1)].s - nodes[i > 0 ? i - 1 : 0].s) / 2;
    places.push_back({std::abs(n.p + n.sigma_n), width, &n});
    length += width;
    force += width * std::abs(n.p);
  }
  if (!(force > 0)) return {};
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.difference < b.difference; });
  double below = 0;
  for (const Place& place : places)
    if ((below += place.width) >= 0.9 * length)
      return StressComparison{place.difference * length / force, side.curve, place.node->position};
  return {};
}

}  // namespace

std::optional<StressComparison> compare_with_stress(const ContactResults& contact,
                                                    const std::vector<SingularPoint>& singular, double negligible) {
  if (!(largest_entry(contact.pressure) > negligible)) return {};
  auto worst = compare(contact.multiplier, singular), other = compare(contact.opposite, singular);
  return worst && (!other || worst->difference >= other->difference) ? worst : other;
}

}  // namespace mortise
