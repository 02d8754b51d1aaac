#include "problem/fluid.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "contact/multiplier_rows.hpp"
#include "contact/segments.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

constexpr double as_much = 1 - 1e-8;  // of the fluid's pressure: what a row carries is not known any better

// A multiplier that faces the other side, and where: the way along that curve to what it faces.
struct Station {
  int row;  // of all pairs'
  Vec2 x;
  double foot;
  bool goes_on = false;  // fluid gets to the next one; of the last one of a closed curve that is the first
};

// The way along the other side to what each multiplier faces, and the length of what is faced at all.
struct Feet {
  VecX along, away;  // away: of the contact point by which it is known
  double length = 0, faced = 0;
};

Feet feet_of(const Mesh& mesh, const ContactPair& pair) {
  const Eigen::Index count = pair.coupling.node.size();
  Feet feet{VecX::Zero(count), VecX::Constant(count, std::numeric_limits<double>::infinity())};
  std::vector<double> before;
  for (const Edge& edge : pair.opposite.edges) {
    before.push_back(feet.length);
    feet.length += edge_length(mesh.nodes, edge);
  }
  std::vector<char> faced(before.size(), 0);
  for (const ContactPoint& c : pair.points) {
    const Vec2 x = edge_point(mesh.nodes, pair.multiplier.edges[c.edge], c.xi).position;
    const Edge& other = pair.opposite.edges[c.opposite_edge];
    if (!std::exchange(faced[c.opposite_edge], 1)) feet.faced += edge_length(mesh.nodes, other);
    for (const int a : pair.coupling.on_edge[c.edge]) {
      if (a < 0) continue;
      const double away = (mesh.nodes.row(pair.coupling.node[a]).transpose() - x).norm();
      if (away >= feet.away(a)) continue;
      feet.away(a) = away;
      feet.along(a) = before[c.opposite_edge] + length_to(mesh.nodes, other, c.eta);
    }
  }
  return feet;
}

// The line of a pair's gap. Between neighbours fluid gets along. Where multipliers between two of them face nothing, it
// gets across if both face about the same place: a groove, along which the other side leads on. Else they are the two
// ends of the gap, as of a ring on a floor, and what lies between is outside of it.
std::vector<Station> gap_line(const Mesh& mesh, const ContactPair& pair) {
  const Coupling& coupling = pair.coupling;
  const std::vector<int> line = multipliers_along(coupling);
  const Feet feet = feet_of(mesh, pair);
  std::vector<Station> stations;
  std::vector<int> place;
  for (int i = 0; i < int(line.size()); ++i)
    if (const int a = line[i]; coupling.row[a] >= 0) {
      stations.push_back(
          {pair.first_row + coupling.row[a], mesh.nodes.row(coupling.node[a]).transpose(), feet.along(a)});
      place.push_back(i);
    }
  const int count = int(stations.size());
  for (int k = 0; k < count; ++k) {
    const bool last = k + 1 == count;
    if (last && !pair.multiplier.closed) break;
    const int to = last ? 0 : k + 1;
    const bool neighbours = last ? place[k] + 1 == int(line.size()) && place[to] == 0 : place[to] == place[k] + 1;
    const double ahead = std::abs(stations[to].foot - stations[k].foot),
                 apart = pair.opposite.closed ? std::min(ahead, feet.length - ahead) : ahead;
    stations[k].goes_on = neighbours || apart < feet.faced / 2;
  }
  return stations;
}

// Where fluid gets in: the nearest of the line.
std::vector<int> inlets(const Mesh& mesh, const ContactPair& pair, const std::vector<Station>& line) {
  std::vector<int> found;
  if (line.empty()) return found;  // prescribed displacements leave the sides apart everywhere
  for (const Vec2& x : pair.spec.fluid->from) {
    const auto nearest = std::ranges::min_element(line, {}, [&](const Station& s) { return (s.x - x).norm(); });
    const double away = (nearest->x - x).norm();
    if (const double length = curve_length(mesh.nodes, pair.multiplier); away > length) {
      throw SceneError(worded(pair.spec.key, ".fluid.from: (", x.x(), ", ", x.y(), ") lies ", away, " from '",
                              mesh.boundaries[pair.multiplier.boundary].name, "', more than that is long, ", length,
                              "; expected a place on the curve, such as one of its ends"));
    }
    found.push_back(int(nearest - line.begin()));
  }
  return found;
}

