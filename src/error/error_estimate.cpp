#include "error/error_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "error/body_products.hpp"
#include "solve/contact_factor.hpp"
#include "solve/threads.hpp"

namespace mortise {
namespace {

// Of the error of the whole's stiffness, the square of that in the energy norm, what one row of bodies may have. Where
// displacements drive it, p everywhere is off by that, which the nearest windows of shared duals do not tell.
constexpr double uneven = 3;

// `round_off`: what round-off of the displacements makes of stresses squared, over their stiffness.
EnergyEstimate energy_estimate(const Mesh& mesh, const ErrorProducts& found, double round_off) {
  const VecX errors = found.products.col(0);
  EnergyEstimate estimate{.error = std::sqrt(errors.sum() / found.norms.sum()),
                          .density = errors.cwiseQuotient(found.areas),
                          .energies = found.norms.cwiseQuotient(found.areas),
                          .areas = found.areas,
                          .body = 0,
                          .part = 0,
                          .position = Vec2::Zero()};
  if (found.norms.sum() <= round_off * found.areas.sum()) estimate.error = 0;  // no stress
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
std::vector<SingularPoint> on_loaded(std::vector<SingularPoint> points, const PressureLine& line) {
  std::erase_if(points, [&](const SingularPoint& point) {
    for (Eigen::Index i = 0; i < line.p.size(); ++i)
      if (line.loaded[i] && (line.position[i] - point.position).norm() <= point.edge) return false;
    return true;
  });
  return points;
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

double round_off_energy(const ErrorProducts& found, double stiffness_scale, const VecX& u) {
  const double strain = 1e-12 * largest_entry(u) / std::sqrt(found.areas.minCoeff());
  return stiffness_scale * strain * strain;
}

std::vector<PressureEstimate> lines_with_windows(const Mesh& mesh, const Discretisation& d,
                                                 const std::vector<ContactPair>& pairs, const Solution& solution,
                                                 double excluded) {
  const double round_off = round_off_pressure(mesh, pairs, d.system.stiffness_scale, solution.u);
  const SideTable table(mesh);
  TipTable tips;
  std::vector<PressureEstimate> list(pairs.size());
  for_each_index(pairs.size(), solver_threads(), [&](std::size_t k) {
    PressureEstimate& e = list[k];
    e.line = pressure_line(mesh, pairs[k], solution.lambda, round_off);
    e.local = line_error(e.line);
    e.windows = pressure_windows(pairs[k], e.line);
    e.singular = on_loaded(
        singular_points(mesh, table, pairs[k].multiplier, pairs[k].opposite, d.system.constraints, d.laws, tips),
        e.line);
    find_excluded(excluded, e);
  });
  return list;
}

std::vector<WindowPlace> window_places(const std::vector<PressureEstimate>& pressures) {
  std::vector<WindowPlace> places;
  for (const PressureEstimate& e : pressures)
    for (const PressureWindow& window : e.windows) places.push_back(window.place);
  return places;
}

// Rows of all pairs; a column a dual, the sum of its windows.
MatX window_functionals(const std::vector<ContactPair>& pairs, const std::vector<PressureEstimate>& pressures,
                        const SharedDuals& shared, Eigen::Index rows) {
  MatX columns = MatX::Zero(rows, shared.count);
  int window = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    for (const PressureWindow& w : pressures[k].windows)
      columns.col(shared.dual[window++]).segment(pairs[k].first_row, w.weights.size()) += w.weights;
  return columns;
}

// Of each window the sum of the cells' parts without their signs.
VecX far_fields(const Mesh& mesh, const FarField& far) {
  if (far.windows.own()) return far.parts.cwiseAbs().colwise().sum();
  VecX sums = VecX::Zero(Eigen::Index(far.windows.dual.size()));
  for (Eigen::Index e = 0; e < far.parts.rows(); ++e) {
    const Cell& cell = mesh.cells[e];
    const Vec2 x = centre_of(mesh.nodes, cell);
    for (int d = 0; d < far.windows.count; ++d)
      far.windows.for_each_window(cell.body, d, x,
                                  [&](int window, double part) { sums(window) += part * std::abs(far.parts(e, d)); });
  }
  return sums;
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
                             const std::vector<ContactPair>& pairs, const Solution& solution, const AccuracySpec& spec,
                             int own_duals) {
  const SaddlePointSystem& system = discretisation.system;
  const Eigen::Index rows = system.B.rows();
  const std::vector<ElasticLaw>& laws = discretisation.laws;
  if (spec.pair >= int(pairs.size()) && spec.pair > 0)
    throw SceneError("accuracy.pair: " + std::to_string(spec.pair) + "; expected a number below that of the pairs, " +
                     std::to_string(pairs.size()));
  ErrorEstimate estimate;
  estimate.pressures = lines_with_windows(mesh, discretisation, pairs, solution, spec.exclude);
  estimate.far.windows = share_duals(mesh, window_places(estimate.pressures), own_duals);
  GoalFunctionals goal;
  if (!pairs.empty())
    goal = goal_functionals(mesh, discretisation, pairs[spec.pair], estimate.pressures[spec.pair].line, spec);
  const Eigen::Index shared = estimate.far.windows.count, goals = goal.rows.cols();
  MatX functionals(rows, shared + goals);
  functionals.leftCols(shared) = window_functionals(pairs, estimate.pressures, estimate.far.windows, rows);
  if (goals > 0) functionals.rightCols(goals) = goal.rows;
  std::shared_ptr<const ContactFactor> factor = solution.factor;
  if (functionals.cols() > 0 && !factor) factor = factorise_contact(system, solution.active);
  const ErrorProducts found =
      functionals.cols() > 0 ? products_with_duals(mesh, points, laws, solution.u, *factor, functionals, goal.loads)
                             : products_by_body(mesh, points, laws, solution.u);
  estimate.energy = energy_estimate(mesh, found, round_off_energy(found, system.stiffness_scale, solution.u));
  estimate.far.parts = found.products.middleCols(1, shared);
  if (goals > 0) estimate.goal = goal_estimate(goal, solution, found.products.rightCols(goals));
  if (spec.of == Goal::stress) {
    const StressPatches patches = recover_patches(mesh, points, sample_stresses(mesh, laws, solution.u));
    add_stress_error(mesh, points, discretisation, goal, solution.u, patches, *estimate.goal);
  }
  const VecX far = far_fields(mesh, estimate.far);
  const double stiffness_part = uneven * estimate.energy.error * estimate.energy.error;
  Eigen::Index window = 0;
  for (PressureEstimate& e : estimate.pressures) {
    e.far = far.segment(window, Eigen::Index(e.windows.size()));
    if (!estimate.far.windows.own()) e.far.array() += stiffness_part * largest_entry(e.line.p);
    window += Eigen::Index(e.windows.size());
    find_bars(e);
  }
  if (spec.of == Goal::mean) {
    const PressureEstimate& e = estimate.pressures[spec.pair];
    estimate.goal->local = mean_error(mesh, pairs[spec.pair], e.line, e.local.pointwise(e.line), spec.window);
  }
  return estimate;
}

}  // namespace mortise
