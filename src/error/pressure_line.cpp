#include "error/pressure_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "contact/multiplier_rows.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

constexpr double border_part = 0.25;  // of the p at one edge from the border

// Length of edge e over half that of the loaded piece that ends on it; over all of it where the piece's other end is
// that of the line, on a symmetry axis as a rule.
double border_part_of(const PressureLine& line, Eigen::Index e, bool loaded_before, double least) {
  const int step = loaded_before ? -1 : 1;
  Eigen::Index i = loaded_before ? e : e + 1;
  double length = 0;
  bool ends = false;
  for (Eigen::Index left = line.p.size() - 1; left > 0 && !ends; --left) {
    const auto next = line.beside(i, step);
    if (!next) break;
    ends = !(std::abs(line.p(*next)) > least);
    if (!ends) length += line.distance(line.s(*next), line.s(i));
    i = *next;
  }
  const double edge = line.s(e + 1) - line.s(e);
  return edge / std::max(ends ? length / 2 : length, edge);
}

// How far from a border on edge e the force of p is that of a root, (2/3) c r^(3/2), with a c^2 that stays the same to
// a factor of two; r from the middle of the edge, as where on it contact ends is not known. No less than `least_edges`,
// over which that matters, and no farther than the loaded piece goes.
double root_reach(const PressureLine& line, Eigen::Index e, bool loaded_before, double least) {
  constexpr int least_edges = 4;
  const int step = loaded_before ? -1 : 1;
  Eigen::Index i = loaded_before ? e : e + 1;
  double r = (line.s(e + 1) - line.s(e)) / 2, force = r * std::abs(line.p(i)) * 2 / 3;
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  for (Eigen::Index k = 1; k + 1 < line.p.size(); ++k) {
    const auto next = line.beside(i, step);
    if (!next || !(std::abs(line.p(*next)) > least)) break;
    const double length = line.distance(line.s(*next), line.s(i));
    force += length * (std::abs(line.p(i)) + std::abs(line.p(*next))) / 2;
    r += length;
    i = *next;
    if (k < least_edges) continue;
    const double square = force * force / (r * r * r);
    smallest = std::min(smallest, square);
    largest = std::max(largest, square);
    if (largest > 2 * smallest) break;
  }
  return r;
}

void mark_loaded(const ContactPair& pair, PressureLine& line) {
  const Eigen::Index count = line.p.size();
  const double least = loaded_part * largest_entry(line.p);
  for (const ContactPoint& point : pair.points) line.faced[point.edge] = 1;
  for (Eigen::Index i = 0; i < count; ++i)
    if (std::abs(line.p(i)) > least)
      for (Eigen::Index j = std::max<Eigen::Index>(i - 1, 0); j <= std::min(i + 1, count - 1); ++j) line.loaded[j] = 1;
  if (line.closed && (line.loaded.front() || line.loaded.back())) line.loaded.front() = line.loaded.back() = 1;
  for (Eigen::Index i = 0; i < count; ++i)
    if (const auto [before, after] = line.faced_beside(i); !before && !after) line.loaded[i] = 0;
}

}  // namespace

std::array<bool, 2> PressureLine::faced_beside(Eigen::Index i) const {
  const Eigen::Index last = p.size() - 1;
  const auto at = [&](Eigen::Index e) { return faced[closed ? (e + last) % last : e] != 0; };
  return {(closed || i > 0) && at(i - 1), (closed || i < last) && at(i)};
}

std::optional<Eigen::Index> PressureLine::beside(Eigen::Index i, int step) const {
  const Eigen::Index last = p.size() - 1;
  if (closed && i == (step < 0 ? 0 : last)) i = last - i;  // one vertex
  i += step;
  return i < 0 || i > last ? std::nullopt : std::optional(i);
}

Eigen::Index PressureLine::nearest(const Vec2& x) const {
  return std::ranges::min_element(position, {}, [&](const Vec2& y) { return (y - x).norm(); }) - position.begin();
}

