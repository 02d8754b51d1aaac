#include "error/error_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "fem/patch_recovery.hpp"
#include "solve/contact_factor.hpp"

namespace mortise {
namespace {

EnergyEstimate energy_estimate(const Mesh& mesh, const ErrorProducts& found) {
  const VecX errors = found.products.col(0);
  EnergyEstimate estimate{.error = std::sqrt(errors.sum() / found.norms.sum()),
                          .density = errors.cwiseQuotient(found.areas),
                          .energies = found.norms.cwiseQuotient(found.areas),
                          .areas = found.areas,
                          .body = 0,
                          .part = 0,
                          .position = Vec2::Zero()};
  if (found.norms.sum() == 0) estimate.error = 0;  // no stress
  VecX of_body = VecX::Zero(Eigen::Index(mesh.bodies.size()));
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) of_body(mesh.cells[e].body) += errors(e);
  of_body.maxCoeff(&estimate.body);
  if (errors.sum() > 0) estimate.part = of_body(estimate.body) / errors.sum();
  double largest = -1;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const Cell& cell = mesh.cells[e];
    if (cell.body != estimate.body || !(errors(e) > largest)) continue;
    largest = errors(e);
    estimate.position = centre_of(mesh.nodes, cell);
  }
  return estimate;
}

// Those that lie on the loaded line.
std::vector<SingularPoint> singular_on(const Mesh& mesh, const ContactPair& pair, const PressureLine& line,
                                       const Constraints& constraints, const std::vector<ElasticLaw>& laws) {
  std::vector<SingularPoint> found = singular_points(mesh, pair.multiplier, pair.opposite, constraints, laws);
  std::erase_if(found, [&](const SingularPoint& point) {
    for (Eigen::Index i = 0; i < line.p.size(); ++i)
      if (line.loaded[i] && (line.position[i] - point.position).norm() <= point.edge) return false;
    return true;
  });
  return found;
}

// Linear between the windows' centres, constant beyond them.
double far_at(const PressureEstimate& e, double s) {
  if (e.windows.empty()) return 0;
  std::size_t k = 0;
  while (k < e.windows.size() && e.windows[k].s < s) ++k;
  if (k == 0 || k == e.windows.size()) return e.far(k == 0 ? 0 : Eigen::Index(k) - 1);
  const double part = (s - e.windows[k - 1].s) / (e.windows[k].s - e.windows[k - 1].s);
  return (1 - part) * e.far(Eigen::Index(k) - 1) + part * e.far(Eigen::Index(k));
}

void find_excluded(double part, PressureEstimate& e) {
  const PressureLine& line = e.line;
  double length = 0;
  for (Eigen::Index i = 0; i + 1 < line.p.size(); ++i)
    if (line.loaded[i] && line.loaded[i + 1]) length += line.s(i + 1) - line.s(i);
  e.excluded_distance = part * length;
  e.excluded.assign(line.p.size(), 0);
  for (Eigen::Index i = 0; i < line.p.size(); ++i)
    for (const SingularPoint& point : e.singular)
      if (point.pressure_exponent < 1 && (line.position[i] - point.position).norm() < e.excluded_distance)
        e.excluded[i] = 1;
}

void find_bars(PressureEstimate& e) {
  const PressureLine& line = e.line;
  const Eigen::Index count = line.p.size();
  e.bar = e.local.pointwise(line);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double far = far_at(e, line.s(i));
    e.bar(i) = error_safety * (e.bar(i) + (line.loaded[i] ? far : 0));
    if (!line.loaded[i] || e.excluded[i] || (line.closed && i == count - 1)) continue;
    e.local2 += e.local.l2(i) * e.local.l2(i);
    e.far2 += far * far * line.h(i);
    e.p2 += line.p(i) * line.p(i) * line.h(i);
  }
}

double error_norm(const std::vector<PressureEstimate>& pressures, double local, double far) {
  double error = 0;
  for (const PressureEstimate& e : pressures) error += local * e.local2 + far * e.far2;
  return std::sqrt(error);
}

}  // namespace

