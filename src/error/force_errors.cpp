#include "error/force_errors.hpp"

#include <algorithm>
#include <limits>

#include "error/border_overlaps.hpp"
#include "error/corner_cells.hpp"
#include "error/data_works.hpp"
#include "error/outline_works.hpp"
#include "fem/edges.hpp"
#include "solve/contact_factor.hpp"

namespace mortise {
namespace {

// m: by how much the rows are to open where the multiplier side of a pair moves by 1.
VecX opened_rows(const Problem& problem, const std::vector<Vec2>& centres, const ForcesAsked::One& asked) {
  const SaddlePointSystem& system = problem.discretisation.system;
  const ContactPair& pair = problem.pairs[asked.pair];
  VecX motion = VecX::Zero(system.K.cols()), rows = VecX::Zero(system.B.rows());
  for (const int node : curve_nodes(pair.multiplier))
    for (const int i : {2 * node, 2 * node + 1})
      motion(i) = unit_motion(problem.mesh, i, asked.component, centres[asked.pair]);
  rows.segment(pair.first_row, pair.coupling.B.rows()) = pair.coupling.own * motion;
  return rows;
}

// The work of a motion with the forces that the solution leaves, where none is held but as idle, and with round-off of
// the load, without signs.
double work_left(const Problem& problem, const Solution& solution, const VecX& motion) {
  const SaddlePointSystem& s = problem.discretisation.system;
  const Constraints& constraints = s.constraints;
  VecX left = unbalanced_forces(s, solution), q = motion;
  if (constraints.multipoint) {
    left = (constraints.multipoint->T.transpose() * left).eval();
    q = constraints.multipoint->inverse * motion;
  }
  std::vector<char> held = constraints.fixed;
  for (const int i : problem.idle) held[i] = 0;
  double work = std::numeric_limits<double>::epsilon() * s.f.cwiseAbs().dot(motion.cwiseAbs());
  for (Eigen::Index i = 0; i < left.size(); ++i)
    if (!held[i]) work += std::abs(left(i) * q(i));
  return work;
}

// What the work of a motion with all that fluids do besides their rows changes by where each front stands an edge away:
// on sides that part, both are not pressed alike.
double work_of_fronts(const Problem& problem, const VecX& motion) {
  if (problem.fluid.size() == 0) return 0;
  const VecX works = problem.fluid_loads * motion - problem.discretisation.system.B * motion;
  double sum = 0;
  for (const ContactPair& pair : problem.pairs) {
    if (!pair.spec.fluid) continue;
    for (const auto& on : pair.coupling.on_edge) {
      const int a = pair.coupling.row[on[0]], b = pair.coupling.row[on[1]];
      if (a < 0 || b < 0) continue;
      const Eigen::Index first = pair.first_row + a, last = pair.first_row + b;
      if ((problem.fluid(first) > 0) != (problem.fluid(last) > 0))
        sum += pair.spec.fluid->pressure * std::max(std::abs(works(first)), std::abs(works(last)));
    }
  }
  return sum;
}

// At each contact point of a pair a unit motion of the multiplier side along its normal.
VecX along_normals(const Mesh& mesh, const ContactPair& pair, int component, const Vec2& centre) {
  VecX along(Eigen::Index(pair.points.size()));
  for (Eigen::Index i = 0; i < along.size(); ++i) {
    const ContactPoint& point = pair.points[i];
    const Vec2 arm = edge_point(mesh.nodes, pair.multiplier.edges[point.edge], point.xi).position - centre;
    const Vec2 motion = component < 2 ? Vec2(Vec2::Unit(component)) : Vec2(-arm.y(), arm.x());
    along(i) = point.normal.dot(motion);
  }
  return along;
}

// What the error of p on all lines does to each.
VecX errors_of_lines(const Problem& problem, const std::vector<PressureEstimate>& pressures,
                     const std::vector<Vec2>& centres, const ForcesAsked& asked, const MatX& z) {
  const std::vector<ContactPair>& pairs = problem.pairs;
  VecX errors = VecX::Zero(z.cols());
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    MatX opened = openings(pairs[p], z);
    for (Eigen::Index k = 0; k < z.cols(); ++k)
      if (const auto& one = asked.by_duals[k]; one.pair == p)
        opened.col(k) += along_normals(problem.mesh, pairs[p], one.component, centres[p]);
    errors += line_part(pairs[p], pressures[p].line, pressures[p].local, opened).sum();
  }
  return errors;
}

// By the bars of p: force along x and y, and moment.
Eigen::Vector3d sum_of_bars(const Mesh& mesh, const ContactPair& pair, const PressureEstimate& estimate,
                            const Vec2& centre) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const std::array<VecX, 3> along{along_normals(mesh, pair, 0, centre), along_normals(mesh, pair, 1, centre),
                                  along_normals(mesh, pair, 2, centre)};
  for (std::size_t i = 0; i < pair.points.size(); ++i) {
    const ContactPoint& point = pair.points[i];
    const double end = (1 + point.xi) / 2,
                 bar = (1 - end) * estimate.bar(point.edge) + end * estimate.bar(point.edge + 1);
    for (int c = 0; c < 3; ++c) sum(c) += point.dA * bar * std::abs(along[c](Eigen::Index(i)));
  }
  return sum;
}

