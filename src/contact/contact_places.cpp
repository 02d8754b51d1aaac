#include "contact/contact_places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vectors.hpp"
#include "contact/projection.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

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
  double shortest_at(const Vertex& v) const {
    const auto length = [&](int e) { return edge_length(around.mesh.nodes, curve.edges[e]); };
    return v.is_end() ? edge_at(v) : std::min(length(v.before), length(v.after));
  }
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
  const double first = angle_of(v.after >= 0 ? after(v) : Vec2(-before(v)));
  Corner corner{wedge(straight - turn(v), law, Face::free, first), v.is_end(), edge_at(v), turn_error(v), v.node};
  if (v.before >= 0) corner.before = before(v);
  if (v.after >= 0) corner.after = after(v);
  if (!v.is_end()) return corner;
  const bool begins = v.after >= 0;
  const Edge& edge = curve.edges[begins ? v.after : v.before];
  const BodiesAtVertex at = bodies_at(around, {v.node, edge.nodes[begins ? 1 : 0]});
  if (at.bodies.empty()) return corner;
  for (const BodyAtVertex& b : at.bodies)
    corner.bonded.push_back({b.body, b.node, wedge(b.angle, around.laws[b.body], Face::free, b.first), b.turn});
  Wedge& last = (begins ? corner.bonded.back() : corner.bonded.front()).wedge;
  last.outer = face_at(around, begins ? at.last : at.first);
  const auto own = begins ? corner.bonded.begin() : corner.bonded.end() - 1;
  const Vec2 drawn = begins ? *corner.after : *corner.before,
             meshed = edge_point(around.mesh.nodes, edge, begins ? -1 : 1).tangent;
  const double off = std::atan2(cross(drawn, meshed), drawn.dot(meshed));
  corner.wedge = own->wedge;
  corner.wedge.angle += begins ? off : -off;
  if (begins && corner.wedge.first) corner.wedge.first = first;
  corner.bonded.erase(own);
  return corner;
}

// Ends are flush to this part of an edge: what coordinates of six digits leave of one a hundredth as long as the body.
// A step that is drawn, however small, is where p has no limit.
constexpr double flush = 1e-4;

// The body on the other side of a vertex, near it or far: where the normal there meets it.
std::optional<Corner> facing(const LineSide& side, const Vertex& v, const LineSide& other) {
  const Vec2 x = side.position(v);
  const double edge = side.edge_at(v);
  const Line line{x, side.normal(v), deepest_overlap(side.curve, std::max(v.before, v.after))};
  const auto hit = project_onto_curve(side.around.mesh.nodes, other.curve, line);
  const Vec2 place = hit ? Vec2(x + hit->distance * line.n) : x;
  for (const Vertex& w : vertices_of(other.curve))
    if ((other.position(w) - place).norm() < flush * edge) return other.corner(w);
  if (!hit) return {};
  const Edge& met = other.curve.edges[hit->edge];
  const double first = angle_of(edge_point(other.around.mesh.nodes, met, hit->xi).tangent);
  return Corner{wedge(straight, other.law, Face::free, first), false, edge_length(other.around.mesh.nodes, met)};
}

}  // namespace

bool ContactPlace::is_tip() const {
  const auto& [a, b] = corners;
  if (a.node < 0 || a.node == b.node) return a.node >= 0;
  const auto is_alike = [&](const BondedBody& one) { return one.wedge.is_alike(a.wedge); };
  return std::ranges::count(a.bonded, b.node, &BondedBody::node) > 0 && std::ranges::all_of(a.bonded, is_alike);
}

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
                         .given_slope = k == 0 && v.is_end() ? given.end_slopes[i == 0 ? 0 : 1] : 0,
                         .shortest = sides[k].shortest_at(v)};
      if (k == 1) {
        std::swap(place.corners[0], place.corners[1]);
        std::swap(place.joined[0], place.joined[1]);
      }
      places.push_back(place);
    }
  }
  return places;
}

}  // namespace mortise
