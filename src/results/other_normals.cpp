#include "results/other_normals.hpp"

#include <algorithm>
#include <cmath>

#include "base/vectors.hpp"
#include "contact/coupling.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

// Radians: on flanks that lean by 3 degrees the pressures change by twenty times as much, which is the least that is
// told of.
constexpr double least_angle = 5e-4;

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

// Where the normals of a loaded line agree somewhere, perhaps between its points, they differ beside it by what the
// curvatures do, one way and the other.
bool agree_somewhere(const ContactPair& pair, const VecX& pressure) {
  const double least = 1e-3 * largest_entry(pressure);  // as of place_motions
  bool left = false, right = false;
  for (const ContactPoint& point : pair.points) {
    if (std::abs(pressure_at(pair, pressure, point)) <= least) continue;
    const double turn = cross(point.normal, facing_normal(pair, point));  // the sine of the angle between them
    left = left || turn > -least_angle;
    right = right || turn < least_angle;
  }
  return left && right;
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

// By means: on the few rows of a coarse mesh p by itself changes by what moves the force within them.
OtherNormals summed_up(const Points& nodes, const ContactPair& pair, const VecX& pressure, const VecX& change) {
  OtherNormals found{0, Vec2::Zero(), 0};
  double off = 0, whole = 0, most = 0;
  for (const ContactPoint& point : pair.points) {
    const double p = std::abs(pressure_at(pair, pressure, point));
    off += pressure_at(pair, change, point) * point.dA;
    whole += p * point.dA;
    if (p <= most) continue;
    most = p;
    found.position = edge_point(nodes, pair.multiplier.edges[point.edge], point.xi).position;
    found.angle = angle_between(point.normal, facing_normal(pair, point));
  }
  found.part = std::abs(off) / whole;
  return found;
}

}  // namespace

std::vector<std::optional<OtherNormals>> other_normals(const Results& r) {
  const Problem& p = r.problem;
  const Solution& solution = r.solution;
  std::vector<std::optional<OtherNormals>> found(p.pairs.size());
  if (!solution.factor) return found;
  VecX load = VecX::Zero(solution.u.size()), gap = VecX::Zero(solution.lambda.size());
  bool any = false;
  for (std::size_t k = 0; k < p.pairs.size(); ++k) {
    const ContactPair& pair = p.pairs[k];
    const ContactResults& contact = r.recovery.contacts[k];
    if (!is_pressed(pair, contact) || agree_somewhere(pair, contact.pressure)) continue;
    const auto change = change_of_rows(p, pair);
    if (!change) continue;
    const Eigen::Index rows = change->rows();
    load -= change->transpose() * solution.lambda.segment(pair.first_row, rows);
    gap.segment(pair.first_row, rows) -= *change * solution.u;
    any = true;
  }
  if (!any) return found;
  const VecX change = solution.factor->answers(gap, load).mu;
  for (std::size_t k = 0; k < p.pairs.size(); ++k) {
    const ContactPair& pair = p.pairs[k];
    if (!is_pressed(pair, r.recovery.contacts[k])) continue;
    const VecX values = multiplier_values(pair.coupling, change.segment(pair.first_row, pair.coupling.B.rows()));
    if (values.any()) found[k] = summed_up(p.mesh.nodes, pair, r.recovery.contacts[k].pressure, values);
  }
  return found;
}

}  // namespace mortise