FoundDuals find_duals(const Problem& problem, const Solution& solution, const std::vector<PressureEstimate>& pressures,
                      const MatX& functionals, EstimateMemory& memory) {
  const VecX& u = solution.u;
  FoundDuals found{.z = MatX(u.size(), functionals.cols()), .sums = {}};
  const auto keep = [&](Eigen::Index first, const DualSums& duals) {
    found.z.middleCols(first, duals.count()) = duals.fields();
  };
  const ErrorProducts products = memory.products.with_duals(
      problem, u, contact_factor(problem.discretisation.system, solution), {functionals, MatX(u.size(), 0)}, keep);
  const MatX parts = products.products.rightCols(functionals.cols());
  found.sums = off_by(parts) + unseen_at_corners(problem.mesh, cells_at_corners(problem, pressures, memory), parts) +
               off_by(data_works(problem, u, found.z)) +
               BorderOverlaps(problem, solution, pressures).changes(functionals, {}).colwise().sum().transpose();
  return found;
}

}  // namespace

ForcesAsked ask_forces(const Problem& problem, const Solution& solution, const std::vector<Vec2>& centres,
                       EstimateMemory& memory) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const Mesh& mesh = problem.mesh;
  const SaddlePointSystem& system = problem.discretisation.system;
  const std::vector<ContactPair>& pairs = problem.pairs;
  ForcesAsked asked{.by_statics = {pairs.size(), Eigen::Vector3d::Constant(unknown)}, .by_duals = {}, .rows = {}};
  if (pairs.size() > std::size_t(most_own_duals) || mesh.bodies.size() > std::size_t(most_own_duals)) return asked;
  memory.keep_for(problem);
  const Statics& statics = memory.statics(problem);
  std::vector<VecX> rows;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      VecX opened = opened_rows(problem, centres, {k, c});
      if (const auto motion = statics.motion(opened)) {
        asked.by_statics[k](c) = work_left(problem, solution, *motion) + work_of_fronts(problem, *motion) +
                                 error_safety * off_by(MatX(outline_works(problem, solution.u, *motion)))(0);
      } else {
        asked.by_duals.push_back({k, c});
        rows.push_back(std::move(opened));
      }
    }
  if (rows.size() > std::size_t(most_own_duals)) {
    rows.clear();
    asked.by_duals.clear();
  }
  asked.rows.resize(system.B.rows(), Eigen::Index(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) asked.rows.col(Eigen::Index(k)) = rows[k];
  return asked;
}

std::vector<Eigen::Vector3d> force_errors(const Problem& problem, const std::vector<PressureEstimate>& pressures,
                                          const std::vector<Vec2>& centres, const ForcesAsked& asked,
                                          const FoundDuals& duals) {
  const std::vector<ContactPair>& pairs = problem.pairs;
  std::vector<Eigen::Vector3d> errors;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Eigen::Vector3d& known = asked.by_statics[k];
    errors.push_back(
        known.array().isNaN().select(sum_of_bars(problem.mesh, pairs[k], pressures[k], centres[k]), known));
  }
  if (asked.by_duals.empty()) return errors;
  const VecX found = duals.sums + errors_of_lines(problem, pressures, centres, asked, duals.z);
  for (std::size_t k = 0; k < asked.by_duals.size(); ++k)
    errors[asked.by_duals[k].pair](asked.by_duals[k].component) = error_safety * found(Eigen::Index(k));
  return errors;
}

std::vector<Eigen::Vector3d> force_errors(const Problem& problem, const Solution& solution,
                                          const std::vector<PressureEstimate>& pressures,
                                          const std::vector<Vec2>& centres, EstimateMemory& memory) {
  const ForcesAsked asked = ask_forces(problem, solution, centres, memory);
  FoundDuals duals;
  if (!asked.by_duals.empty()) duals = find_duals(problem, solution, pressures, asked.rows, memory);
  return force_errors(problem, pressures, centres, asked, duals);
}

}  // namespace mortise