// Calls wet(row) for the rows that fluid gets to from an inlet, both ways along the line, each until `holds(row)`.
template <typename Holds, typename Wet>
void flow(const std::vector<Station>& line, int inlet, Holds holds, Wet wet) {
  const int count = int(line.size());
  for (const int step : {1, -1})
    for (int k = 0, i = inlet; k < count && !holds(line[i].row); ++k) {
      wet(line[i].row);
      const int next = (i + step + count) % count;
      if (!line[step > 0 ? i : next].goes_on) break;
      i = next;
    }
}

// Of each multiplier the row whose fluid is at its place: of one that faces nothing that of the nearest along the line.
std::vector<int> rows_beside(const ContactPair& pair) {
  const Coupling& coupling = pair.coupling;
  const std::vector<int> line = multipliers_along(coupling);
  const int count = int(line.size());
  std::vector<int> rows = coupling.row;
  for (int i = 0; i < count; ++i)
    for (int away = 1; away < count && rows[line[i]] < 0; ++away)
      for (const int k : {i - away, i + away}) {
        const int at = pair.multiplier.closed ? (k + count) % count : k;
        if (at >= 0 && at < count && rows[line[i]] < 0) rows[line[i]] = coupling.row[line[at]];
      }
  return rows;
}

// Of unit pressure in each row on the opposite side, where that faces the multiplier side, along its own normals.
void add_opposite(const Mesh& mesh, const Model& model, const ContactPair& pair, Triplets& loads) {
  ContactInterface back{
      .multiplier = pair.opposite, .opposite = pair.multiplier, .geometry = {}, .points = {}, .coupling = {}};
  back.geometry.model = model;
  back.geometry.beyond_steps = true;
  const std::vector<int> rows = rows_beside(pair);
  for (const ContactPoint& c : contact_points(mesh.nodes, back, Integration::segments)) {
    const Edge &face = pair.opposite.edges[c.edge], &edge = pair.multiplier.edges[c.opposite_edge];
    const auto& on = pair.coupling.on_edge[c.opposite_edge];
    const int count = on[2] >= 0 ? edge.node_count : 2;
    const EdgeShape N = edge_shape(count, c.eta), M = edge_shape(face.node_count, c.xi);
    for (int i = 0; i < count; ++i)
      for (int b = 0; rows[on[i]] >= 0 && b < face.node_count; ++b)
        for (int d = 0; d < 2; ++d)
          loads.emplace_back(pair.first_row + rows[on[i]], 2 * face.nodes[b] + d,
                             -c.dA * N.N[i] * M.N[b] * c.normal(d));
  }
}

}  // namespace

SparseRows fluid_loads(const Mesh& mesh, const Model& model, const std::vector<ContactPair>& pairs, Eigen::Index rows) {
  Triplets loads;
  for (const ContactPair& pair : pairs) {
    if (!pair.spec.fluid) continue;
    for_each_entry(pair.coupling.own,
                   [&](int row, int column, double value) { loads.emplace_back(pair.first_row + row, column, value); });
    add_opposite(mesh, model, pair, loads);
  }
  return filled<SparseRows>(rows, 2 * mesh.nodes.rows(), loads);
}

VecX dry_rows(const Mesh& mesh, const std::vector<ContactPair>& pairs, Eigen::Index rows) {
  if (std::ranges::none_of(pairs, [](const ContactPair& pair) { return pair.spec.fluid.has_value(); })) return {};
  for (const ContactPair& pair : pairs)
    if (pair.spec.fluid) inlets(mesh, pair, gap_line(mesh, pair));
  return VecX::Zero(rows);
}

bool spread_fluids(const Solution& solution, Problem& p) {
  if (p.fluid.size() == 0) return false;
  const VecX before = p.fluid;
  for (const ContactPair& pair : p.pairs) {
    if (!pair.spec.fluid || pair.spec.fluid->pressure == 0) continue;
    const double pressure = pair.spec.fluid->pressure;
    const std::vector<Station> line = gap_line(p.mesh, pair);
    for (const int inlet : inlets(p.mesh, pair, line))
      flow(
          line, inlet, [&](int row) { return p.fluid(row) == 0 && -solution.lambda(row) >= as_much * pressure; },
          [&](int row) { p.fluid(row) = pressure; });
  }
  const VecX more = p.fluid - before;
  p.discretisation.system.f += p.fluid_loads.transpose() * more;
  return more.any();
}

void add_fluids(Problem& p, Solution& solution) {
  if (p.fluid.size() == 0) return;
  p.discretisation.system.f -= p.discretisation.system.B.transpose() * p.fluid;
  if (solution.lambda.size() > 0) solution.lambda -= p.fluid;
}

}  // namespace mortise
