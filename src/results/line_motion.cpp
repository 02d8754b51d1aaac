#include "results/line_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/vectors.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

// A place of one side: where it was and by how much it moved, with the force there.
struct Moved {
  double force;
  Vec2 x, u;
};

Vec2 mean_place(const std::vector<Moved>& side) {
  Vec2 sum = Vec2::Zero();
  double force = 0;
  for (const Moved& m : side) {
    sum += m.force * m.x;
    force += m.force;
  }
  return sum / force;
}

// The angle of the turn about the means that takes the places nearest to where they have moved (Kabsch, in the plane:
// the sums of cross and of dot products are its sine and cosine).
double turn(const std::vector<Moved>& side) {
  const Vec2 centre = mean_place(side);
  double sine = 0, cosine = 0;  // the mean displacement drops out, as the arms' sum is zero
  for (const Moved& m : side) {
    const Vec2 arm = m.x - centre;
    sine += m.force * cross(arm, arm + m.u);
    cosine += m.force * arm.dot(arm + m.u);
  }
  return std::abs(std::atan2(sine, cosine));
}

// A turn about a centre.
struct Spin {
  Vec2 centre = Vec2::Zero();
  double angle = 0;  // radians

  Vec2 of_chord(const Vec2& chord) const { return angle * Vec2(-chord.y(), chord.x()); }
  Vec2 at(const Vec2& x) const { return of_chord(x - centre); }
};

// Where a curve's first vertex and those a third and two thirds on lie on a circle, its centre.
Vec2 centre_through(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 ab = b - a, ac = c - a;
  const Vec2 across = ab.squaredNorm() * ac - ac.squaredNorm() * ab;
  return a + Vec2(across.y(), -across.x()) / (2 * cross(ab, ac));
}

// That of a whole circle, in least squares: it takes the circle and its normals along themselves. None of other curves.
Spin spin_of(const Points& nodes, const Curve& curve, const VecX& u) {
  constexpr double digits = 1e-6;  // of the radius: as of a mesh file with few
  const std::size_t count = curve.edges.size();
  if (!curve.closed || count < 3) return {};
  const auto vertex = [&](std::size_t e) -> Vec2 { return nodes.row(curve.edges[e].nodes[0]).transpose(); };
  Spin spin{.centre = centre_through(vertex(0), vertex(count / 3), vertex(2 * count / 3))};
  const double radius = (vertex(0) - spin.centre).norm();
  Vec2 arms = Vec2::Zero(), moved = Vec2::Zero();
  double turned = 0, squares = 0;
  for (std::size_t e = 0; e < count; ++e) {
    const Vec2 arm = vertex(e) - spin.centre, by = u.segment<2>(2 * curve.edges[e].nodes[0]);
    if (!(std::abs(arm.norm() - radius) <= digits * radius)) return {};
    arms += arm;
    moved += by;
    turned += cross(arm, by);
    squares += arm.squaredNorm();
  }
  // With the translation that is nearest beside it.
  spin.angle = (turned - cross(arms, moved) / double(count)) / (squares - arms.squaredNorm() / double(count));
  return spin;
}

// By how much an edge turns, radians.
double rotation(const Vec2& chord, const Vec2& grown) { return angle_between(chord, chord + grown); }

// By which part of its length an edge grows or shrinks, to first order: the stretch of small displacements.
double stretch(const Vec2& chord, const Vec2& grown) { return std::abs(chord.dot(grown)) / chord.squaredNorm(); }

// Takes what the edge turns and stretches by beside its curve's spin, where that is more.
void take_edge(PlaceMotion& place, const Points& nodes, const VecX& u, const Edge& edge, const Spin& spin) {
  const Vec2 chord = (nodes.row(edge.nodes[1]) - nodes.row(edge.nodes[0])).transpose();
  const Vec2 grown = u.segment<2>(2 * edge.nodes[1]) - u.segment<2>(2 * edge.nodes[0]) - spin.of_chord(chord);
  place.turned = std::max(place.turned, rotation(chord, grown));
  place.stretched = std::max(place.stretched, stretch(chord, grown));
}

// Curvature of rings along their circles, 1 / length: none of plane models and of what faces along the axis.
double curvature_round_axis(const ContactPair& pair, const Vec2& x, const Vec2& normal) {
  return pair.geometry.model.axisymmetric() && x.x() > 0 ? std::abs(normal.x()) / x.x() : 0;
}

// Numbers loaded places in the order of their edges: one patch as long as no unloaded place and no edge lie between.
struct Patches {
  int last = -1;                   // the last patch
  int first_edge = -1, edge = -1;  // of the first place; of the last, -1 behind an unloaded one

  int take(int at) {
    if (last < 0) first_edge = at;
    if (edge < 0 || at > edge + 1) ++last;
    edge = at;
    return last;
  }
  void end() { edge = -1; }
  // Whether of a closed curve with so many edges the last one goes on as the first; no other is between them.
  bool meet(int edges) const { return last > 0 && first_edge == 0 && edge == edges - 1; }
};

// At which of its ends contact ends within the curve: where it does at one, p is half of an ellipse.
std::array<bool, 2> ends_within(const ContactResults& contact) {
  const double round_off = 1e-9 * contact.length;
  if (contact.length_in_contact > contact.length - round_off) return {false, false};
  if (!contact.ends) return {true, true};
  return {(*contact.ends)[0] > round_off, (*contact.ends)[1] < contact.length - round_off};
}

// What p that falls to zero at both ends as an ellipse is off by in L2, shifted by a part of its width.
double of_ellipse(double shift) {
  return shift > 0 ? std::min(1., shift * std::sqrt(3 * std::max(1., 0.9 - std::log(shift)))) : 0;
}

