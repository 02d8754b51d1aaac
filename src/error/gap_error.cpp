#include "error/gap_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mortise {

VecX gap_error(const ContactPair& pair, const std::vector<ElasticLaw>& laws, const PressureLine& line) {
  const Eigen::Index last = line.p.size() - 1;
  VecX stress = VecX::Zero(last + 1);
  const double modulus = contact_modulus(laws[pair.multiplier.body], laws[pair.opposite.body]);
  for (const ContactPoint& point : pair.points) {
    if (!(point.unknown > 0)) continue;
    for (const Eigen::Index i : {Eigen::Index(point.edge), Eigen::Index(point.edge) + 1}) {
      if (!line.loaded[i] && point.gap > point.unknown) continue;
      const double h = line.s(point.edge + 1) - line.s(point.edge);
      stress(i) = std::max(stress(i), std::numbers::pi / 2 * modulus * point.unknown / h);
    }
  }
  if (line.closed) stress(0) = stress(last) = std::max(stress(0), stress(last));
  return stress;
}

void add_gap_error(const PressureLine& line, const VecX& gap_error, LineError& error) {
  for (Eigen::Index i = 0; i < gap_error.size(); ++i)
    error.add_data(i, gap_error(i) * std::sqrt(line.h(i)) / LineError::pointwise_factor);
}

}  // namespace mortise
