#include "error/goal_estimate.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <numbers>
#include <span>
#include <sstream>

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "contact/singular_points.hpp"
#include "error/body_products.hpp"
#include "error/pressure_windows.hpp"
#include "error/weak_points.hpp"
#include "fem/edges.hpp"
#include "fem/quadrature.hpp"

namespace mortise {
namespace {

constexpr double at_place = 1e-6;  // of an edge

struct Window {
  double from, to;
};

// Arc lengths of the curve's edges, of those as in contact.csv.
Window along_edges(const Mesh& mesh, const ContactPair& pair, const PressureLine& line, const Vec2& window) {
  const double length = line.s(line.s.size() - 1);
  return runs_backwards(mesh.nodes, pair.multiplier) ? Window{length - window(1), length - window(0)}
                                                     : Window{window(0), window(1)};
}

struct Functional {
  MatX rows, opening;  // GoalFunctionals
};

// The mean of p over the window, of rings over its area; p is zero where the line does not face the other side.
Functional mean_functional(const Mesh& mesh, const Model& model, const ContactPair& pair, const PressureLine& line,
                           const Window& window) {
  const LineRule rule = gauss_legendre(3);
  VecX weights = VecX::Zero(pair.coupling.B.rows());
  double mass = 0;
  for (int e = 0; e < int(pair.multiplier.edges.size()); ++e) {
    // The edge's part in the window, -1 ... 1 along it.
    const double h = line.s(e + 1) - line.s(e), start = std::max(-1.0, 2 * (window.from - line.s(e)) / h - 1),
                 end = std::min(1.0, 2 * (window.to - line.s(e)) / h - 1);
    for (std::size_t q = 0; start < end && q < rule.points.size(); ++q) {
      const double xi = (start + end) / 2 + (end - start) / 2 * rule.points[q];
      const EdgePoint at = edge_point(mesh.nodes, pair.multiplier.edges[e], xi);
      const double dA = rule.weights[q] * (end - start) / 2 * at.jacobian() * model.depth(at.position.x());
      mass += dA;
      add_pressure_at(pair, e, xi, dA, weights);
    }
  }
  if (mass > 0) weights /= mass;
  MatX opening = MatX::Zero(Eigen::Index(pair.points.size()), 1);
  for (std::size_t i = 0; i < pair.points.size(); ++i) {
    const ContactPoint& point = pair.points[i];
    const double s = line.s(point.edge) + (line.s(point.edge + 1) - line.s(point.edge)) * (1 + point.xi) / 2;
    if (mass > 0 && s >= window.from && s <= window.to) opening(Eigen::Index(i), 0) = 1 / mass;
  }
  return {weights, opening};
}

// The multiplier side's nodes moved by 1 along x and y.
Functional force_functionals(const ContactPair& pair) {
  MatX weights = MatX::Zero(pair.coupling.own.rows(), 2);
  for_each_entry(pair.coupling.own, [&](int row, int column, double value) { weights(row, column % 2) += value; });
  MatX opening(Eigen::Index(pair.points.size()), 2);
  for (std::size_t i = 0; i < pair.points.size(); ++i)
    opening.row(Eigen::Index(i)) = -pair.points[i].normal.transpose();
  return {weights, opening};
}

// Of the pair's rows as of those of all pairs.
MatX in_all_rows(const ContactPair& pair, const MatX& weights, Eigen::Index rows) {
  MatX all = MatX::Zero(rows, weights.cols());
  all.middleRows(pair.first_row, weights.rows()) = weights;
  return all;
}

// The place in the body that is named, or in the only one that has it.
CellPlace place_of(const Mesh& mesh, const AccuracySpec& spec) {
  std::ostringstream where;
  where << "accuracy.at: (" << spec.at.x() << ", " << spec.at.y() << ") ";
  std::optional<CellPlace> place;
  for (int b = 0; b < int(mesh.bodies.size()); ++b) {
    if (!spec.body.empty() && mesh.bodies[b] != spec.body) continue;
    const auto found = locate(mesh, b, spec.at);
    if (found && place)
      throw SceneError(where.str() + "lies in bodies '" + mesh.bodies[mesh.cells[place->cell].body] + "' and '" +
                       mesh.bodies[b] + "'; expected accuracy.body = one of them");
    if (found) place = found;
  }
  if (place) return *place;
  if (!spec.body.empty() && std::ranges::count(mesh.bodies, spec.body) == 0)
    throw SceneError("accuracy.body: " + unknown_name("body", spec.body, mesh.bodies));
  throw SceneError(where.str() + "lies in " + (spec.body.empty() ? "no body" : "no part of body '" + spec.body + "'") +
                   "; expected a place in one");
}

// Those of the body with a corner in common with a cell.
std::vector<int> cells_around(const Mesh& mesh, int centre) {
  const Cell& middle = mesh.cells[centre];
  const auto corners = [](const Cell& cell) { return std::span(cell.nodes).first(corner_count(cell.kind)); };
  std::vector<int> cells;
  for (int e = 0; e < int(mesh.cells.size()); ++e)
    if (mesh.cells[e].body == middle.body &&
        std::ranges::find_first_of(corners(mesh.cells[e]), corners(middle)) != corners(mesh.cells[e]).end())
      cells.push_back(e);
  return cells;
}

Vec2 place_in(const Mesh& mesh, const CellPlace& place) {
  const Cell& cell = mesh.cells[place.cell];
  return cell_point(mesh.nodes, cell, cell_shape(cell.kind, place.xi)).x;
}

}  // namespace

MatX displacement_loads(const Mesh& mesh, const CellPlace& place) {
  const Cell& cell = mesh.cells[place.cell];
  const CellShape shape = cell_shape(cell.kind, place.xi);
  MatX loads = MatX::Zero(2 * mesh.nodes.rows(), 2);
  for (int a = 0; a < node_count(cell.kind); ++a)
    for (int c = 0; c < 2; ++c) loads(2 * cell.nodes[a] + c, c) = shape.N[a];
  return loads;
}

namespace {

// Visits the integration points of some cells: visit(cell, shape, point, weight times area).
template <typename Visit>
void for_each_point(const Mesh& mesh, const std::vector<int>& cells, Visit visit) {
  for (const int e : cells) {
    const Cell& cell = mesh.cells[e];
    const CellRule rule = product_rule(cell.kind, 3);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const CellShape shape = cell_shape(cell.kind, rule.points[q]);
      const CellPoint at = cell_point(mesh.nodes, cell, shape);
      visit(cell, shape, at, rule.weights[q] * at.jacobian());
    }
  }
}

}  // namespace