// How far a patch slides, and what of p it has.
struct Slide {
  double force = 0, square = 0, length = 0, slid = 0;
  Vec2 arms = Vec2::Zero();

  void add(const PlaceMotion& place, double weight) {
    force += weight;
    square += weight * place.p;
    length += place.ds;
    slid += weight * place.slid;
    arms += weight * place.position;
  }
  double part() const { return force > 0 ? std::abs(slid / force) / length : 0; }
};

// What p is off by in L2 that slides by a part of its length and ends at so many places within the curve.
double lost_by(double part, int ends) { return ends > 0 ? of_ellipse(part * ends / 2) : part; }

// The patch whose slide loses most of p, and what the slides of all lose, stress times root of length times depth.
// Between two patches both end within the curve.
std::pair<Slide, double> of_patches(const std::vector<Slide>& slides, const std::array<bool, 2>& within) {
  Slide worst = slides.front();
  double most = 0, lost = 0;
  for (std::size_t k = 0; k < slides.size(); ++k) {
    const int ends = (k > 0 || within[0]) + (k + 1 < slides.size() || within[1]);
    const double of_patch = lost_by(slides[k].part(), ends) * std::sqrt(slides[k].square);
    lost = std::hypot(lost, of_patch);
    if (!(of_patch > most)) continue;
    most = of_patch;
    worst = slides[k];
  }
  return {worst, lost};
}

}  // namespace

std::vector<PlaceMotion> place_motions(const Points& nodes, const ContactPair& pair, const ContactResults& contact,
                                       const VecX& u) {
  if (contact.length_in_contact == 0) return {};  // p is round-off
  const Spin spin = spin_of(nodes, pair.multiplier, u);
  const bool both_ways = pair.spec.condition != Condition::unilateral;  // tension too
  const double least = 1e-3 * largest_entry(contact.pressure);
  std::vector<PlaceMotion> places;
  Patches patches;
  for (const ContactPoint& c : pair.points) {
    const double signed_p = interpolate(pair, contact.pressure, {c.edge, c.xi});
    const double p = both_ways ? std::abs(signed_p) : signed_p;
    if (!(p > least)) {
      patches.end();
      continue;
    }
    const Edge &edge = pair.multiplier.edges[c.edge], &facing = pair.opposite.edges[c.opposite_edge];
    PlaceMotion& place = places.emplace_back(PlaceMotion{.position = edge_point(nodes, edge, c.xi).position,
                                                         .p = p,
                                                         .ds = c.ds,
                                                         .dA = c.dA,
                                                         .facing = edge_point(nodes, facing, c.eta).position,
                                                         .u = edge_value(u, edge, c.xi),
                                                         .facing_u = edge_value(u, facing, c.eta),
                                                         .slid = 0,
                                                         .curved = 0,
                                                         .turned = 0,
                                                         .stretched = 0,
                                                         .patch = patches.take(c.edge)});
    place.u -= spin.at(place.position);
    const Vec2 moved = place.facing_u - place.u;
    place.slid = cross(moved, c.normal);
    const double curvature = std::max(std::abs(pair.geometry.multiplier->at(c.edge, c.xi).curvature()),
                                      std::abs(pair.geometry.opposite->at(c.opposite_edge, c.eta).curvature()));
    place.curved = std::max(moved.norm() * curvature,
                            std::abs(moved.dot(c.normal)) * curvature_round_axis(pair, place.position, c.normal));
    take_edge(place, nodes, u, edge, spin);
    take_edge(place, nodes, u, facing, {});
  }
  if (pair.multiplier.closed && patches.meet(int(pair.multiplier.edges.size())))
    for (PlaceMotion& place : places)
      if (place.patch == patches.last) place.patch = 0;
  return places;
}

std::vector<std::pair<int, Vec2>> moved_by_spin(const Points& nodes, const Curve& curve, const VecX& u) {
  const Spin spin = spin_of(nodes, curve, u);
  std::vector<std::pair<int, Vec2>> moved;
  if (spin.angle == 0) return moved;
  for (const Edge& edge : curve.edges)
    for (int a = 0; a < edge.node_count; ++a)
      if (a != 1) moved.emplace_back(edge.nodes[a], spin.at(nodes.row(edge.nodes[a]).transpose()));
  return moved;
}

std::optional<LineMotion> line_motion(const Points& nodes, const ContactPair& pair, const ContactResults& contact,
                                      const VecX& u) {
  std::vector<Moved> side, other;
  std::vector<Slide> slides;
  Slide as_one;
  double curved = 0, strained = 0;
  for (const PlaceMotion& place : place_motions(nodes, pair, contact, u)) {
    const double weight = place.p * place.dA;
    side.push_back({weight, place.position, place.u});
    other.push_back({weight, place.facing, place.facing_u});
    as_one.add(place, weight);
    if (std::size_t(place.patch) >= slides.size()) slides.resize(place.patch + 1);
    slides[place.patch].add(place, weight);
    curved += weight * place.curved;
    const double off = std::min(1., std::max(place.turned * place.turned, place.stretched));
    strained += weight * off;
  }
  if (!(as_one.force > 0)) return {};
  const std::array<bool, 2> within = ends_within(contact);
  const auto [slide, shifted] = of_patches(slides, within);
  return LineMotion{.turned = std::max(turn(side), turn(other)),
                    .slid = slide.part(),
                    .slid_at = slide.arms / slide.force,
                    .shifted = shifted / std::sqrt(as_one.square),
                    .slid_as_one = as_one.part(),
                    .shifted_as_one = lost_by(as_one.part(), within[0] + within[1]),
                    .curved = curved / as_one.force,
                    .strained = strained / as_one.force,
                    .position = mean_place(side),
                    .norm = std::sqrt(as_one.square)};
}

}  // namespace mortise
