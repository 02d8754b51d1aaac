#include "contact/singular_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include "base/parallel.hpp"
#include "base/vectors.hpp"
#include "contact/projection.hpp"
#include "fem/edges.hpp"
#include "mesh/box_index.hpp"

namespace mortise {
namespace {

// One kink of two bodies that slide across it is singular however little it turns (exponents near 0). Of those that
// turn by less it is how far the bodies slide that says whether anything is seen of it (error/sliding_kinks.hpp).
constexpr double least_shared_kink = 2 * straight / 180;

// What directions of a drawn straight line differ by, and of a line rebuilt through the nodes (contact_line.hpp).
constexpr double round_off = 1e-9;

// What round-off of a drawn edge's places makes of its direction at an end, times eps x / h with h the length of the
// piece there and x the largest coordinate: up to 66 of random arcs, and places that gmsh computes are off by several
// eps.
constexpr double round_off_of_directions = 300;

// The same times m / h with m the misfit of the edges beside, which is noise of the places where they tell no more, as
// of a circle of a large radius that is far from its centre: a polynomial of degree n that is off by r has a slope that
// is off by n^2 r / (h / 2) or less (Markov), and r is 2 m or less, as noise between the places is as large as at them.
constexpr double misfit_of_directions = 256;

// Kinks of both bodies are one where their angles add up to 2 pi to this part of their turn: a rebuilt line's, of three
// nodes or more a side, are off by less.
constexpr double one_kink = 0.1;

// A vertex lies at a place of the other curve where an edge does not tell them apart.
constexpr double at_one_place = 0.05;

// A vertex of a curve and the edges before and after it, -1 at an end.
struct Vertex {
  int node, before, after;
  bool is_end() const { return before < 0 || after < 0; }
};

std::vector<Vertex> vertices_of(const Curve& curve) {
  const int count = int(curve.edges.size());
  std::vector<Vertex> list;
  for (int e = 0; e < count; ++e)
    list.push_back({curve.edges[e].nodes[0], e > 0 ? e - 1 : curve.closed ? count - 1 : -1, e});
  if (!curve.closed) list.push_back({curve.edges.back().nodes[1], count - 1, -1});
  return list;
}

// One of the two curves with the line that it stands for.
struct LineSide {
  const Surroundings& around;
  const Curve& curve;
  const ElasticLaw& law;
  ContactLine line;

  LineSide(const Surroundings& of, const Curve& along)
      : around(of), curve(along), law(of.laws[along.body]), line(of.mesh.nodes, along) {}

  Vec2 position(const Vertex& v) const { return around.mesh.nodes.row(v.node).transpose(); }
  Vec2 before(const Vertex& v) const { return line.at(v.before, 1).tangent; }
  Vec2 after(const Vertex& v) const { return line.at(v.after, -1).tangent; }
  double turn(const Vertex& v) const { return v.is_end() ? 0 : straight - interior_angle(before(v), after(v)); }
  double turn_error(const Vertex& v) const {
    const double misfit = misfit_at(v);
    return round_off + (v.before < 0 ? 0 : end_error(v.before, 1, misfit)) +
           (v.after < 0 ? 0 : end_error(v.after, -1, misfit));
  }
  bool is_kink(const Vertex& v) const { return std::abs(turn(v)) > turn_error(v); }
  double edge_at(const Vertex& v) const {
    double length = 0;
    for (const int e : {v.before, v.after})
      if (e >= 0) length = std::max(length, edge_length(around.mesh.nodes, curve.edges[e]));
    return length;
  }
  Vec2 normal(const Vertex& v) const {
    Vec2 n = Vec2::Zero();
    if (v.before >= 0) n += line.at(v.before, 1).normal();
    if (v.after >= 0) n += line.at(v.after, -1).normal();
    return n.normalized();
  }
  Corner corner(const Vertex& v) const;