MatX stress_loads(const Mesh& mesh, const Discretisation& discretisation, const CellPlace& place) {
  const ElasticLaw& law = discretisation.laws[mesh.cells[place.cell].body];
  const std::vector<int> around = cells_around(mesh, place.cell);
  const Vec2 x = place_in(mesh, place);
  const double size = std::sqrt(cell_area(mesh, place.cell));
  const auto linear = [&](const Vec2& at) { return Eigen::Vector3d(1, (at - x).x() / size, (at - x).y() / size); };
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for_each_point(mesh, around, [&](const Cell&, const CellShape&, const CellPoint& at, double area) {
    products += area * linear(at.x) * linear(at.x).transpose();
  });
  const Eigen::Vector3d to_place = products.ldlt().solve(linear(x));
  MatX loads = MatX::Zero(2 * mesh.nodes.rows(), 3);
  for_each_point(mesh, around, [&](const Cell& cell, const CellShape& shape, const CellPoint& at, double area) {
    const NodalStrains strains = area * to_place.dot(linear(at.x)) * nodal_strains(cell, law.model, shape, at);
    for (int a = 0; a < node_count(cell.kind); ++a)
      loads.middleRows<2>(2 * cell.nodes[a]) +=
          (law.stiffness({0, 1, 3}, Eigen::all) * strains.middleCols<2>(2 * a)).transpose();
  });
  return loads;
}

