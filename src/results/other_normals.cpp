#include "results/other_normals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/vectors.hpp"
#include "contact/coupling.hpp"
#include "contact/least_gap.hpp"
#include "fem/edges.hpp"
#include "results/line_motion.hpp"

namespace mortise {
namespace {

Vec2 facing_normal(const ContactPair& pair, const ContactPoint& point) {
  return -pair.geometry.opposite->at(point.opposite_edge, point.eta).normal();
}

double pressure_at(const ContactPair& pair, const VecX& values, const ContactPoint& point) {
  return interpolate(pair, values, {point.edge, point.xi});
}

// Faces that give way have no normals that count, nor have facets those of a curve.
bool is_pressed(const ContactPair& pair, const ContactResults& contact) {
  return pair.geometry.normals && pair.geometry.opposite && !pair.spec.stiffness && contact.length_in_contact > 0;
}

// Hardly less than what the other normals change p by, over p in L2. Of a half-plane a gap g makes p of E* / 2 times
// the Hilbert transform of g', which has its norm (Johnson 1985, section 2.3), and one that is the same all along the
// length l of the contact about E* g / l; of 660 pairs of crowns, wheels, coatings, o-rings and press fits p changed by
// up to 4.7 times both. Along flanks that lean by b the forces are turned by the angle a between the normals, which
// changes p by a / tan b.
double at_most(const Problem& p, const ContactPair& pair, const VecX& pressure, const VecX& u) {
  constexpr double most_of_half_plane = 10;
  constexpr double least_lean = 0.05;                   // about 3 degrees
  const double least = 1e-3 * largest_entry(pressure);  // as of place_motions
  double squares = 0, slopes = 0, gap = 0, length = 0, area = 0;
  double left = -1, right = 1;  // the turns nearest to none either way
  for (const auto& of_edge : edge_by_edge(pair.points)) {
    double low = std::numeric_limits<double>::infinity(), high = -low, ds = 0, dA = 0;
    for (const ContactPoint& point : of_edge) {
      const double p_here = pressure_at(pair, pressure, point);
      if (std::abs(p_here) <= least) continue;
      const Vec2 other = facing_normal(pair, point);
      const double turn = cross(point.normal, other), g = parted(u, pair, point).dot(other - point.normal);
      (turn < 0 ? left : right) = turn < 0 ? std::max(left, turn) : std::min(right, turn);
      low = std::min(low, g);
      high = std::max(high, g);
      ds += point.ds;
      dA += point.dA;
      squares += p_here * p_here * point.dA;
    }
    if (ds == 0) continue;
    slopes += std::pow((high - low) / ds, 2) * dA;
    gap = std::max({gap, std::abs(low), std::abs(high)});
    length += ds;
    area += dA;
  }
  if (squares == 0) return 0;
  const std::vector<ElasticLaw>& laws = p.discretisation.laws;
  const double modulus = contact_modulus(laws[pair.multiplier.body], laws[pair.opposite.body]);
  // Normals that agree somewhere differ beside it one way and the other, and so are forces turned.
  const bool agree = left > -1 && right < 1;
  const double turned = agree ? 0 : std::min(-left, right) / least_lean;
  const double half_plane = modulus * (std::sqrt(slopes) / 2 + gap / length * std::sqrt(area)) / std::sqrt(squares);
  return most_of_half_plane * half_plane + turned;
}

// B of the pair with the other side's normals less its own; nothing where other rows have support.
std::optional<SparseRows> change_of_rows(const Problem& p, const ContactPair& pair) {
  ContactInterface other = pair;
  for (ContactPoint& point : other.points) point.normal = facing_normal(pair, point);
  const Coupling coupling =
      couple(p.mesh, other, p.discretisation.system.constraints, {p.method.multipliers, pair.spec.initial_gap});
  if (coupling.row != pair.coupling.row) return {};
  return coupling.B - pair.coupling.B;
}

OtherNormals summed_up(const Points& nodes, const ContactPair& pair, const VecX& pressure, const VecX& change) {
  const double most =
      pair.spec.condition == Condition::unilateral ? std::numbers::sqrt2 : std::numeric_limits<double>::infinity();
  OtherNormals found;
  double squares = 0, whole = 0, largest = 0;
  for (const ContactPoint& point : pair.points) {
    const double p = std::abs(pressure_at(pair, pressure, point));
    const double by = std::min(std::abs(pressure_at(pair, change, point)), most * p);
    squares += by * by * point.dA;
    whole += p * p * point.dA;
    const double angle = angle_between(point.normal, facing_normal(pair, point));
    if (!(by * angle > largest)) continue;  // on a flat beside a round p changes, too
    largest = by * angle;
    found.position = edge_point(nodes, pair.multiplier.edges[point.edge], point.xi).position;
    found.angle = angle;
  }
  found.part = std::sqrt(squares / whole);
  return found;
}

}  // namespace

std::vector<std::optional<OtherNormals>> other_normals(const Results& r, double least) {
  const Problem& p = r.problem;
  const Solution& solution = r.solution;
  std::vector<std::optional<OtherNormals>> found(p.pairs.size());
  if (!solution.factor) return found;
  VecX u = solution.u;
  // Calls visit(pair, its results) for each that is pressed, with the spin of its multiplier side taken out of u.
  const auto for_each_pressed = [&](auto visit) {
    for (std::size_t k = 0; k < p.pairs.size(); ++k) {
      const ContactPair& pair = p.pairs[k];
      if (!is_pressed(pair, r.recovery.contacts[k])) continue;
      const auto spin = moved_by_spin(p.mesh.nodes, pair.multiplier, solution.u);
      for (const auto& [node, by] : spin) u.segment<2>(2 * node) -= by;
      visit(pair, r.recovery.contacts[k], found[k]);
      for (const auto& [node, by] : spin) u.segment<2>(2 * node) = solution.u.segment<2>(2 * node);
    }
  };
  bool any = false;
  for_each_pressed([&](const ContactPair& pair, const ContactResults& contact, auto& of_pair) {
    of_pair.emplace();
    any = any || at_most(p, pair, contact.pressure, u) > least;
  });
  if (!any) return found;
  VecX load = VecX::Zero(u.size()), gap = VecX::Zero(solution.lambda.size());
  for_each_pressed([&](const ContactPair& pair, const ContactResults&, auto& of_pair) {
    const auto change = change_of_rows(p, pair);
    if (!change) return of_pair.reset();
    const Eigen::Index rows = change->rows();
    load -= change->transpose() * solution.lambda.segment(pair.first_row, rows);
    gap.segment(pair.first_row, rows) -= *change * u;
  });
  const VecX change = solution.factor->multipliers(gap, load);
  for (std::size_t k = 0; k < p.pairs.size(); ++k) {
    if (!found[k]) continue;
    const ContactPair& pair = p.pairs[k];
    const VecX values = multiplier_values(pair.coupling, change.segment(pair.first_row, pair.coupling.B.rows()));
    found[k] = summed_up(p.mesh.nodes, pair, r.recovery.contacts[k].pressure, values);
  }
  return found;
}

}  // namespace mortise