 private:
  double misfit_at(const Vertex& v) const;
  double end_error(int e, int end, double misfit) const;
};

constexpr int last_place = std::tuple_size_v<decltype(SamplePiece::places)> - 1;
using PlaceWeights = std::array<double, last_place + 1>;

// Of places 0, 2, ... in the slope at place `at` of the polynomial through them.
PlaceWeights slope_weights(int at) {
  const auto z = [](int k) { return -std::cos(straight * k / last_place); };
  PlaceWeights weights{};
  for (int k = 0; k <= last_place; k += 2) {
    if (k == at) continue;
    weights[k] = 1;
    for (int m = 0; m <= last_place; m += 2) {
      if (m == k) continue;
      weights[k] /= z(k) - z(m);
      if (m != at) weights[k] *= z(at) - z(m);
    }
  }
  return weights;
}

// Of the drawn edges beside a vertex, the larger.
double LineSide::misfit_at(const Vertex& v) const {
  double misfit = 0;
  if (curve.samples.empty()) return misfit;
  for (const int e : {v.before, v.after})
    if (e >= 0) misfit = std::max(misfit, curve.samples[e].misfit);
  return misfit;
}

// What the tangent at an end of a drawn edge may be off by, radians: as much as that of every second place of the piece
// there is, and what round-off makes of it.
double LineSide::end_error(int e, int end, double misfit) const {
  static const std::array<PlaceWeights, 2> all{slope_weights(0), slope_weights(last_place)};
  if (curve.samples.empty()) return 0;
  const std::vector<SamplePiece>& pieces = curve.samples[e].pieces;
  const auto& x = (end < 0 ? pieces.front() : pieces.back()).places;
  const PlaceWeights& weights = all[end < 0 ? 0 : 1];
  const int at = end < 0 ? 0 : last_place;
  Vec2 slope = Vec2::Zero();
  for (int k = 0; k <= last_place; k += 2)
    if (k != at) slope += weights[k] * (x[k] - x[at]);
  const double size = x[at].lpNorm<Eigen::Infinity>(), length = (x[last_place] - x[0]).norm();
  const double off =
      round_off_of_directions * std::numeric_limits<double>::epsilon() * size + misfit_of_directions * misfit;
  return angle_between(slope, line.at(e, end).tangent) + off / length;
}

Corner LineSide::corner(const Vertex& v) const {
  if (!v.is_end()) return {wedge(straight - turn(v), law), false, edge_at(v), turn_error(v), v.node};
  for (const Edge& beyond : outline_at(around.mesh, around.table, v.node)) {
    const bool starts = beyond.nodes[0] == v.node;
    if (starts != (v.after < 0)) continue;  // the curve's own
    const Vec2 tangent = edge_point(around.mesh.nodes, beyond, starts ? -1 : 1).tangent;
    const double angle = starts ? interior_angle(before(v), tangent) : interior_angle(tangent, after(v));
    return {wedge(angle, law, face_of(around.mesh.nodes, beyond, around.constraints)), true, edge_at(v), turn_error(v),
            v.node};
  }
  return {wedge(straight, law), true, edge_at(v), turn_error(v), v.node};
}

// The body on the other side of a vertex, near it or far: where the normal there meets it.
std::optional<Corner> facing(const LineSide& side, const Vertex& v, const LineSide& other) {
  const Vec2 x = side.position(v);
  const double edge = side.edge_at(v);
  const Line line{x, side.normal(v), deepest_overlap(side.curve, std::max(v.before, v.after))};
  const auto hit = project_onto_curve(side.around.mesh.nodes, other.curve, line);
  const Vec2 place = hit ? Vec2(x + hit->distance * line.n) : x;
  for (const Vertex& w : vertices_of(other.curve))
    if ((other.position(w) - place).norm() < at_one_place * edge) return other.corner(w);
  if (!hit) return {};
  return Corner{wedge(straight, other.law), false, edge_length(other.around.mesh.nodes, other.curve.edges[hit->edge])};
}

Meeting meeting_of(const Corner& a, const Corner& b, bool one_curve) {
  if (a.end && b.end) return Meeting::ends;
  if (a.end || b.end) return Meeting::corner;
  const double turn = std::max(std::abs(a.wedge.angle - straight), std::abs(b.wedge.angle - straight));
  const double jump = std::abs(2 * straight - a.wedge.angle - b.wedge.angle);
  return one_curve || jump <= one_kink * turn ? Meeting::kink : Meeting::corner;
}

// One kink of both, that of the sharper one if the other's mesh misses it.
void fit_kink(Wedge& a, Wedge& b) {
  if (std::abs(a.angle - straight) > std::abs(b.angle - straight))
    b.angle = 2 * straight - a.angle;
  else
    a.angle = 2 * straight - b.angle;
}

Wedge half_of(Wedge w) {
  w.angle /= 2;
  w.outer = Face::symmetric;
  return w;
}

// Amplitude of the logarithm that a jump of the gap's slope makes, with the compliances 8 / E' of both bodies: E* jump
// / 2 pi under a wedge, E* jump / 4 under a cone (Johnson 1985, sections 5.2 and 5.3); the larger.
double log_amplitude(const Wedge& a, const Wedge& b, double jump) {
  return 2 * std::abs(jump) / (a.compliance() + b.compliance());
}

// A joint of a fan of sliding ones.
struct FanJoint {
  Fan fan;
  std::size_t joint;
};

// All bodies in contact at a place, each with the next, from one whose first face is free of contact, and the joint of
// the place's own two. Nothing where they are all.
std::optional<FanJoint> fan_at(const ContactPlace& place, const std::vector<const ContactPlace*>& all) {
  struct Next {
    int body;
    const Corner *before, *after;
  };
  std::map<int, Next> next;
  std::map<int, int> previous;
  for (const ContactPlace* at : all)
    for (const int k : {0, 1}) {
      if (!at->joined[k] || at->soft) continue;
      const int body = at->bodies[k], other = at->bodies[1 - k];
      const auto after = next.try_emplace(body, other, &at->corners[k], &at->corners[1 - k]).first;
      const auto before = previous.try_emplace(other, body).first;
      if (after->second.body != other || before->second != body) return {};  // a body that is there twice
    }
  if (place.soft || next.size() < 2) return {};
  const int own = place.bodies[place.joined[0] ? 0 : 1];
  int start = own;
  for (auto at = previous.find(start); at != previous.end() && at->second != own; at = previous.find(start))
    start = at->second;
  FanJoint found{};
  for (int body = start; next.contains(body);) {
    const auto& [other, before, after] = next.at(body);
    if (body == own) found.joint = found.fan.joints.size();
    if (body == start) {
      found.fan.wedges.push_back(before->wedge);
      found.fan.first = before->wedge.outer;
    }
    found.fan.joints.push_back(Joint::sliding);
    if (other == start) break;
    found.fan.wedges.push_back(after->wedge);
    found.fan.last = after->wedge.outer;
    body = other;
  }
  if (found.fan.wedges.size() < 3) return {};
  return found;
}

SingularPoint singular_point(const ContactPlace& place, const std::optional<FanJoint>& several, TipTable& tips) {
  const auto& [a, b] = place.corners;
  SingularPoint point{place.position,    std::max(a.edge, b.edge), 1, 1, meeting_of(a, b, place.one_curve),
                      {a.wedge, b.wedge}};
  auto& [first, second] = point.wedges;
  TipExponents found;
  double jump = 0, given_jump = 0;
  if (several) {
    found = tips.find(several->fan, several->joint);
  } else if (point.meeting == Meeting::kink) {
    fit_kink(first, second);
    if (const double turn = std::abs(first.angle - straight); turn > least_shared_kink)
      found = tips.find(kink_fan(first, second), 0);
    else
      point.small_turn = turn;
  } else if (!a.end && !b.end && place.joined[0] && place.joined[1]) {
    found = tips.find(end_fan(half_of(first), half_of(second)), 0);
    jump = 2 * straight - first.angle - second.angle;
  } else {
    found = tips.find(end_fan(first, second), 0);
    if (a.end && b.end && first.outer == Face::symmetric && second.outer == Face::symmetric) {
      jump = 2 * (straight - first.angle - second.angle);
      given_jump = 2 * place.given_slope;
    }
  }
  if (found.stress.real() <= singular_limit) point.exponent = found.stress.real();
  if (found.pressure.real() <= singular_limit) point.pressure_exponent = found.pressure.real();
  if (place.one_curve || std::abs(jump) <= 2 * (a.error + b.error)) jump = 0;
  if (point.pressure_exponent == 1) point.log_pressure = log_amplitude(first, second, jump + given_jump);
  if (point.exponent == 1 && point.log_pressure == 0 && (a.end || b.end))
    point.small_power = found.pressure.real() < 1 ? found.pressure.real() - 1 : found.falling - 1;
  return point;
}

// The tip of a crack whose faces touch: modes that slide press nothing between bodies that are alike; between others p
// has no limit either (Comninou 1977).
SingularPoint crack_tip(const ContactPlace& place) {
  const auto& [a, b] = place.corners;
  const bool alike = a.wedge.shear == b.wedge.shear && a.wedge.kolosov == b.wedge.kolosov;
  return {place.position, std::max(a.edge, b.edge), 0.5, alike ? 1 : 0.5, Meeting::tip, {a.wedge, b.wedge}};
}

}  // namespace

std::vector<ContactPlace> contact_places(const Surroundings& around, const Curve& first, const Curve& second,
                                         const ContactReach& reach, const GivenGap& given) {
  const LineSide sides[] = {{around, first}, {around, second}};
  std::vector<ContactPlace> places;
  std::vector<int> seen;  // vertices of the second curve that face one of the first
  for (const int k : {0, 1}) {
    const std::vector<Vertex> vertices = vertices_of(sides[k].curve);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Vertex& v = vertices[i];
      const Reach& at = reach[k][i];
      if (!at.any() || (!v.is_end() && !sides[k].is_kink(v))) continue;
      if (k == 1 && std::ranges::count(seen, v.node) > 0) continue;
      const auto opposite = facing(sides[k], v, sides[1 - k]);
      if (!opposite) continue;
      if (k == 0) seen.push_back(opposite->node);
      ContactPlace place{.position = sides[k].position(v),
                         .bodies = {first.body, second.body},
                         .corners = {sides[k].corner(v), *opposite},
                         .joined = {at.before && v.before >= 0, at.after && v.after >= 0},
                         .one_curve = given.one_curve,
                         .given_slope = k == 0 && v.is_end() ? given.end_slopes[i == 0 ? 0 : 1] : 0};
      if (k == 1) {
        std::swap(place.corners[0], place.corners[1]);
        std::swap(place.joined[0], place.joined[1]);
      }
      places.push_back(place);
    }
  }
  return places;
}

std::vector<std::vector<SingularPoint>> singular_points(const std::vector<std::vector<ContactPlace>>& of_pairs,
                                                        TipTable& tips, int threads) {
  std::vector<const ContactPlace*> all;
  std::vector<Box> boxes;
  for (const auto& places : of_pairs)
    for (const ContactPlace& place : places) {
      const Vec2 near = Vec2::Constant(at_one_place * std::max(place.corners[0].edge, place.corners[1].edge));
      all.push_back(&place);
      boxes.emplace_back(place.position - near, place.position + near);
    }
  const BoxIndex index(boxes);
  std::vector<std::vector<SingularPoint>> points(of_pairs.size());
  for_each_index(of_pairs.size(), threads, [&](std::size_t k) {
    for (const ContactPlace& place : of_pairs[k]) {
      std::vector<const ContactPlace*> here;
      for (const int i : index.meeting(Box(place.position))) here.push_back(all[i]);
      const SingularPoint point = place.is_tip() ? crack_tip(place) : singular_point(place, fan_at(place, here), tips);
      if (point.exponent <= singular_limit || point.log_pressure > 0 || point.small_power != 0 || point.small_turn > 0)
        points[k].push_back(point);
    }
  });
  return points;
}

}  // namespace mortise
