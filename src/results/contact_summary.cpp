#include "results/contact_summary.hpp"

#include <algorithm>
#include <iomanip>
#include <map>
#include <sstream>

#include "base/printable.hpp"

namespace mortise {
namespace {

std::string name_of(const ContactPair& pair) { return pair.spec.between[0] + " - " + pair.spec.between[1]; }

// " within 1.2 %", of a force that equilibrium does not give.
std::string within(const ContactResults& c) {
  if (!c.force_error) return "";
  const double part = c.force_error->head<2>().norm() / c.force.norm();
  if (!(part > 1e-6)) return "";
  std::ostringstream text;
  text.precision(2);
  text << " within " << 100 * part << " %";
  return text.str();
}

std::string length_within(const ContactResults& c) {
  if (!c.length_error || !(*c.length_error > 0)) return "";
  std::ostringstream text;
  text.precision(2);
  text << " within " << *c.length_error;
  return text.str();
}

void print_pair(const ContactPair& pair, const ContactResults& c, const std::string& space, std::ostream& out) {
  out << "  contact   " << name_of(pair) << ": " << to_string(pair.spec.condition) << ", gap " << gap_words(pair)
      << ", " << space << " multipliers on " << pair.spec.multipliers_on << "\n            pressure " << c.p_min
      << " ... " << c.p_max << " (mean " << c.p_mean << "), force (" << c.force.x() << ", " << c.force.y() << ") on "
      << c.multiplier.curve << within(c) << "\n            length " << c.length << ", in contact "
      << c.length_in_contact << length_within(c) << "; undeformed gap " << pair.coupling.gap_min << " ... "
      << pair.coupling.gap_max << "\n";
}

// "480 unilateral, gap closed; 20 bilateral, gap as drawn"
std::string kinds_of(const std::vector<ContactPair>& pairs) {
  std::map<std::string, int> count;
  for (const ContactPair& pair : pairs) ++count[to_string(pair.spec.condition) + ", gap " + gap_words(pair)];
  std::vector<std::string> kinds;
  for (const auto& [kind, number] : count) kinds.push_back(std::to_string(number) + " " + kind);
  return listed(kinds);
}

// The pair for which `value` is largest; NaN is no value.
template <typename Value>
std::size_t largest_pair(std::size_t pairs, Value value) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < pairs; ++k)
    if (value(k) > value(best) || std::isnan(value(best))) best = k;
  return best;
}

void print_all(const Results& r, const std::string& space, std::ostream& out) {
  const std::size_t count = r.problem.pairs.size();
  const auto most = [&](auto value) { return largest_pair(count, value); };
  const std::size_t low = most([&](std::size_t k) { return -r.recovery.contacts[k].p_min; }),
                    high = most([&](std::size_t k) { return r.recovery.contacts[k].p_max; }),
                    strong = most([&](std::size_t k) { return r.recovery.contacts[k].force.norm(); });
  double length = 0, in_contact = 0, gap_min = r.problem.pairs[0].coupling.gap_min,
         gap_max = r.problem.pairs[0].coupling.gap_max;
  for (std::size_t k = 0; k < count; ++k) {
    length += r.recovery.contacts[k].length;
    in_contact += r.recovery.contacts[k].length_in_contact;
    gap_min = std::min(gap_min, r.problem.pairs[k].coupling.gap_min);
    gap_max = std::max(gap_max, r.problem.pairs[k].coupling.gap_max);
  }
  const auto open =
      std::ranges::count_if(r.recovery.contacts, [](const ContactResults& c) { return c.length_in_contact == 0; });
  const Vec2& force = r.recovery.contacts[strong].force;
  out << "  contact   " << count << " pairs, " << space << " multipliers: " << kinds_of(r.problem.pairs)
      << "\n            lowest pressure " << r.recovery.contacts[low].p_min << " (" << name_of(r.problem.pairs[low])
      << "), highest " << r.recovery.contacts[high].p_max << " (" << name_of(r.problem.pairs[high])
      << ")\n            largest force (" << force.x() << ", " << force.y() << ") on "
      << r.recovery.contacts[strong].multiplier.curve << " (" << name_of(r.problem.pairs[strong])
      << ")\n            length " << length << ", in contact " << in_contact << "; " << open
      << " pairs open; undeformed gap " << gap_min << " ... " << gap_max << "\n";
  out << "            each pair: summary.json, contact.csv\n";
}

}  // namespace

std::string space_word(const Results& r) {
  const bool quadratic_edges = std::any_of(r.problem.pairs.begin(), r.problem.pairs.end(),
                                           [](const ContactPair& p) { return p.multiplier.edges[0].node_count == 3; });
  if (r.problem.method.multipliers == Multipliers::quadratic && !quadratic_edges) return to_string(Multipliers::linear);
  return to_string(r.problem.method.multipliers);
}

std::string contact_lines(const Results& r) {
  std::ostringstream out;
  const std::string space = space_word(r);
  if (r.problem.pairs.size() > told_in_full)
    print_all(r, space, out);
  else
    for (std::size_t k = 0; k < r.problem.pairs.size(); ++k)
      print_pair(r.problem.pairs[k], r.recovery.contacts[k], space, out);
  return out.str();
}

std::string contact_words(const Results& r) {
  const int unilateral = int(std::count_if(r.problem.pairs.begin(), r.problem.pairs.end(), [](const ContactPair& p) {
    return p.spec.condition == Condition::unilateral;
  }));
  if (unilateral == 0 || r.solution.iteration) return "";
  if (r.solution.steps.size() > 1)
    return std::to_string(r.solution.steps.size()) + " solves until nothing is in tension or overlaps" +
           (r.solution.coarse_steps > 0
                ? ", and " + std::to_string(r.solution.coarse_steps) + " smaller ones for the second's start"
                : "");
  return std::all_of(r.solution.active.begin(), r.solution.active.end(), [](char a) { return a; })
             ? "one solve: nothing is in tension, contact is closed everywhere"
             : "one solve: the active set of the start holds";
}

}  // namespace mortise
