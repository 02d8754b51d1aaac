#include "results/error_report.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/each_once.hpp"
#include "base/parallel.hpp"
#include "base/printable.hpp"
#include "contact/singular_points.hpp"
#include "error/force_errors.hpp"
#include "error/length_error.hpp"
#include "error/pressure_form.hpp"
#include "solve/threads.hpp"

namespace mortise {
namespace {

// The one that does most to the windows' means of these pairs.
const Cell& worst_cell(const Results& r, const std::vector<std::size_t>& pairs) {
  const FarField& far = r.estimate->far;
  std::vector<std::size_t> first{0};  // window of each pair
  for (const PressureEstimate& e : r.estimate->pressures) first.push_back(first.back() + e.windows.size());
  std::vector<int> duals;
  for (const std::size_t k : pairs)
    duals.insert(duals.end(), far.windows.dual.begin() + std::ptrdiff_t(first[k]),
                 far.windows.dual.begin() + std::ptrdiff_t(first[k + 1]));
  keep_each_once(duals);
  VecX parts = VecX::Zero(Eigen::Index(r.problem.mesh.cells.size()));
  for (const int dual : duals) parts += far.parts.col(dual).cwiseAbs();
  Eigen::Index cell = 0;
  parts.maxCoeff(&cell);
  return r.problem.mesh.cells[cell];
}

std::vector<std::size_t> all_pairs(const Results& r) {
  std::vector<std::size_t> all(r.problem.pairs.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

// Of those that matter the one whose p is known least, where that is worse than what is said of all: above the limit,
// or, where that is told of all, twice as far off.
std::optional<std::string> warning_of_pairs(const Results& r, double all) {
  double worst = all > pressure_error_limit ? 2 * all : pressure_error_limit;
  const double limit = worst;
  std::size_t of = 0;
  int count = 0;
  for (const std::size_t k : pairs_that_matter(r)) {
    const double error = r.estimate->pressure_of({k});
    count += error > limit;
    if (!(error > worst)) continue;
    worst = error;
    of = k;
  }
  if (count == 0) return {};
  const std::string others = count == 2 ? "another pair" : std::to_string(count - 1) + " more pairs",
                    most = percent(limit), least = most.starts_with("more than") ? most : "more than " + most,
                    more = count == 1 ? "" : ", and of " + others + " by " + least;
  return r.problem.pairs[of].spec.key + ": p may be off by " + percent(worst) + " of its own, the most from " +
         largest_error(r, {of}) + more + "; expected a finer mesh there";
}

}  // namespace

std::vector<std::size_t> pairs_that_matter(const Results& r) {
  const double least = negligible_pressure(r);
  std::vector<std::size_t> pairs = all_pairs(r);
  std::erase_if(pairs, [&](std::size_t k) {
    return r.estimate->pressures[k].p2 == 0 || !(largest_entry(r.recovery.contacts[k].pressure) > least);
  });
  return pairs;
}

std::string largest_error(const Results& r) { return largest_error(r, all_pairs(r)); }

std::string largest_error(const Results& r, const std::vector<std::size_t>& pairs) {
  // Along the lines, vertex by vertex; of the far field the cell with the largest part.
  const ErrorEstimate& estimate = *r.estimate;
  const Cell& at = worst_cell(r, pairs);
  const auto between = [&](std::size_t k) {
    return " of '" + r.recovery.contacts[k].multiplier.curve + "' on '" + r.recovery.contacts[k].opposite.curve + "'";
  };
  const std::string farthest =
      "the mesh of body '" + r.problem.mesh.bodies[at.body] + "' " + near_point(centre_of(r.problem.mesh.nodes, at));
  double largest = -1;
  std::string words;
  for (const std::size_t k : pairs) {
    const PressureEstimate& e = estimate.pressures[k];
    if (e.far2 > std::max(largest, e.local2)) {
      largest = e.far2;
      words = farthest + ", for the pressure" + between(k);
    }
    if (!(e.local2 > largest)) continue;
    largest = e.local2;
    Eigen::Index worst = 0;
    double size = -1;
    const VecX local = e.local.whole();
    for (Eigen::Index i = 0; i < local.size(); ++i) {
      if (!e.counts(i) || !(local(i) > size)) continue;
      size = local(i);
      worst = i;
    }
    words = (e.local.border[worst] ? "the border of contact" : "edges") + between(k) + " " +
            near_point(e.line.position[worst]);
  }
  return words;
}

std::vector<std::string> error_warnings(const Results& r) {
  const ErrorEstimate& estimate = *r.estimate;
  std::vector<std::string> lines;
  if (estimate.energy.error > energy_error_limit)
    lines.push_back("the mesh is coarse: stresses are off by about " + percent(estimate.energy.error) +
                    " in the energy norm, the most in body '" + r.problem.mesh.bodies[estimate.energy.body] + "' " +
                    near_point(estimate.energy.position) + "; expected a finer mesh there, or quadratic elements");
  const double error = estimate.pressure();
  if (error > pressure_error_limit)
    lines.push_back("the contact pressure may be off by " + percent(error) + ", the most from " + largest_error(r) +
                    "; expected a finer mesh there");
  if (auto line = warning_of_pairs(r, error)) lines.push_back(*std::move(line));
  return lines;
}

bool grows_without_limit(const Results& r, const Extreme& stress) {
  if (corner_exponent(r.memory->around(r.problem), stress.node) <= singular_limit) return true;
  return r.estimate && singular_point_at(r.estimate->pressures, stress.place, 0.05);
}

namespace {

std::vector<Vec2> centres_of(const Results& r) {
  std::vector<Vec2> centres;
  for (const ContactResults& contact : r.recovery.contacts) centres.push_back(contact.centre);
  return centres;
}

void put_force_bars(const std::vector<Eigen::Vector3d>& errors, Results& r) {
  for (std::size_t k = 0; k < r.problem.pairs.size(); ++k) {
    r.recovery.contacts[k].force_error = errors[k];
    r.recovery.contacts[k].length_error =
        length_error(r.problem, r.problem.pairs[k], r.solution.u, r.estimate->pressures[k]);
  }
}

}  // namespace

ForcesAsked ask_forces(const Results& r) { return ask_forces(r.problem, r.solution, centres_of(r), *r.memory); }

void set_force_bars(const ForcesAsked& asked, const FoundDuals& duals, Results& r) {
  put_force_bars(force_errors(r.problem, r.estimate->pressures, centres_of(r), asked, duals), r);
}

void set_force_bars(Results& r) {
  put_force_bars(force_errors(r.problem, r.solution, r.estimate->pressures, centres_of(r), *r.memory), r);
}

void set_fitted_pressures(Results& r) {
  for_each_index(r.problem.pairs.size(), solver_threads(), [&](std::size_t k) {
    const ContactPair& pair = r.problem.pairs[k];
    set_fitted_pressure(r.problem.mesh.nodes, pair.multiplier, r.estimate->pressures[k].fitted, r.recovery.contacts[k]);
  });
}

void set_bars(const PressureEstimate& estimate, ContactResults& contact) {
  for (ContactSide* side : {&contact.multiplier, &contact.opposite})
    for (ContactNode& node : side->nodes) {
      if (node.on_multiplier.edge < 0 || (std::isnan(node.gap) && node.p == 0)) continue;
      const auto [edge, xi] = node.on_multiplier;
      const double end = (1 + xi) / 2;
      node.p_error = (1 - end) * estimate.bar(edge) + end * estimate.bar(edge + 1);
    }
}

}  // namespace mortise