Vec2 PressureLine::foot(const Vec2& x) const {
  Vec2 nearest = position[0];
  for (std::size_t e = 0; e + 1 < position.size(); ++e) {
    const Vec2 along = position[e + 1] - position[e];
    const double part = std::clamp((x - position[e]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const Vec2 place = position[e] + part * along;
    if ((place - x).squaredNorm() < (nearest - x).squaredNorm()) nearest = place;
  }
  return nearest;
}

Vec2 PressureLine::at(double place) const {
  const Eigen::Index edge =
      std::clamp<Eigen::Index>(std::ranges::upper_bound(s, place) - s.begin(), 1, s.size() - 1) - 1;
  const double part = (place - s(edge)) / (s(edge + 1) - s(edge));
  return (1 - part) * position[edge] + part * position[edge + 1];
}

double PressureLine::distance(double one, double other) const {
  const double r = std::abs(one - other);
  return closed ? std::min(r, s(s.size() - 1) - r) : r;
}

double round_off_pressure(const Mesh& mesh, const ContactPair& pair, const std::vector<ElasticLaw>& laws,
                          double displacement) {
  double edge = std::numeric_limits<double>::infinity();
  for (const Edge& e : pair.multiplier.edges) edge = std::min(edge, edge_length(mesh.nodes, e));
  return 1e-12 * std::min(laws[pair.multiplier.body].young, laws[pair.opposite.body].young) * displacement / edge;
}

namespace {

// The fluid's pressure at vertices that it wets, 0 at those that carry nothing; between these, linear in s; beyond the
// last of them constant.
VecX fluid_along(const VecX& wet, const PressureLine& line) {
  const Eigen::Index last = line.p.size() - 1;
  const double least = loaded_part * largest_entry(line.p);
  VecX fluid = wet;
  Eigen::Index before = -1;
  for (Eigen::Index i = 0; i <= last; ++i) {
    if (wet(i) == 0 && std::abs(line.p(i)) > least) continue;
    for (Eigen::Index k = before + 1; k < i; ++k) {
      const double part = before < 0 ? 1 : (line.s(k) - line.s(before)) / (line.s(i) - line.s(before));
      fluid(k) = part * wet(i) + (before < 0 ? 0 : (1 - part) * wet(before));
    }
    before = i;
  }
  for (Eigen::Index k = before + 1; before >= 0 && k <= last; ++k) fluid(k) = wet(before);
  return fluid;
}

void take_fluid(const ContactPair& pair, const VecX& fluid, PressureLine& line) {
  const VecX of_multipliers = multiplier_values(pair.coupling, fluid.segment(pair.first_row, pair.coupling.B.rows()));
  const Eigen::Index count = line.p.size();
  VecX wet(count);
  for (Eigen::Index i = 0; i < count; ++i)
    wet(i) = of_multipliers(pair.coupling.on_edge[std::min(i, count - 2)][i < count - 1 ? 0 : 1]);
  line.fluid = fluid_along(wet, line);
  line.p -= line.fluid;
  for (Eigen::Index e = 0; e < line.middle.size(); ++e) line.middle(e) -= (line.fluid(e) + line.fluid(e + 1)) / 2;
}

// Contact that is shorter than an edge may be carried by its middle alone: then its vertices stand for it.
void share_middles(PressureLine& line, double least) {
  const Eigen::Index last = line.p.size() - 1;
  for (Eigen::Index e = 0; e < line.middle.size(); ++e) {
    if (!(std::abs(line.middle(e)) > least) || line.p(e) != 0 || line.p(e + 1) != 0) continue;
    line.p(e) = line.p(e + 1) = line.middle(e) / 2;
    if (line.closed && (e == 0 || e + 1 == last)) line.p(0) = line.p(last) = line.middle(e) / 2;
  }
}

}  // namespace

PressureLine pressure_line(const Mesh& mesh, const ContactPair& pair, const VecX& lambda, double round_off,
                           const VecX& fluid) {
  const Curve& curve = pair.multiplier;
  const Eigen::Index count = Eigen::Index(curve.edges.size()) + 1;
  const VecX pressure = -multiplier_values(pair.coupling, lambda.segment(pair.first_row, pair.coupling.B.rows()));
  PressureLine line{.closed = curve.closed,
                    .position = {},
                    .s = VecX::Zero(count),
                    .p = VecX(count),
                    .fluid = {},
                    .middle = {},
                    .h = VecX::Zero(count),
                    .faced = std::vector<char>(count - 1, 0),
                    .loaded = std::vector<char>(count, 0)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index e = std::min(i, count - 2);
    const int end = i < count - 1 ? 0 : 1;
    line.position.emplace_back(mesh.nodes.row(curve.edges[e].nodes[end]));
    line.p(i) = pressure(pair.coupling.on_edge[e][end]);
    if (i == count - 1) break;
    const double length = edge_length(mesh.nodes, curve.edges[e]);
    line.s(i + 1) = line.s(i) + length;
    line.h(i) += length / 2;
    line.h(i + 1) += length / 2;
  }
  if (line.closed) {
    line.h(0) = line.h(count - 1) = line.h(0) + line.h(count - 1);
  } else {
    line.h(0) *= 2;
    line.h(count - 1) *= 2;
  }
  if (curve.edges[0].node_count == 3 && pair.coupling.on_edge[0][2] >= 0) {
    line.middle.resize(count - 1);
    for (Eigen::Index e = 0; e < count - 1; ++e) line.middle(e) = pressure(pair.coupling.on_edge[e][2]);
  }
  if (largest_entry(line.p) <= round_off) line.p.setZero();
  if (pair.spec.fluid && fluid.size() > 0) take_fluid(pair, fluid, line);
  share_middles(line, round_off);
  mark_loaded(pair, line);
  return line;
}

namespace {

// By what the slope changes at each vertex; at an end of what is faced as at the vertex next to it.
VecX slope_jumps(const PressureLine& line) {
  const Eigen::Index last = line.p.size() - 1;
  const auto slope = [&](Eigen::Index e) { return (line.p(e + 1) - line.p(e)) / (line.s(e + 1) - line.s(e)); };
  VecX jump = VecX::Zero(last + 1);
  for (Eigen::Index i = 0; i <= last; ++i)
    if (const auto [before, after] = line.faced_beside(i); before && after)
      jump(i) = std::abs(slope(i < last ? i : 0) - slope(i > 0 ? i - 1 : last - 1));
  const VecX inside = jump;
  for (Eigen::Index i = 0; i <= last; ++i) {
    const auto [before, after] = line.faced_beside(i);
    if (before == after) continue;
    const Eigen::Index next = after ? (i < last ? i + 1 : 1) : (i > 0 ? i - 1 : last - 1);
    jump(i) = inside(next);
  }
  return jump;
}

}  // namespace

LineError line_error(const PressureLine& line) {
  const Eigen::Index last = line.p.size() - 1;
  const VecX jump = slope_jumps(line);
  LineError error(last + 1);
  error.l2 = (line.h.array().cube() * jump.array().square() / 120).sqrt();
  const double least = loaded_part * largest_entry(line.p);
  VecX last_p = VecX::Zero(last + 1);
  const auto vertex = [&](Eigen::Index i) { return line.closed ? (i + last) % last : i; };
  for (Eigen::Index e = 0; e < last; ++e) {
    const bool start = std::abs(line.p(e)) > least, end = std::abs(line.p(e + 1)) > least;
    if (start == end || !line.faced[e]) continue;
    // A root rises to its value at one edge's length from the border: the last p, or the one before over sqrt(2).
    const Eigen::Index before = vertex(start ? e - 1 : e + 2);
    double p = std::abs(line.p(start ? e : e + 1));
    if (before >= 0 && before <= last) p = std::max(p, std::abs(line.p(before)) / std::sqrt(2.0));
    error.borders.push_back({e, border_part_of(line, e, start, least), p / std::sqrt(line.s(e + 1) - line.s(e)),
                             root_reach(line, e, start, least)});
    for (const Eigen::Index i : vertices_at(line, error.borders.back())) last_p(i) = std::max(last_p(i), p);
  }
  for (Eigen::Index i = 0; i <= last; ++i) {
    if (!line.loaded[i]) error.l2(i) = 0;
    const double at_border = border_part * last_p(i) * std::sqrt(line.h(i));
    if (!(at_border > error.l2(i))) continue;
    error.l2(i) = at_border;
    error.border[i] = 1;
  }
  return error;
}

std::vector<Eigen::Index> vertices_at(const PressureLine& line, const LineError::Border& border) {
  const Eigen::Index last = line.p.size() - 1;
  std::vector<Eigen::Index> vertices;
  for (Eigen::Index i = border.edge - 1; i <= border.edge + 2; ++i) {
    if (line.closed || (i >= 0 && i <= last)) vertices.push_back(line.closed ? (i + last) % last : i);
    if (line.closed && i % last == 0) vertices.push_back(last);  // the first again
  }
  return vertices;
}

Eigen::Index open_vertex(const PressureLine& line, const LineError::Border& border) {
  return std::abs(line.p(border.edge)) < std::abs(line.p(border.edge + 1)) ? border.edge : border.edge + 1;
}

VecX LineError::pointwise(const PressureLine& line) const {
  constexpr Eigen::Index reach = 4;
  const VecX at = whole().array() / line.h.array().sqrt() * pointwise_factor * worst.array();
  const Eigen::Index count = at.size(), period = count - 1;
  VecX found = at;
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index step = -reach; step <= reach; ++step) {
      Eigen::Index j = i + step;
      if (line.closed) j = (j % period + period) % period;
      if (j >= 0 && j < count) found(i) = largest(found(i), at(j));
    }
  for (Eigen::Index b = 0; b < count; ++b) {
    if (!border[b]) continue;
    for (Eigen::Index i = 0; i < count; ++i) {
      const double r = line.distance(line.s(i), line.s(b));
      if (line.loaded[i]) found(i) = largest(found(i), at(b) * std::sqrt(line.h(b) / std::max(r, line.h(b))));
    }
  }
  return found;
}

void LineError::add_data(Eigen::Index vertex, double by) { data(vertex) = std::hypot(data(vertex), by); }

void LineError::add_weak(const Weak& of) {
  add_data(of.vertex, of.part);
  weak.push_back(of);
}

void LineError::add_load(const Load& of) {
  add_data(of.vertex, of.part);
  loads.push_back(of);
}

VecX LineError::whole() const { return along().cwiseMax(swing).cwiseMax(missed); }

void LineError::raise(Eigen::Index vertex, double by) { least(vertex) = std::max(least(vertex), by); }

void add_hardly_faced(const ContactPair& pair, const PressureLine& line, LineError& error) {
  const Eigen::Index last = line.p.size() - 1;
  VecX faced = VecX::Zero(last), of_vertex = VecX::Zero(last + 1), length = of_vertex;
  for (const ContactPoint& point : pair.points) faced(point.edge) += point.ds;
  for (Eigen::Index e = 0; e < last; ++e)
    for (const Eigen::Index i : {e, e + 1}) {
      of_vertex(i) += faced(e);
      length(i) += line.s(e + 1) - line.s(e);
    }
  if (line.closed) {
    of_vertex(0) = of_vertex(last) = of_vertex(0) + of_vertex(last);
    length(0) = length(last) = length(0) + length(last);
  }
  for (Eigen::Index i = 0; i <= last; ++i)
    if (line.loaded[i] && of_vertex(i) < faced_limit * length(i)) error.raise(i, std::abs(line.p(i)));
}

void add_axis_end(const ContactPair& pair, const PressureLine& line, LineError& error) {
  const Eigen::Index last = line.p.size() - 1;
  if (!pair.geometry.model.axisymmetric() || line.closed || last < 2) return;
  const double round_off = 1e-9 * line.s(last);
  for (const auto& [axis, next, after] :
       {std::array{Eigen::Index(0), Eigen::Index(1), Eigen::Index(2)}, std::array{last, last - 1, last - 2}}) {
    if (line.position[axis].x() > round_off || !line.loaded[axis] || !line.loaded[next] || !line.loaded[after])
      continue;
    const double near = std::pow(line.s(next) - line.s(axis), 2), far = std::pow(line.s(after) - line.s(axis), 2);
    error.raise(axis, std::abs(line.p(axis) - (line.p(next) * far - line.p(after) * near) / (far - near)));
  }
}

}  // namespace mortise
