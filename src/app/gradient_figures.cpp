#include "app/gradient_figures.hpp"

#include <regex>

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "error/goal_estimate.hpp"
#include "error/pressure_windows.hpp"

namespace mortise {
namespace {

[[noreturn]] void refuse(const Figure& figure, const std::string& why) {
  throw InputError("figure '" + printable(figure.name) + "': " + why);
}

void require_numbers(const Figure& figure, std::initializer_list<std::size_t> counts, const std::string& expected) {
  if (std::ranges::find(counts, figure.numbers.size()) == counts.end()) refuse(figure, "expected " + expected);
}

// The `number`th of so many; throws where there are not.
std::size_t numbered(const Figure& figure, const std::string& number, std::size_t count, const std::string& what) {
  const std::size_t k = number.size() > 9 ? count : std::stoul(number);
  if (k < count) return k;
  refuse(figure, "of " + what + " the scene has " + std::to_string(count) + ", counted from 0");
}

// The index of the pair with a number (contact_numbers); throws where there is none.
std::size_t pair_numbered(const Figure& figure, const std::string& number, const Problem& problem) {
  const std::vector<int> numbers = contact_numbers(problem).pairs;
  const int last = numbers.empty() ? -1 : numbers.back();
  const auto found = std::ranges::find(numbers, int(numbered(figure, number, std::size_t(last + 1), "pairs")));
  if (found == numbers.end()) refuse(figure, "that entry of the scene's contact is tied");
  return found - numbers.begin();
}

LinearisedFigure of_lambda(const Results& r, const VecX& rows) {
  return {-rows.dot(r.solution.lambda), VecX::Zero(r.solution.u.size()), -rows};
}

// Rows, m: -rows . lambda is the sum of weight(p) p over the points, with their areas as parts of 1.
template <typename Weight>
VecX weighted(const Results& r, const ContactPair& pair, const Weight& weight) {
  double area = 0;
  for (const ContactPoint& point : pair.points) area += point.dA;
  const VecX lambda = r.solution.lambda.segment(pair.first_row, pair.coupling.B.rows());
  VecX rows = VecX::Zero(lambda.size()), at = rows;
  for (const ContactPoint& point : pair.points) {
    at.setZero();
    add_pressure_at(pair, point.edge, point.xi, 1, at);
    rows += point.dA / area * weight(std::max(-at.dot(lambda), 0.0)) * at;
  }
  VecX all = VecX::Zero(r.solution.lambda.size());
  all.segment(pair.first_row, rows.size()) = rows;
  return all;
}

LinearisedFigure norm_of(const Results& r, const ContactPair& pair, double power, double p_max) {
  const VecX scaled = weighted(r, pair, [&](double p) { return std::pow(p / p_max, power - 1); });
  LinearisedFigure figure = of_lambda(r, scaled);  // its value: mean of p (p / p_max)^(power - 1)
  const double norm = p_max * std::pow(figure.value / p_max, 1 / power);
  figure.by_lambda *= std::pow(norm / p_max, 1 - power);
  figure.value = norm;
  return figure;
}

LinearisedFigure pressure_of(const Results& r, std::size_t k, const Figure& figure, bool norm) {
  const ContactPair& pair = r.problem.pairs[k];
  if (norm) {
    if (figure.numbers.size() != 1 || !(figure.numbers[0] >= 1 && figure.numbers[0] <= 1000))
      refuse(figure, "expected a power, from 1 to 1000");
    const double p_max = r.recovery.contacts[k].pressure.maxCoeff();
    if (!(p_max > 0)) refuse(figure, "nothing is loaded, where the norm has no derivative");
    return norm_of(r, pair, figure.numbers[0], p_max);
  }
  require_numbers(figure, {0, 2}, "no number, or a window, from and to along the curve");
  if (figure.numbers.empty()) return of_lambda(r, weighted(r, pair, [](double) { return 1.0; }));
  AccuracySpec spec;
  spec.of = Goal::mean;
  spec.window = {figure.numbers[0], figure.numbers[1]};
  const PressureLine line = pressure_line(r.problem.mesh, pair, r.solution.lambda, 0);
  if (const std::string trouble = window_trouble(line, spec.window); !trouble.empty()) refuse(figure, trouble);
  const MatX rows = goal_functionals(r.problem.mesh, r.problem.discretisation, pair, line, spec).rows;
  return of_lambda(r, rows.col(0));
}

LinearisedFigure force_of(const Results& r, std::size_t k, int component) {
  const ContactPair& pair = r.problem.pairs[k];
  AccuracySpec spec;
  spec.of = Goal::force;
  const MatX rows = goal_functionals(r.problem.mesh, r.problem.discretisation, pair, {}, spec).rows;
  return of_lambda(r, rows.col(component));
}

LinearisedFigure displacement_of(const Results& r, const ProbePlace& place, int component) {
  LinearisedFigure figure{0, displacement_loads(r.problem.mesh, place.in).col(component),
                          VecX::Zero(r.solution.lambda.size())};
  figure.value = figure.by_u.dot(r.solution.u);
  return figure;
}

LinearisedFigure energy_of(const Results& r) {
  const Discretisation& d = r.problem.discretisation;
  const VecX& u = r.solution.u;
  return {r.recovery.energy, d.system.K.selfadjointView<Eigen::Lower>() * u + spring_forces(d, u) - d.initial_load,
          VecX::Zero(r.solution.lambda.size()), true};
}

}  // namespace

LinearisedFigure linearised(const Results& r, const Figure& figure) {
  static const std::regex known(
      R"(energy|probe\.(\d+)\.u_([xy])|contact\.(\d+)\.(force\.([xy])|pressure\.(mean|norm)))");
  std::smatch name;
  if (!std::regex_match(figure.name, name, known))
    refuse(
        figure,
        "expected energy, probe.I.u_x, probe.I.u_y, contact.K.force.x, contact.K.force.y, contact.K.pressure.mean or "
        "contact.K.pressure.norm");
  if (name[6].matched) {
    return pressure_of(r, pair_numbered(figure, name[3], r.problem), figure, name[6] == "norm");
  }
  require_numbers(figure, {0}, "no number");
  if (name[1].matched)
    return displacement_of(r, r.problem.probes[numbered(figure, name[1], r.problem.probes.size(), "probes")],
                           name[2] == "y" ? 1 : 0);
  if (!name[3].matched) return energy_of(r);
  return force_of(r, pair_numbered(figure, name[3], r.problem), name[5] == "y" ? 1 : 0);
}

}  // namespace mortise
