#include "app/accuracy_end.hpp"

#include <algorithm>
#include <sstream>

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "results/error_report.hpp"
#include "results/unheld.hpp"

namespace mortise {
namespace {

constexpr double says_little = 0.3;  // an estimate from which the next may be anything: p is not resolved at all yet

bool touches(const Results& r, const ContactPair& pair) {
  const auto first = r.solution.active.begin() + pair.first_row;
  return std::any_of(first, first + pair.coupling.B.rows(), [](char closed) { return closed != 0; });
}

}  // namespace

bool estimate_rises(const std::vector<AccuracyReport::Solve>& solves) {
  const auto rises = [&](std::size_t from) {
    return solves[from].estimated < says_little && solves[from + 1].estimated > solves[from].estimated &&
           solves[from + 1].unknowns > solves[from].unknowns;
  };
  const std::size_t n = solves.size();
  return n >= 4 && rises(n - 3) && rises(n - 2);
}

bool is_pressed(const Results& r) {
  return r.status == Status::not_converged ||
         std::ranges::any_of(r.estimate->pressures, [](const PressureEstimate& e) { return e.line.p.any(); });
}

bool OpenGaps::are_the_answer(const Results& r) {
  if (is_pressed(r)) {
    before_.clear();
    return false;
  }
  std::vector<LeastGap> gaps;
  for (const ContactPair& pair : r.problem.pairs) gaps.push_back(least_gap(r.problem.mesh.nodes, r.solution.u, pair));
  const double round_off = 1e-9 * largest_entry(r.solution.u);
  bool open = gaps.size() == before_.size();
  for (std::size_t i = 0; i < gaps.size() && open; ++i) {
    const ContactPair& pair = r.problem.pairs[i];
    const bool is_loose = touches(r, pair) || !is_gap_held(r, pair);
    open = stays_open(before_[i], gaps[i], round_off) || (is_loose && !r.estimate->pressures[i].local.missed.any());
  }
  before_ = std::move(gaps);
  return open;
}

void require_peak(const Scene& scene, const Results& r) {
  for (const PressureEstimate& e : r.estimate->pressures)
    for (const SingularPoint& point : e.singular) {
      if (!point.is_unbounded()) continue;
      std::ostringstream text;
      text.precision(2);
      text << scene.path << ": accuracy.of = \"peak\": p has no largest value " << near_point(point.position)
           << ", where it grows as ";
      if (point.pressure_exponent < 1)
        text << "r^" << point.pressure_exponent - 1;
      else
        text << "the logarithm of 1/r";
      text << "; expected of = \"pressure\", which leaves out what is near, or a rounded corner";
      throw InputError(text.str());
    }
}

std::string why_to_stop(const Results& r, const AccuracyReport& report, const AccuracySpec& asked, bool tells_no_more,
                        bool at_limit) {
  if (report.reached()) return "";
  const bool of_pressure = asked.of == Goal::pressure;
  const double change = of_pressure ? changed_by_point_supports(r) : 0;
  if (change > asked.value && r.estimate->pressure() <= std::max(asked.value, seen_of_asked * change))
    return "elements a tenth as long at a support at a point change p by another " + percent(change);
  if (tells_no_more)
    return r.status == Status::not_converged ? "the solver did not converge"
           : of_pressure                     ? "nothing is loaded, apart from what is left out"
                                             : "nothing is loaded there";
  const int solves = int(report.solves.size());
  if (solves >= asked.solves_max) return std::to_string(solves) + " solve" + (solves > 1 ? "s" : "");
  if (at_limit || report.solves.back().unknowns >= asked.unknowns_max) return "unknowns_max";
  return estimate_rises(report.solves) ? "the estimate rises" : "";
}

}  // namespace mortise
