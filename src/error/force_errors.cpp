#include "error/force_errors.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "base/dense.hpp"
#include "error/body_products.hpp"
#include "fem/edges.hpp"
#include "solve/contact_factor.hpp"

namespace mortise {
namespace {

constexpr double determinate = 1e-9;  // of a unit motion: what a rigid motion may miss of it by round-off

// Of unknown i in the motion of component c (x, y, a turn about the centre).
double unit_motion(const Mesh& mesh, int i, int c, const Vec2& centre) {
  if (c < 2) return i % 2 == c ? 1 : 0;
  const Vec2 arm = mesh.nodes.row(i / 2).transpose() - centre;
  return i % 2 == 0 ? -arm.y() : arm.x();
}

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

// Columns n: rigid motions of bodies that hang together, those of rings along the axis only.
MatX rigid_motions(const Mesh& mesh, const BodyPoints& points, bool rings) {
  const std::vector<int> bonded = bonded_to(mesh, points);
  const int motions = rings ? 1 : 3;
  std::vector<int> first(bonded.size(), -1);
  int count = 0;
  for (std::size_t b = 0; b < bonded.size(); ++b)
    if (bonded[b] == int(b)) {
      first[b] = count;
      count += motions;
    }
  MatX columns = MatX::Zero(2 * mesh.nodes.rows(), count);
  for (std::size_t b = 0; b < bonded.size(); ++b)
    for (int p = points.first[b]; p < points.first[b + 1]; ++p)
      for (int i = 2 * points.node[p]; i < 2 * points.node[p] + 2; ++i)
        for (int c = 0; c < motions; ++c)
          columns(i, first[bonded[b]] + c) = unit_motion(mesh, i, rings ? 1 : c, Vec2::Zero());
  return columns;
}

// Whether equilibrium fixes a force: a rigid motion of the bodies opens the rows as the functional asks, and moves
// nothing that is prescribed.
class Statics {
 public:
  Statics(const Mesh& mesh, const BodyPoints& points, const SaddlePointSystem& system) : system_(system) {
    if (system.constraints.multipoint) return;
    motions_ = rigid_motions(mesh, points, system.constraints.rings);
    std::vector<int> fixed;
    for (int i = 0; i < int(system.constraints.fixed.size()); ++i)
      if (system.constraints.fixed[i]) fixed.push_back(i);
    const MatX of_rows = system.row_scale.cwiseInverse().asDiagonal() * (system.B * motions_).eval();
    const SparseMatrix& springs = system.constraints.springs;
    const MatX of_springs = springs.cols() > 0 ? MatX(springs * motions_) : MatX(0, motions_.cols());
    all_.resize(of_rows.rows() + Eigen::Index(fixed.size()) + of_springs.rows(), motions_.cols());
    all_ << of_rows, motions_(fixed, Eigen::all), of_springs;
    if (all_.size() > 0) factor_.emplace(all_);
  }

  // That motion, n.
  std::optional<VecX> motion(const VecX& rows) const {
    if (!factor_) return std::nullopt;
    VecX wanted = VecX::Zero(all_.rows());
    wanted.head(rows.size()) = rows.cwiseQuotient(system_.row_scale);
    const VecX parts = factor_->solve(wanted);
    if (!(largest_entry(wanted - all_ * parts) <= determinate * largest_entry(wanted))) return std::nullopt;
    return motions_ * parts;
  }

 private:
  const SaddlePointSystem& system_;
  MatX motions_, all_;  // n x motions; of these what is held at zero
  std::optional<LeastSquares> factor_;
};

// Of each unknown the force that the solution leaves, where none is held, and round-off of the load.
VecX what_is_left(const SaddlePointSystem& s, const Solution& solution) {
  VecX left = (s.f - s.K.selfadjointView<Eigen::Lower>() * solution.u - s.B.transpose() * solution.lambda).cwiseAbs();
  for (Eigen::Index i = 0; i < left.size(); ++i)
    if (s.constraints.fixed[i]) left(i) = 0;
  return left + std::numeric_limits<double>::epsilon() * s.f.cwiseAbs();
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

}  // namespace

ForcesAsked ask_forces(const Problem& problem, const Solution& solution, const std::vector<Vec2>& centres) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const Mesh& mesh = problem.mesh;
  const SaddlePointSystem& system = problem.discretisation.system;
  const std::vector<ContactPair>& pairs = problem.pairs;
  ForcesAsked asked{.by_statics = {pairs.size(), Eigen::Vector3d::Constant(unknown)}, .by_duals = {}, .rows = {}};
  if (pairs.size() > std::size_t(most_own_duals) || mesh.bodies.size() > std::size_t(most_own_duals)) return asked;
  const Statics statics(mesh, problem.points, system);
  const VecX left = what_is_left(system, solution);
  std::vector<VecX> rows;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      VecX opened = opened_rows(problem, centres, {k, c});
      if (const auto motion = statics.motion(opened)) {
        asked.by_statics[k](c) = left.dot(motion->cwiseAbs());
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
                                          const std::vector<Vec2>& centres) {
  const ForcesAsked asked = ask_forces(problem, solution, centres);
  FoundDuals duals;
  if (!asked.by_duals.empty())
    duals = find_duals(problem, solution.u, contact_factor(problem.discretisation.system, solution), asked.rows);
  return force_errors(problem, pressures, centres, asked, duals);
}

}  // namespace mortise