double ErrorEstimate::peak() const {
  double p = 0, bar = std::numeric_limits<double>::quiet_NaN();
  for (const PressureEstimate& e : pressures)
    for (Eigen::Index i = 0; i < e.line.p.size(); ++i)
      if (e.line.p(i) > p) {
        p = e.line.p(i);
        bar = e.bar(i);
      }
  return bar / p;
}

double ErrorEstimate::half_width() const {
  double part = 0;
  for (const PressureEstimate& e : pressures)
    for (const LineError::Border& border : e.local.borders) part = std::max(part, border.part);
  return part;
}

double ErrorEstimate::pressure_square() const {
  double square = 0;
  for (const PressureEstimate& e : pressures) square += e.p2;
  return square;
}

double ErrorEstimate::pressure() const {
  return error_safety * error_norm(pressures, 1, 1) / std::sqrt(pressure_square());
}
double ErrorEstimate::line() const { return error_norm(pressures, 1, 0) / std::sqrt(pressure_square()); }
double ErrorEstimate::far_field() const { return error_norm(pressures, 0, 1) / std::sqrt(pressure_square()); }

ErrorEstimate estimate_error(const Mesh& mesh, const BodyPoints& points, const Discretisation& discretisation,
                             const std::vector<ContactPair>& pairs, const Solution& solution,
                             const AccuracySpec& spec) {
  const SaddlePointSystem& system = discretisation.system;
  const double round_off = round_off_pressure(mesh, pairs, system.stiffness_scale, solution.u);
  ErrorEstimate estimate;
  Eigen::Index windows = 0;
  for (const ContactPair& pair : pairs) {
    PressureEstimate e;
    e.line = pressure_line(mesh, pair, solution.lambda, round_off);
    e.local = line_error(e.line);
    e.windows = pressure_windows(pair, e.line, system.B.rows());
    e.singular = singular_on(mesh, pair, e.line, system.constraints, discretisation.laws);
    find_excluded(spec.exclude, e);
    windows += Eigen::Index(e.windows.size());
    estimate.pressures.push_back(std::move(e));
  }
  if (spec.pair >= int(pairs.size()) && spec.pair > 0)
    throw SceneError("accuracy.pair: " + std::to_string(spec.pair) + "; expected a number below that of the pairs, " +
                     std::to_string(pairs.size()));
  const GoalFunctionals goal =
      goal_functionals(mesh, discretisation, pairs[spec.pair], estimate.pressures[spec.pair].line, spec);
  const Eigen::Index goals = goal.rows.cols(), count = windows + goals;
  std::shared_ptr<const ContactFactor> factor = solution.factor;
  if (count > 0 && !factor) factor = factorise_contact(system, solution.active);
  MatX functionals(system.B.rows(), count), fields(system.K.cols(), 1 + count);
  functionals.rightCols(goals) = goal.rows;
  Eigen::Index k = 0;
  for (const PressureEstimate& e : estimate.pressures)
    for (const PressureWindow& window : e.windows) functionals.col(k++) = window.weights;
  fields.col(0) = solution.u;
  if (count > 0) fields.rightCols(count) = factor->duals(functionals, goal.loads);
  const std::vector<ElasticLaw>& laws = discretisation.laws;
  const StressPatches patches = recover_patches(mesh, points, sample_stresses(mesh, laws, fields));
  const ErrorProducts found = error_products(mesh, points, laws, fields, patches);
  estimate.energy = energy_estimate(mesh, found);
  estimate.parts = found.products.middleCols(1, windows);
  if (goals > 0) estimate.goal = goal_estimate(goal, solution, found.products.rightCols(goals));
  if (spec.of == Goal::stress)
    add_stress_error(mesh, points, discretisation, goal, solution.u, patches, *estimate.goal);
  const VecX far = estimate.parts.cwiseAbs().colwise().sum();
  k = 0;
  for (PressureEstimate& e : estimate.pressures) {
    e.far = far.segment(k, Eigen::Index(e.windows.size()));
    k += Eigen::Index(e.windows.size());
    find_bars(e);
  }
  if (spec.of == Goal::mean) {
    const PressureEstimate& e = estimate.pressures[spec.pair];
    estimate.goal->local = mean_error(mesh, pairs[spec.pair], e.line, e.local.pointwise(e.line), spec.window);
  }
  return estimate;
}

}  // namespace mortise