std::optional<double> singular_exponent(const Surroundings& around, const std::vector<PressureEstimate>& pressures,
                                        const CellPlace& place, const Vec2& x) {
  if (const SingularPoint* point = singular_point_at(pressures, x, at_place)) return point->exponent;
  if (const SingularPoint* point = singular_point_at(pressures, x, at_place, &PressureEstimate::weak))
    return point->small_power < 0 ? std::optional(1 + point->small_power) : std::nullopt;
  const Mesh& mesh = around.mesh;
  const Cell& cell = mesh.cells[place.cell];
  const double size = (mesh.nodes.row(cell.nodes[1]) - mesh.nodes.row(cell.nodes[0])).norm();
  for (int a = 0; a < corner_count(cell.kind); ++a) {
    if ((mesh.nodes.row(cell.nodes[a]).transpose() - x).norm() > at_place * size) continue;
    const double exponent = corner_exponent(around, cell.nodes[a]);
    if (exponent <= singular_limit) return exponent;
  }
  return std::nullopt;
}

void require_stress(const Surroundings& around, const std::vector<PressureEstimate>& pressures,
                    const GoalFunctionals& functionals, const AccuracySpec& spec) {
  if (spec.of != Goal::stress || !functionals.place) return;
  const auto exponent = singular_exponent(around, pressures, *functionals.place, spec.at);
  if (!exponent) return;
  std::ostringstream text;
  text.precision(2);
  text << "accuracy.at: the stress has no limit " << near_point(spec.at) << ", where it grows as ";
  if (*exponent < 1)
    text << "r^" << *exponent - 1;
  else
    text << "ln 1/r";
  text << "; expected a place beside it, or a rounded corner";
  throw SceneError(text.str());
}

GoalFunctionals goal_functionals(const Mesh& mesh, const Discretisation& discretisation, const ContactPair& pair,
                                 const PressureLine& line, const AccuracySpec& spec) {
  const SaddlePointSystem& system = discretisation.system;
  const Eigen::Index m = system.B.rows(), n = system.K.cols();
  GoalFunctionals goal;
  const auto set = [&](Functional functional) {
    goal.rows = in_all_rows(pair, functional.rows, m);
    goal.opening = std::move(functional.opening);
  };
  switch (spec.of) {
    case Goal::pressure:
    case Goal::peak:
    case Goal::half_width:
      break;
    case Goal::mean:
      if (const std::string trouble = window_trouble(line, spec.window); !trouble.empty())
        throw SceneError("accuracy.window: " + trouble);
      set(mean_functional(mesh, discretisation.model, pair, line, along_edges(mesh, pair, line, spec.window)));
      break;
    case Goal::force:
      set(force_functionals(pair));
      break;
    case Goal::displacement:
      goal.place = place_of(mesh, spec);
      goal.loads = displacement_loads(mesh, *goal.place);
      break;
    case Goal::stress:
      goal.place = place_of(mesh, spec);
      goal.loads = stress_loads(mesh, discretisation, *goal.place);
      break;
  }
  const Eigen::Index components = std::max(goal.rows.cols(), goal.loads.cols());
  if (goal.rows.cols() < components || components == 0) goal.rows = MatX::Zero(m, components);
  if (goal.loads.cols() < components || components == 0) goal.loads = MatX::Zero(n, components);
  return goal;
}

double GoalEstimate::line() const {
  VecX sums = VecX::Zero(value.size());
  for (const LinePart& part : lines) sums += part.sum();
  return sums.norm();
}

GoalEstimate goal_estimate(const GoalFunctionals& functionals, const Solution& solution, MatX parts) {
  VecX value = functionals.loads.transpose() * solution.u - functionals.rows.transpose() * solution.lambda;
  VecX cells = off_by(parts), besides = VecX::Zero(value.size());
  return {std::move(value), std::move(parts), std::move(cells), std::move(besides)};
}

Eigen::Vector3d stress_difference(const Problem& problem, const VecX& u, const StressPatches& patches,
                                  const CellPlace& place) {
  const Mesh& mesh = problem.mesh;
  const Cell& cell = mesh.cells[place.cell];
  const ElasticLaw& law = problem.discretisation.laws[cell.body];
  const CellShape shape = cell_shape(cell.kind, place.xi);
  const Vec4 own = stress_at(mesh, cell, law, u, shape) - law.stress0(place_in(mesh, place));
  return recovered_stress(mesh, problem.points, patches, place).head<3>().transpose() - own({0, 1, 3});
}

