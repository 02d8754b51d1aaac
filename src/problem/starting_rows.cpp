#include "problem/starting_rows.hpp"

namespace mortise {

std::vector<char> starting_rows(const ActiveSet& start, const Mesh& mesh, const std::vector<ContactPair>& pairs) {
  if (start.pairs.size() != pairs.size()) return {};
  std::vector<char> closed;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const std::vector<ActiveSet::Row>& rows = start.pairs[k];
    if (rows.empty()) return {};
    // Both run along the curve, though maybe against each other: on from the one before.
    std::size_t at = 0;
    for (const int node : row_nodes(pairs[k].coupling)) {
      const Vec2 x = mesh.nodes.row(node).transpose();
      const auto away = [&](std::size_t i) { return (rows[i].place - x).squaredNorm(); };
      if (closed.size() == std::size_t(pairs[k].first_row))
        for (std::size_t i = 1; i < rows.size(); ++i)
          if (away(i) < away(at)) at = i;
      while (at + 1 < rows.size() && away(at + 1) <= away(at)) ++at;
      while (at > 0 && away(at - 1) < away(at)) --at;
      closed.push_back(rows[at].active);
    }
  }
  return closed;
}

}  // namespace mortise
