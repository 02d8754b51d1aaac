#include "results/error_report.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/parallel.hpp"
#include "base/printable.hpp"
#include "contact/singular_points.hpp"
#include "error/force_errors.hpp"
#include "error/pressure_form.hpp"
#include "solve/threads.hpp"

namespace mortise {
namespace {

std::string percent(double part) {
  std::ostringstream text;
  text.precision(2);
  text << 100 * part << " %";
  return text.str();
}

}  // namespace

std::string largest_error(const Results& r) {
  // Along the lines, vertex by vertex; of the far field the cell with the largest part.
  const ErrorEstimate& estimate = *r.estimate;
  Eigen::Index cell = 0;
  if (estimate.far.parts.size() > 0) estimate.far.parts.cwiseAbs().rowwise().sum().maxCoeff(&cell);
  const Cell& at = r.problem.mesh.cells[cell];
  const auto between = [&](std::size_t k) {
    return " of '" + r.recovery.contacts[k].multiplier.curve + "' on '" + r.recovery.contacts[k].opposite.curve + "'";
  };
  const std::string farthest =
      "the mesh of body '" + r.problem.mesh.bodies[at.body] + "' " + near_point(centre_of(r.problem.mesh.nodes, at));
  double largest = -1;
  std::string words;
  for (std::size_t k = 0; k < r.problem.pairs.size(); ++k) {
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
      if (e.excluded[i] || !(local(i) > size)) continue;
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
  return lines;
}

bool grows_without_limit(const Results& r, const Extreme& stress) {
  r.memory->keep_for(r.problem);
  if (r.memory->exponent_at(r.problem, stress.node, stress.of) <= singular_limit) return true;
  if (!r.estimate) return false;
  return std::ranges::any_of(r.estimate->pressures, [&](const PressureEstimate& e) {
    return std::ranges::any_of(e.singular, [&](const SingularPoint& point) {
      return (point.position - stress.place).norm() < 0.05 * point.edge;
    });
  });
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
    const PressureEstimate& e = r.estimate->pressures[k];
    double length = 0;
    for (const LineError::Border& border : e.local.borders) length += e.line.s(border.edge + 1) - e.line.s(border.edge);
    r.recovery.contacts[k].length_error = length;
  }
}

}  // namespace

ForcesAsked ask_forces(const Results& r) { return ask_forces(r.problem, r.solution, centres_of(r), *r.memory); }

void set_force_bars(const ForcesAsked& asked, const FoundDuals& duals, Results& r) {
  put_force_bars(force_errors(r.problem, r.estimate->pressures, centres_of(r), asked, duals), r);
}

void set_force_bars(Results& r) {
  put_force_bars(force_errors(r.problem, r.solution, r.estimate->pressures, centres_of(r)), r);
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
