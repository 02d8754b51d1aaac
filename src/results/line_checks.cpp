#include "results/line_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include "base/printable.hpp"
#include "fem/edges.hpp"
#include "results/error_report.hpp"
#include "results/line_motion.hpp"

namespace mortise {
namespace {

// The longest run of edges of the multiplier side that face nothing, told by its middle.
std::string uncovered_place(const Results& r, const ContactPair& pair) {
  const Curve& curve = pair.multiplier;
  std::vector<double> covered(curve.edges.size(), 0);
  for (const ContactPoint& c : pair.points) covered[c.edge] += c.ds;
  double longest = 0, run = 0;
  std::size_t last = 0, length = 0, end = 0;
  for (std::size_t e = 0; e < curve.edges.size(); ++e) {
    const double open = edge_length(r.problem.mesh.nodes, curve.edges[e]) - covered[e];
    const bool counts = open > 0.01 * edge_length(r.problem.mesh.nodes, curve.edges[e]);
    run = counts ? run + open : 0;
    length = counts ? length + 1 : 0;
    if (run <= longest) continue;
    longest = run;
    end = e;
    last = length;
  }
  const std::string pair_words = pair.spec.key + ": '" + pair.spec.multipliers_on + "'";
  if (longest == 0) return pair_words + " is covered more than once";
  const Vec2 middle = edge_point(r.problem.mesh.nodes, curve.edges[end - last / 2], 0).position;
  const std::string& other = pair.spec.between[pair.spec.between[0] == pair.spec.multipliers_on];
  std::ostringstream text;
  text
      << pair_words << " faces no part of '" << other << "' on a length of " << longest << " " << near_point(middle)
      << ": \"closed\" says that both are one curve; expected the default, initial_gap = \"curve\", or curves that are";
  return text.str();
}

// Of each body those of its pairs that matter.
std::map<int, std::vector<std::size_t>> pairs_of_bodies(const Results& r) {
  std::map<int, std::vector<std::size_t>> bodies;
  for (const std::size_t k : pairs_that_matter(r))
    for (const Curve* curve : {&r.problem.pairs[k].multiplier, &r.problem.pairs[k].opposite})
      bodies[curve->body].push_back(k);
  return bodies;
}

// What of a pair's p the displacements take away, at most all of it, and the words for that.
struct LostPressure {
  double part = 0;
  std::string why;
};

LostPressure lost_pressure(const LineMotion& motion) {
  LostPressure lost;
  const auto take = [&](double part, const std::string& before, const std::string& shown, const std::string& after) {
    if (part > lost.part) lost = {std::min(1., part), before + shown + after};
  };
  take(motion.turned, " turns by ", two_digits(motion.turned), " radians as a whole");
  take(motion.shifted_as_one, " slides by ", percent(motion.slid_as_one), " of the loaded length");
  take(motion.curved, " moves by ", percent(motion.curved), " of its radius of curvature");
  take(motion.strained, " turns and stretches so that ", percent(motion.strained), " of its pressure are lost");
  return lost;
}

}  // namespace

Check coverage_check(const Results& r) {
  // A closed curve meshed twice: the chords' lengths differ by their geometric error.
  Check check{r.problem.method.integration == Integration::segments ? "segments cover the closed contact curve"
                                                                    : "points cover the closed contact curve",
              0, 1e-2};
  const ContactPair* worst = nullptr;
  for (std::size_t k = 0; k < r.problem.pairs.size(); ++k) {
    const ContactPair& pair = r.problem.pairs[k];
    if (pair.spec.initial_gap != InitialGap::closed || pair.spec.found) continue;
    const double facing = std::min(r.recovery.contacts[k].length, curve_length(r.problem.mesh.nodes, pair.opposite));
    const double uncovered = std::abs(1 - pair.coupling.covered_length / facing);
    if (!(uncovered <= check.value)) worst = &pair;
    check.value = largest(check.value, uncovered);
  }
  if (!check.ok() && worst) check.where = uncovered_place(r, *worst);
  return check;
}

Check motion_check(const Results& r) {
  Check check{"turn and slide of contact lines", 0, 0.5};
  double norm = 0, lost = 0, most = 0;
  std::string where;
  for (std::size_t k = 0; k < r.problem.pairs.size(); ++k) {
    const std::optional<LineMotion> motion =
        line_motion(r.problem.mesh.nodes, r.problem.pairs[k], r.recovery.contacts[k], r.solution.u);
    if (!motion) continue;
    const LostPressure of_pair = lost_pressure(*motion);
    norm = std::hypot(norm, motion->norm);
    lost = std::hypot(lost, of_pair.part * motion->norm);
    if (!(of_pair.part * motion->norm > most)) continue;
    most = of_pair.part * motion->norm;
    where = r.problem.pairs[k].spec.key + ": the contact line " + near_point(motion->position) + of_pair.why +
            ", more than small displacements bear: forces and pressures are those of the undeformed bodies";
  }
  check.value = r.solution.u.allFinite() ? fraction(lost, norm) : std::numeric_limits<double>::quiet_NaN();
  if (!check.ok()) check.where = where;
  return check;
}

std::optional<Check> estimate_check(const Results& r) {
  const double error = r.estimate->pressure();
  if (std::isnan(error) && r.estimate->pressure_square() == 0) return {};  // nothing is loaded
  Check check{"estimated error of p", error, 0.5};
  std::string of;
  if (check.ok() && !r.problem.accuracy)  // that is asked of all lines together
    for (const auto& [body, pairs] : pairs_of_bodies(r)) {
      const double of_body = r.estimate->pressure_of(pairs);
      if (!(of_body > std::max(check.limit, check.value))) continue;
      check.value = of_body;
      of =
          "of all that presses on body '" + r.problem.mesh.bodies[body] + "', the most from " + largest_error(r, pairs);
    }
  if (!check.ok())
    check.where = (of.empty() ? "the most from " + largest_error(r) : of) + "; expected a finer mesh there";
  return check;
}

}  // namespace mortise
