#include "contact/singular_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "base/parallel.hpp"
#include "base/vectors.hpp"
#include "mesh/box_index.hpp"

namespace mortise {
namespace {

// One kink of two bodies that slide across it is singular however little it turns (exponents near 0). Of those that
// turn by less it is how far the bodies slide that says whether anything is seen of it (error/sliding_kinks.hpp).
constexpr double least_shared_kink = 2 * straight / 180;

// Kinks of both bodies are one where their angles add up to 2 pi to this part of their turn: a rebuilt line's, of three
// nodes or more a side, are off by less.
constexpr double one_kink = 0.1;

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

// Of a wedge up to its bisector, or from there on.
Wedge half_of(Wedge w, bool second) {
  w.angle /= 2;
  if (second && w.first) *w.first += w.angle;
  w.outer = Face::symmetric;
  return w;
}

// Amplitude of the logarithm that a jump of the gap's slope makes: E* jump / 2 pi under a wedge, E* jump / 4 under a
// cone (Johnson 1985, sections 5.2 and 5.3); the larger.
double log_amplitude(const Wedge& a, const Wedge& b, double jump) {
  return std::abs(jump) / 4 / (1 / a.modulus + 1 / b.modulus);
}

// A body by its vertex at a place, -1 where it has none.
struct Member {
  int body, node;
  auto operator<=>(const Member&) const = default;
};

// The bodies at a place, counter-clockwise: what each one's last face is joined to.
class BodiesAround {
 public:
  explicit BodiesAround(const std::vector<const ContactPlace*>& places);

  struct Found {
    Fan fan;
    std::size_t joint;  // the place's own
    double error;       // of the fan's angles
    bool is_closed() const { return fan.joints.size() == fan.wedges.size(); }
  };
  // Those that are joined to a place's own two, from a free face on, else from one of them all around; bonded ones of
  // one material as one. Nothing where one is there twice.
  std::optional<Found> fan(const ContactPlace& place) const;

 private:
  struct Next {
    Member member;
    Joint joint;
  };
  // Members that are one body.
  struct AtNode {
    std::vector<BondedBody> bodies;
    bool from_first;  // as the first one's corner has them, else as the last one's
    std::optional<Vec2> before, after;
  };
  void see(const Corner& corner, int body, std::map<int, AtNode>& nodes);
  void join(const Member& member, const Member& other, Joint joint);
  Member member(const ContactPlace& place, int k) const;