Eigen::Vector3d cell_stress_error(const Problem& problem, const VecX& u, const StressPatches& patches,
                                  const CellPlace& place, const Eigen::Matrix3d& turn) {
  const CellRule rule = product_rule(problem.mesh.cells[place.cell].kind, 2);
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  double weight = 0;
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const CellPlace at{place.cell, rule.points[q], 0};
    squares += rule.weights[q] * (turn * stress_difference(problem, u, patches, at)).cwiseAbs2();
    weight += rule.weights[q];
  }
  const Eigen::Vector3d here = (turn * stress_difference(problem, u, patches, place)).cwiseAbs();
  return here.cwiseMax((squares / weight).cwiseSqrt());
}

double cell_displacement_error(const Problem& problem, int cell, const Eigen::Vector3d& stress) {
  const double size = std::sqrt(stress(0) * stress(0) + stress(1) * stress(1) + 2 * stress(2) * stress(2));
  return std::sqrt(cell_area(problem.mesh, cell) / std::numbers::pi) * size /
         problem.discretisation.laws[problem.mesh.cells[cell].body].young;
}

void add_displacement_error(const Problem& problem, const GoalFunctionals& functionals, const VecX& u,
                            GoalEstimate& goal) {
  const CellPlace& place = *functionals.place;
  const StressPatches patches =
      recover_patches(problem.mesh, problem.points, sample_stresses(problem.mesh, problem.discretisation.laws, u));
  const Eigen::Vector3d stress = cell_stress_error(problem, u, patches, place, Eigen::Matrix3d::Identity());
  const double own = cell_displacement_error(problem, place.cell, stress);
  goal.besides.array() += own;
  goal.parts.row(place.cell) = goal.parts.row(place.cell).cwiseAbs().array() + own;
}

void add_stress_error(const Problem& problem, const std::vector<PressureEstimate>& pressures,
                      const GoalFunctionals& functionals, const VecX& u, GoalEstimate& goal) {
  const Mesh& mesh = problem.mesh;
  const std::vector<ElasticLaw>& laws = problem.discretisation.laws;
  const CellPlace& place = *functionals.place;
  const StressPatches patches = recover_patches(mesh, problem.points, sample_stresses(mesh, laws, u));
  goal.value = recovered_stress(mesh, problem.points, patches, place).head<3>().transpose() +
               laws[mesh.cells[place.cell].body].stress0(place_in(mesh, place))({0, 1, 3});
  const Eigen::Vector3d own = cell_stress_error(problem, u, patches, place, Eigen::Matrix3d::Identity());
  goal.besides += own;
  if (const SingularPoint* point =
          singular_point_at(pressures, place_in(mesh, place), at_place, &PressureEstimate::weak))
    goal.besides += weak_change(point->small_power) * goal.value.cwiseAbs();
  goal.parts.row(place.cell) = goal.parts.row(place.cell).cwiseAbs() + own.transpose();
}

std::string window_trouble(const PressureLine& line, const Vec2& window) {
  const double length = line.s(line.s.size() - 1);
  if (window(0) < window(1) && window(1) > 0 && window(0) < length) return "";
  return worded("expected a window [from, to] with from < to on the contact line, which is ", length, " long, found [",
                window(0), ", ", window(1), "]");
}

double mean_error(const Mesh& mesh, const Model& model, const ContactPair& pair, const PressureLine& line,
                  const VecX& errors, const Vec2& window) {
  const Window along = along_edges(mesh, pair, line, window);
  double sum = 0, area = 0;
  for (Eigen::Index e = 0; e + 1 < line.s.size(); ++e) {
    const double h = line.s(e + 1) - line.s(e);
    if (line.s(e) > along.to || line.s(e) + h < along.from) continue;
    const double of_edge = h * model.depth((line.position[e].x() + line.position[e + 1].x()) / 2);
    sum += of_edge * (errors(e) + errors(e + 1)) / 2;
    area += of_edge;
  }
  return area > 0 ? sum / area : 0;
}

}  // namespace mortise
