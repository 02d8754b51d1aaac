#include "contact/gap_resolution.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "contact/curve_resolution.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

constexpr double closed_strain = 1e-9;

// The points of one edge of the multiplier side, with the lines' own gaps.
struct EdgeGaps {
  int edge;
  std::span<ContactPoint> points;
  std::vector<double> drawn;  // of each point, length
  double closed;              // no more than this is none, length
  double largest = 0;         // without sign
};

std::vector<EdgeGaps> gaps_by_edge(const Points& nodes, const Curve& multiplier, const ContactGeometry& geometry,
                                   std::vector<ContactPoint>& points) {
  std::vector<EdgeGaps> list;
  for (const std::span<ContactPoint> of_edge : edge_by_edge(points)) {
    const int edge = of_edge[0].edge;
    const Edge& of = multiplier.edges[edge];
    EdgeGaps gaps{edge, of_edge, {}, closed_strain * edge_length(nodes, of)};
    for (ContactPoint& p : gaps.points) {
      p.unknown = geometry.multiplier->uncertainty(edge) + geometry.opposite->uncertainty(p.opposite_edge);
      gaps.drawn.push_back(p.gap - geometry.clearance_at(edge_point(nodes, of, p.xi).position, {edge, p.xi}));
      gaps.largest = std::max(gaps.largest, std::abs(gaps.drawn.back()));
    }
    list.push_back(std::move(gaps));
  }
  return list;
}

// Whether all gaps of an edge are below a limit, one for each point.
template <typename Limit>
bool all_below(const EdgeGaps& gaps, const Limit& limit) {
  for (std::size_t i = 0; i < gaps.points.size(); ++i)
    if (std::abs(gaps.drawn[i]) > limit(gaps.points[i])) return false;
  return true;
}

// How often the gap changes its sign on edges first ... last; that which is none has no sign.
std::size_t changes_of_sign(const std::vector<EdgeGaps>& list, std::size_t first, std::size_t last) {
  std::size_t changes = 0;
  double before = 0;
  for (std::size_t e = first; e <= last; ++e)
    for (const double gap : list[e].drawn) {
      if (std::abs(gap) <= list[e].closed) continue;
      changes += before * gap < 0;
      before = gap;
    }
  return changes;
}

// Whether it does so as often as there are edges among the five about edge k.
bool goes_from_side_to_side(const std::vector<EdgeGaps>& list, std::size_t k) {
  constexpr std::size_t beside = 2;
  const std::size_t first = k > beside ? k - beside : 0, last = std::min(k + beside, list.size() - 1);
  return changes_of_sign(list, first, last) > last - first;
}

// Takes the gaps of edges first ... last for closed, and keeps what that costs if the lines may as well be apart: their
// gap stays on one side for longer than two of the edges that have one on average, as that between two meshes of one
// line does not.
void close(const std::vector<EdgeGaps>& list, std::size_t first, std::size_t last) {
  std::size_t with_gap = 0;
  for (std::size_t k = first; k <= last; ++k) with_gap += list[k].largest > list[k].closed;
  const bool apart = 2 * changes_of_sign(list, first, last) < with_gap;
  for (std::size_t k = first; k <= last; ++k)
    for (std::size_t i = 0; i < list[k].points.size(); ++i) {
      list[k].points[i].gap -= list[k].drawn[i];
      list[k].points[i].unknown = apart && list[k].largest > list[k].closed ? list[k].largest : 0;
    }
}

}  // namespace

void find_one_line(const Points& nodes, ContactInterface& interface) {
  const Curve &multiplier = interface.multiplier, &opposite = interface.opposite;
  ContactGeometry& geometry = interface.geometry;
  if (!geometry.gap || geometry.given) return;
  geometry.one_line.assign(multiplier.edges.size(), 0);
  const std::vector<EdgeGaps> list = gaps_by_edge(nodes, multiplier, geometry, interface.points);
  const bool rebuilt = multiplier.samples.empty() || opposite.samples.empty();
  std::vector<double> sagitta, opposite_sagitta;
  if (rebuilt) {
    sagitta = sagittas(nodes, multiplier);
    opposite_sagitta = sagittas(nodes, opposite);
  }
  const auto of_meshes = [&](const ContactPoint& p) { return sagitta[p.edge] + opposite_sagitta[p.opposite_edge]; };
  std::vector<char> may_be(list.size(), 0);
  for (std::size_t k = 0; k < list.size(); ++k) {
    const EdgeGaps& gaps = list[k];
    may_be[k] = rebuilt && all_below(gaps, of_meshes);
    geometry.one_line[gaps.edge] = all_below(gaps, [&](const ContactPoint& p) { return p.unknown + gaps.closed; }) ||
                                   (may_be[k] && goes_from_side_to_side(list, k));
  }
  // A line does not leave another and come back within what nobody sees of it.
  const auto follow = [&](std::size_t from, std::size_t to) {
    if (may_be[to] && geometry.one_line[list[from].edge]) geometry.one_line[list[to].edge] = 1;
  };
  for (std::size_t k = 1; k < list.size(); ++k) follow(k - 1, k);
  for (std::size_t k = list.size(); k-- > 1;) follow(k, k - 1);
  for (std::size_t first = 0; first < list.size(); ++first) {
    std::size_t end = first;
    while (end < list.size() && geometry.one_line[list[end].edge]) ++end;
    if (end > first) close(list, first, end - 1);
    first = end;
  }
}

}  // namespace mortise
