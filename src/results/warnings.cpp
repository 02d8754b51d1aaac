#include "results/warnings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "base/printable.hpp"
#include "contact/coupling.hpp"
#include "contact/curve_resolution.hpp"
#include "fem/edges.hpp"
#include "results/checks.hpp"
#include "results/point_supports.hpp"

namespace mortise {
namespace {

using Lines = std::vector<std::string>;

void warn_of_active_set(const Results& r, Lines& lines) {
  const std::vector<int>& rows = r.solution.infeasible;
  if (rows.empty()) return;
  const std::vector<int> nodes = row_nodes(r.problem.pairs);
  std::string places;
  for (std::size_t i = 0; i < std::min<std::size_t>(rows.size(), 5); ++i)
    places += (i > 0 ? ", " : "") + near_point(r.problem.mesh.nodes.row(nodes[rows[i]]).transpose());
  if (rows.size() > 5) places += " and " + std::to_string(rows.size() - 5) + " more";
  lines.push_back("the active set did not converge in " + std::to_string(r.solution.steps.size()) + " steps: contact " +
                  places + " still changes");
}

// What the iteration did not reach, and what would.
void warn_of_iteration(const Solution& s, Lines& lines) {
  if (!s.iteration || s.status == SolveStatus::converged) return;
  const Iteration& i = *s.iteration;
  const Residuals last = i.history.back().residuals;
  std::ostringstream text;
  text << i.method << " (acceleration " << to_string(i.acceleration) << (i.settings.empty() ? "" : ", ") << i.settings
       << ") " << (s.status == SolveStatus::diverged ? "diverges" : "did not converge") << ": after " << i.steps
       << " steps the residuals are " << largest(last.kinematic, s.constraint_residual) << " (kinematic) and "
       << largest(last.force, s.force_residual) << " (force), where " << i.tolerance
       << " was asked for; a step multiplies them by " << i.convergence_rate;
  if (!i.advice.empty()) text << "; " << i.advice;
  lines.push_back(text.str());
}

void warn_of_what_is_not_finite(const Results& r, Lines& lines) {
  if (const std::string what = not_finite(r); !what.empty())
    lines.push_back(
        "not finite: " + what +
        "; discard these results. Expected loads, prescribed displacements and settings of reasonable size, and an "
        "iteration that converges");
}

// "x = 0.1 ... 0.9, y = 0.2"
std::string range(const std::vector<Vec2>& places) {
  Eigen::AlignedBox2d box;
  for (const Vec2& x : places) box.extend(x);
  std::ostringstream text;
  const auto write = [&](const char* name, double from, double to) {
    text << name << from + 0.0;
    if (to - from > 1e-6 * box.diagonal().norm()) text << " ... " << to + 0.0;
  };
  write("x = ", box.min().x(), box.max().x());
  write(", y = ", box.min().y(), box.max().y());
  return text.str();
}

// One line for each reason; those that face nothing have none.
// What a mesh's edges face is of no account where nothing presses, and on meshes that an accuracy has found nobody can
// help it.
void warn_of_dropped(const ContactPair& pair, const ContactResults& contact, const Results& r, Lines& lines) {
  std::map<std::string, std::vector<Vec2>> places;
  for (const DroppedMultiplier& d : pair.coupling.dropped) {
    const bool harmless = d.by_mesh && (r.problem.accuracy || contact.pressure(d.multiplier) == 0);
    if (!d.reason.empty() && (d.faces || !pair.spec.found) && !harmless)
      places[d.reason].push_back(r.problem.mesh.nodes.row(pair.coupling.node[d.multiplier]).transpose());
  }
  for (const auto& [reason, at] : places)
    lines.push_back(pair.spec.key + ": " + std::to_string(at.size()) + (at.size() == 1 ? " node of '" : " nodes of '") +
                    pair.spec.multipliers_on + "' (" + range(at) + ") " + reason);
}

void warn_of_gap(const ContactPair& pair, const Results& r, double displacement, Lines& lines) {
  const double low = pair.coupling.gap_min, high = pair.coupling.gap_max;
  if (pair.spec.initial_gap != InitialGap::closed || std::max(-low, high) <= 0.01 * displacement) return;
  if (!is_drawn(pair) && !open_place(r.problem.mesh.nodes, pair, 1e-6)) return;
  lines.push_back(worded(pair.spec.key, ": initial_gap = \"closed\" leaves out gaps of ", low, " ... ", high,
                         ", which are not small against the displacements (up to ", displacement,
                         "); a clearance or an interference that is meant needs the default, initial_gap = \"curve\""));
}

// Curves that touch although the drawing has them further apart than they are long: meant were others, or other units.
void warn_of_drawn_gap(const ContactPair& pair, const ContactResults& contact, const Results& r, Lines& lines) {
  const InitialGap gap = pair.spec.initial_gap;
  if ((gap != InitialGap::curve && gap != InitialGap::measured) || !(pair.spec.clearance == Field())) return;
  const Points& nodes = r.problem.mesh.nodes;
  const double length = std::min(curve_length(nodes, pair.multiplier), curve_length(nodes, pair.opposite));
  if (contact.length_in_contact == 0 || pair.coupling.gap_min <= length) return;
  std::ostringstream text;
  text.precision(3);
  text << pair.spec.key << ": '" << pair.spec.between[0] << "' and '" << pair.spec.between[1]
       << "' touch, but are drawn " << pair.coupling.gap_min << " apart, " << pair.coupling.gap_min / length
       << " times their length; expected bodies drawn where they touch";
  lines.push_back(text.str());
}

// Sides that press one another by a gap that is given, where the drawing parts them by far less at one end than at the
// other: meant was a gap beside the drawn one.
void warn_of_given_gap(const ContactPair& pair, const ContactResults& contact, const Results& r, Lines& lines) {
  if (pair.spec.initial_gap != InitialGap::given || contact.length_in_contact == 0) return;
  constexpr double steep = 0.1;  // of the length in contact: another shape than the given one
  const double least = 1e-3 * largest_entry(contact.pressure);  // as of other_normals
  double low = std::numeric_limits<double>::infinity(), high = -low, beyond = 0;
  for (const ContactPoint& point : pair.points) {
    if (!(interpolate(pair, contact.pressure, {point.edge, point.xi}) > least)) continue;
    const Points& nodes = r.problem.mesh.nodes;
    const double drawn = (edge_point(nodes, pair.opposite.edges[point.opposite_edge], point.eta).position -
                          edge_point(nodes, pair.multiplier.edges[point.edge], point.xi).position)
                             .dot(point.normal);
    low = std::min(low, drawn - point.gap);
    high = std::max(high, drawn - point.gap);
    beyond = std::max(beyond, drawn);
  }
  if (!(high - low > steep * contact.length_in_contact)) return;
  lines.push_back(worded(pair.spec.key, ".initial_gap stands for the drawn gap, which is up to ", beyond, " where '",
                         pair.spec.between[0], "' and '", pair.spec.between[1],
                         "' press one another; expected clearance, which adds to it"));
}

// A geometry that the file draws and contact cannot use.
void warn_of_geometry(const ContactPair& pair, const Results& r, Lines& lines) {
  for (const Curve* curve : {&pair.multiplier, &pair.opposite})
    if (const Boundary& boundary = r.problem.mesh.boundaries[curve->boundary]; !boundary.undrawn.empty())
      lines.push_back(pair.spec.key + ": the drawn curve '" + boundary.name + "' is not used, as " + boundary.undrawn +
                      ": gaps and normals are those of a smooth curve through the nodes");
}

int degrees(double angle) { return int(std::lround(angle * 180 / std::numbers::pi)); }

// Both meshes must follow the contact line: its curvature, and its kinks (docs/stability.md, geometry).
void warn_of_shape(const ContactPair& pair, const Results& r, Lines& lines) {
  const auto name = [&](const Curve& curve) { return "'" + r.problem.mesh.boundaries[curve.boundary].name + "'"; };
  for (const auto& [curve, other] :
       {std::pair{&pair.multiplier, &pair.opposite}, std::pair{&pair.opposite, &pair.multiplier}}) {
    const Turn sharpest = sharpest_edge(r.problem.mesh.nodes, *curve);
    if (degrees(sharpest.angle) > 30)
      lines.push_back(pair.spec.key + ": an edge of " + name(*curve) + " " + near_point(sharpest.position) +
                      " turns by " + std::to_string(degrees(sharpest.angle)) +
                      " degrees: the mesh is too coarse for the curve; expected at most 30");
    // A gap that is drawn is meant: a corner may stand on a flat side.
    if (pair.spec.initial_gap != InitialGap::closed) continue;
    if (const auto missed = missed_kink(r.problem.mesh.nodes, *curve, *other))
      lines.push_back(pair.spec.key + ": " + name(*curve) + " has a kink of " + std::to_string(degrees(missed->angle)) +
                      " degrees " + near_point(missed->position) + ", where " + name(*other) +
                      " has no vertex and cuts it short; expected a vertex of both meshes there");
  }
}

// Positions are rounded to this part of themselves.
constexpr double round_off = std::numeric_limits<double>::epsilon();

// Where no load, no prescribed displacement and no strain acts, and no overlap is more than round-off of the places.
bool moves_nothing(const Results& r) {
  const SaddlePointSystem& s = r.problem.discretisation.system;
  const double farthest = r.problem.mesh.nodes.cwiseAbs().maxCoeff();
  return largest_entry(s.f) == 0 && largest_entry(s.constraints.value) == 0 &&
         largest_entry(r.solution.u) <= round_off * farthest;
}

// A load that was forgotten.
void warn_of_no_load(const Results& r, Lines& lines) {
  if (moves_nothing(r))
    lines.push_back(
        "nothing loads the scene: all displacements, stresses and pressures are zero; expected a load (boundary, "
        "body_force), a prescribed displacement other than 0, an initial strain or bodies drawn with an overlap");
}

// A gap is a difference of positions: far from the origin it is round-off.
void warn_of_far_origin(const ContactPair& pair, const Results& r, Lines& lines) {
  if (pair.spec.initial_gap == InitialGap::closed || moves_nothing(r)) return;
  const double farthest = r.problem.mesh.nodes.cwiseAbs().maxCoeff();
  const double gap = std::max(std::abs(pair.coupling.gap_min), std::abs(pair.coupling.gap_max));
  const double size = std::max(gap, r.solution.u.cwiseAbs().maxCoeff());
  if (round_off * farthest <= 1e-8 * size) return;
  lines.push_back(worded(pair.spec.key, ": coordinates up to ", farthest, " are rounded to about ",
                         round_off * farthest, ", but gaps and displacements are only up to ", size,
                         "; expected an origin near the bodies"));
}

// What Poisson's ratio does to a body's elements, and what would not: docs/stability.md, near incompressibility.
std::string locking(bool linear, bool quadrilaterals) {
  if (linear)
    return "its linear elements lock, displacements are too small; expected quadratic elements, or poisson < 0.4";
  const std::string swings = "stresses inside swing from element to element";
  if (quadrilaterals) return swings + "; expected 6-node triangles and a finer mesh, or poisson < 0.49";
  return swings +
         ", which displacements and contact pressures of 6-node triangles do not; expected a finer mesh where "
         "stresses inside are read";
}

// Poisson's ratio; of a stiffness of any kind that of a material as stiff against a change of area in the plane, and
// against the shear that it resists most, as stiff fibres are no such thing: mu = (1 - 2 nu) (lambda + mu).
double poisson_of(const Mat4& stiffness) {
  const double all = (stiffness(0, 0) + stiffness(1, 1)) / 4, coupled = stiffness(0, 1) / 2;
  return (1 - std::max(all - coupled, stiffness(3, 3)) / (all + coupled)) / 2;
}

// Poisson's ratio from which elements lock in plane strain and in rings.
void warn_of_locking(const Problem& p, Lines& lines) {
  if (p.entries.model.plane == Plane::stress) return;
  std::vector<char> has_linear(p.mesh.bodies.size(), 0), has_quadrilaterals = has_linear;
  for (const Cell& cell : p.mesh.cells) {
    if (!is_quadratic(cell.kind)) has_linear[cell.body] = 1;
    if (corner_count(cell.kind) == 4) has_quadrilaterals[cell.body] = 1;
  }
  for (int i = 0; i < int(p.entries.bodies.size()); ++i) {
    const BodySpec& spec = p.entries.bodies[i];
    const Material& material = p.entries.materials.at(spec.material);
    const double poisson = material.stiffness ? poisson_of(*material.stiffness) : material.poisson;
    const auto any = [&](const std::vector<char>& has) {
      for (std::size_t b = 0; b < has.size(); ++b)
        if (has[b] && p.entries.body_of[b] == i) return true;
      return false;
    };
    const bool linear = any(has_linear);
    if (poisson < (linear ? 0.4 : 0.49)) continue;
    lines.push_back(worded("body '", spec.name, "' is nearly incompressible (", material.stiffness ? "as of " : "",
                           "poisson = ", poisson, "): ", locking(linear, any(has_quadrilaterals))));
  }
}

// The first body of the mesh of each entry of [bodies] that is on the axis of rings and softer around it than along r:
// stresses go as r^(k - 1), k = root of C_3333 / C_1111 (the radial equation of equilibrium, Lekhnitskii 1981).
void warn_of_axis(const Problem& p, Lines& lines) {
  if (!p.discretisation.model.axisymmetric()) return;
  std::set<int> on_axis, told;
  for (const Cell& cell : p.mesh.cells)
    for (int a = 0; a < node_count(cell.kind); ++a)
      if (p.mesh.nodes(cell.nodes[a], 0) <= 0) on_axis.insert(cell.body);
  for (const int b : on_axis) {
    const Mat4& C = p.discretisation.laws[b].stiffness;
    if (!(C(2, 2) < (1 - 1e-6) * C(0, 0)) || !told.insert(p.entries.body_of[b]).second) continue;
    lines.push_back(worded("body '", p.entries.body(b).name,
                           "' is not isotropic: on the axis its stress has no limit, as it is stiffer along r than "
                           "around: it grows as r^",
                           std::sqrt(C(2, 2) / C(0, 0)) - 1, ", and bars near there do not hold"));
  }
}

// Bodies whose held motions (validate.hpp) take a force: contact acts along the normals of the multiplier side, and
// where the other side's are not these, as of a flat one beneath a curved one, it may push along it.
void warn_of_held(const Results& r, Lines& lines) {
  constexpr double told_from = 0.01;
  double most = 0;
  for (const ContactResults& contact : r.recovery.contacts) most = std::max(most, contact.force.norm());
  for (std::size_t b = 0; b < r.problem.mesh.bodies.size(); ++b) {
    const double force = r.recovery.reactions.held_bodies[b].force.norm();
    if (!r.unheld.empty() && most > 0 && force > told_from * most)
      lines.push_back(worded("body '", r.problem.mesh.bodies[b], "': what holds it takes a force of ", force, ", ",
                             percent(force / most),
                             " of the largest contact force, as contact acts along the normals of the curves that have "
                             "the multipliers; expected these on the body's own curves (contact.multipliers_on), or a "
                             "support"));
  }
}

// Forces at the points of an entry, of a load or of a support.
void warn_of_points(const Results& r, Lines& lines) {
  constexpr double told_from = 0.01;  // of p
  const std::vector<double> changes = changes_by_point_supports(r);
  const Problem& p = r.problem;
  const Reactions& reactions = r.recovery.reactions;
  const double unseen = unseen_force(r);
  double most = reactions.loads.size;
  for (const Resultant& entry : reactions.entries) most = std::max(most, entry.size);
  for (int i = 0; i < int(p.entries.boundaries.size()); ++i) {
    const BoundaryEntry& entry = p.entries.boundaries[i];
    if (entry.points.empty()) continue;
    double force = 0;
    if (const auto* load = std::get_if<TotalForce>(&entry.spec.what)) force = load->value.norm();
    std::vector<std::string> names;
    for (const int point : entry.points) {
      const std::string& name = p.mesh.points[point].name;
      names.push_back("'" + name + "'");
      for (const Reaction& of : reactions.curves)
        if (of.entry == i && of.on == name && of.sum.force.norm() > unseen) force += of.sum.force.norm();
    }
    if (!(force > 1e-6 * most)) continue;
    const std::string there = worded(entry.spec.key, ": a force of ", force, " at the point",
                                     (names.size() > 1 ? "s " : " "), listed(names), ": stresses and ");
    if (changes[i] > told_from)
      lines.push_back(worded(there,
                             "the displacement there grow without bound as the mesh is refined, and other "
                             "supports take over what it bears: elements there a tenth as long change p by "
                             "another ",
                             percent(changes[i]), "; expected a support along a curve as long as the real one"));
    else
      lines.push_back(worded(there,
                             "the displacement there are unbounded and grow as the mesh is refined; results a few "
                             "elements away are right"));
  }
}

}  // namespace

std::vector<std::string> warnings(const Results& r, const LargeDisplacement& moved) {
  Lines lines;
  warn_of_active_set(r, lines);
  warn_of_iteration(r.solution, lines);
  warn_of_what_is_not_finite(r, lines);
  warn_of_no_load(r, lines);
  if (moved.line) lines.push_back(*moved.line);
  warn_of_locking(r.problem, lines);
  warn_of_axis(r.problem, lines);
  warn_of_held(r, lines);
  warn_of_points(r, lines);
  const double displacement = largest_entry(r.solution.u);
  for (std::size_t k = 0; k < r.problem.pairs.size(); ++k) {
    warn_of_dropped(r.problem.pairs[k], r.recovery.contacts[k], r, lines);
    warn_of_gap(r.problem.pairs[k], r, displacement, lines);
    warn_of_given_gap(r.problem.pairs[k], r.recovery.contacts[k], r, lines);
    warn_of_drawn_gap(r.problem.pairs[k], r.recovery.contacts[k], r, lines);
    warn_of_geometry(r.problem.pairs[k], r, lines);
    warn_of_shape(r.problem.pairs[k], r, lines);
    warn_of_far_origin(r.problem.pairs[k], r, lines);
  }
  return lines;
}

}  // namespace mortise