  std::map<int, int> nodes_;  // of bodies
  std::map<Member, Next> next_;
  std::map<Member, Member> previous_;
  std::map<Member, Wedge> wedges_;
  double error_ = 0;
  bool is_clear_ = true;
};

BodiesAround::BodiesAround(const std::vector<const ContactPlace*>& places) {
  std::vector<const ContactPlace*> held;
  std::ranges::copy_if(places, std::back_inserter(held), [](const auto* p) { return !p->soft && !p->is_tip(); });
  for (const ContactPlace* place : held)
    for (const int k : {0, 1})
      if (place->corners[k].node >= 0) nodes_.try_emplace(place->bodies[k], place->corners[k].node);
  std::map<int, AtNode> nodes;
  for (const ContactPlace* place : held)
    for (const int k : {0, 1}) {
      see(place->corners[k], place->bodies[k], nodes);
      if (place->joined[k]) join(member(*place, k), member(*place, 1 - k), Joint::sliding);
    }
  for (auto& [node, at] : nodes) {
    if (at.before && at.after) {  // the angle between two curves, as they are drawn: the farther one was its mesh's
      double sum = 0;
      for (const BondedBody& b : at.bodies) sum += b.wedge.angle;
      const double missing = std::remainder(interior_angle(*at.before, *at.after) - sum, 2 * straight);
      Wedge& farther = (at.from_first ? at.bodies.back() : at.bodies.front()).wedge;
      farther.angle += missing;
      if (!at.from_first && farther.first) *farther.first -= missing;
    }
    for (std::size_t i = 0; i < at.bodies.size(); ++i) {
      const Member here{at.bodies[i].body, at.bodies[i].node};
      wedges_.emplace(here, at.bodies[i].wedge);
      if (i > 0) join({at.bodies[i - 1].body, at.bodies[i - 1].node}, here, Joint::bonded);
    }
  }
  for (const ContactPlace* place : held)  // those without a vertex
    for (const int k : {0, 1}) wedges_.try_emplace(member(*place, k), place->corners[k].wedge);
}

Member BodiesAround::member(const ContactPlace& place, int k) const {
  const int body = place.bodies[k], node = place.corners[k].node;
  const auto known = nodes_.find(body);
  return {body, node < 0 && known != nodes_.end() ? known->second : node};
}

void BodiesAround::see(const Corner& corner, int body, std::map<int, AtNode>& nodes) {
  error_ += corner.error;
  if (corner.node < 0) return;
  int first = corner.node;
  for (const BondedBody& b : corner.bonded)
    if (b.node >= 0) first = std::min(first, b.node);
  AtNode& at = nodes[first];
  if (at.bodies.empty()) {
    at.bodies = corner.bonded;
    at.from_first = corner.after.has_value();
    at.bodies.insert(at.from_first ? at.bodies.begin() : at.bodies.end(), {body, corner.node, corner.wedge, 0});
  }
  const auto own = std::ranges::find(at.bodies, corner.node, &BondedBody::node);
  const Eigen::Rotation2D<double> turn(own == at.bodies.end() ? 0 : own->turn);
  if (corner.before) at.before = turn * *corner.before;
  if (corner.after) at.after = turn * *corner.after;
}

void BodiesAround::join(const Member& member, const Member& other, Joint joint) {
  const auto next = next_.try_emplace(member, other, joint).first;
  const auto previous = previous_.try_emplace(other, member).first;
  if (next->second.member != other || previous->second != member) is_clear_ = false;
}

std::optional<BodiesAround::Found> BodiesAround::fan(const ContactPlace& place) const {
  if (!is_clear_) return {};
  const Member own = member(place, place.joined[0] ? 0 : 1);
  Member start = own;
  for (auto at = previous_.find(start); at != previous_.end() && at->second != own; at = previous_.find(start))
    start = at->second;
  Found found{{{wedges_.at(start)}, {}, wedges_.at(start).outer, wedges_.at(start).outer}, 0, error_};
  auto& [wedges, joints, first, last] = found.fan;
  for (auto at = next_.find(start); at != next_.end(); at = next_.find(at->second.member)) {
    const auto [member, joint] = at->second;
    if (at->first == own) found.joint = joints.size();
    if (member == start) {
      joints.push_back(joint);
      break;
    }
    const Wedge& wedge = wedges_.at(member);
    if (joint == Joint::bonded && wedges.back().goes_on_in(wedge)) {
      wedges.back().angle += wedge.angle;
    } else {
      wedges.push_back(wedge);
      joints.push_back(joint);
    }
    last = wedge.outer;
  }
  return found;
}

// A place with its two bodies as a fan of no others has them.
ContactPlace with_fan(ContactPlace place, const BodiesAround::Found& found) {
  for (const int k : {0, 1}) {
    const std::size_t i = (found.joint + (place.joined[0] ? k : 1 - k)) % 2;
    Corner& corner = place.corners[k];
    corner.wedge = found.fan.wedges[i];
    corner.wedge.outer = i == 0 ? found.fan.first : found.fan.last;
    corner.error = found.error;
    if (found.is_closed()) corner.end = false;
  }
  if (found.is_closed()) place.joined = {true, true};
  return place;
}

SingularPoint singular_point(const ContactPlace& drawn, const std::optional<BodiesAround::Found>& around,
                             TipTable& tips) {
  const bool of_two = !around || around->fan.wedges.size() == 2;
  const ContactPlace place = around && of_two ? with_fan(drawn, *around) : drawn;
  const auto& [a, b] = place.corners;
  SingularPoint point{place.position,    std::max(a.edge, b.edge), 1, 1, meeting_of(a, b, place.one_curve),
                      {a.wedge, b.wedge}};
  auto& [first, second] = point.wedges;
  TipExponents found;
  double jump = 0, given_jump = 0;
  double jump_error = a.error + b.error;
  if (!of_two) {
    found = tips.find(around->fan, around->joint);
    if (around->is_closed()) {
      jump = 2 * straight;
      for (const Wedge& w : around->fan.wedges) jump -= w.angle;
    }
    jump_error = around->error;
  } else if (point.meeting == Meeting::kink) {
    fit_kink(first, second);
    if (const double turn = std::abs(first.angle - straight); turn > least_shared_kink)
      found = tips.find(kink_fan(first, second), 0);
    else
      point.small_turn = turn;
  } else if (!a.end && !b.end && place.joined[0] && place.joined[1]) {
    found = tips.find(end_fan(half_of(first, true), half_of(second, false)), 0);
    jump = 2 * straight - first.angle - second.angle;
  } else {
    found = tips.find(place.joined[0] ? end_fan(first, second) : end_fan(second, first), 0);
    if (a.end && b.end && first.outer == Face::symmetric && second.outer == Face::symmetric) {
      jump = 2 * (straight - first.angle - second.angle);
      given_jump = 2 * place.given_slope;
    }
  }
  if (found.stress.real() <= singular_limit) point.exponent = found.stress.real();
  if (found.pressure.real() <= singular_limit) point.pressure_exponent = found.pressure.real();
  if (place.one_curve || std::abs(jump) <= 2 * jump_error) jump = 0;
  if (point.pressure_exponent == 1) point.log_pressure = log_amplitude(first, second, jump + given_jump);
  const bool ends = a.end || b.end || place.joined[0] != place.joined[1];
  if (point.exponent == 1 && point.log_pressure == 0 && ends)
    point.small_power = found.pressure.real() < 1 ? found.pressure.real() - 1 : found.falling - 1;
  return point;
}

using PlacesOfNodes = std::multimap<int, const ContactPlace*>;

bool is_turned(const BondedBody& b) { return b.turn != 0; }

// By their vertices, those at the cuts of sectors.
PlacesOfNodes turned_places(const std::vector<const ContactPlace*>& all) {
  PlacesOfNodes places;
  for (const ContactPlace* place : all)
    for (const Corner& corner : place->corners)
      if (std::ranges::any_of(corner.bonded, is_turned)) places.emplace(corner.node, place);
  return places;
}

// What is here of the next sector: it stands at the other cut.
void add_turned(const PlacesOfNodes& elsewhere, std::vector<const ContactPlace*>& here) {
  std::set<const ContactPlace*> added;
  for (const ContactPlace* place : here)
    for (const Corner& corner : place->corners)
      for (const BondedBody& b : corner.bonded) {
        if (!is_turned(b)) continue;
        const auto [first, last] = elsewhere.equal_range(b.node);
        for (auto at = first; at != last; ++at) added.insert(at->second);
      }
  here.insert(here.end(), added.begin(), added.end());
}

// Between the faces of a crack at its tip, radians or the slope of the gap.
double opening_at_tip(const ContactPlace& place) {
  const auto& [a, b] = place.corners;
  const auto& [ends, begins] = a.before ? std::tie(a, b) : std::tie(b, a);
  const double drawn = angle_between(*ends.before, -*begins.after);
  return (place.one_curve || drawn <= 2 * (a.error + b.error) ? 0 : drawn) + place.given_slope;
}

// The tip of a crack whose faces touch: modes that slide press nothing between bodies that are alike, faces that were
// apart press as a wedge does; between others p has no limit either (Comninou 1977).
SingularPoint crack_tip(const ContactPlace& place) {
  const auto& [a, b] = place.corners;
  const bool alike = a.wedge.is_alike(b.wedge);
  return {.position = place.position,
          .edge = std::max(a.edge, b.edge),
          .exponent = 0.5,
          .pressure_exponent = alike ? 1 : 0.5,
          .meeting = Meeting::tip,
          .wedges = {a.wedge, b.wedge},
          .log_pressure = alike ? log_amplitude(a.wedge, b.wedge, opening_at_tip(place)) : 0};
}

}  // namespace

std::vector<std::vector<SingularPoint>> singular_points(const std::vector<std::vector<ContactPlace>>& of_pairs,
                                                        TipTable& tips, int threads) {
  std::vector<const ContactPlace*> all;
  std::vector<Box> boxes;
  for (const auto& places : of_pairs)
    for (const ContactPlace& place : places) {
      const Vec2 near = Vec2::Constant(at_one_place * place.shortest);
      all.push_back(&place);
      boxes.emplace_back(place.position - near, place.position + near);
    }
  const BoxIndex index(boxes);
  const PlacesOfNodes elsewhere = turned_places(all);
  std::vector<std::vector<SingularPoint>> points(of_pairs.size());
  for_each_index(of_pairs.size(), threads, [&](std::size_t k) {
    for (const ContactPlace& place : of_pairs[k]) {
      std::vector<const ContactPlace*> here;
      for (const int i : index.meeting(Box(place.position))) here.push_back(all[i]);
      add_turned(elsewhere, here);
      const SingularPoint point = place.is_tip() ? crack_tip(place)
                                  : place.soft   ? singular_point(place, {}, tips)
                                                 : singular_point(place, BodiesAround(here).fan(place), tips);
      if (point.exponent <= singular_limit || point.log_pressure > 0 || point.small_power != 0 || point.small_turn > 0)
        points[k].push_back(point);
    }
  });
  return points;
}

}  // namespace mortise
