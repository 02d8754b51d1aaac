#include "fem/motion_sets.hpp"

#include <algorithm>
#include <map>

#include "base/dense.hpp"
#include "base/each_once.hpp"
#include "base/union_find.hpp"
#include "fem/elements.hpp"
#include "fem/quadrature.hpp"

namespace mortise {

std::vector<MotionSet> motion_sets(const Mesh& mesh, const std::vector<std::vector<RigidMotion>>& motions) {
  UnionFind bodies(mesh.bodies.size());
  for (const auto& motion : motions)
    for (const RigidMotion& of_body : motion) bodies.join(motion.front().body, of_body.body);
  const BodyPoints points = body_points(mesh);
  std::vector<int> set_of(mesh.bodies.size(), -1);
  std::vector<MotionSet> sets;
  for (int m = 0; m < int(motions.size()); ++m) {
    int& set = set_of[bodies.find(motions[m].front().body)];
    if (set < 0) {
      set = int(sets.size());
      sets.emplace_back();
    }
    sets[set].motions.push_back(m);
    for (const RigidMotion& motion : motions[m])
      sets[set].nodes.insert(sets[set].nodes.end(), points.node.begin() + points.first[motion.body],
                             points.node.begin() + points.first[motion.body + 1]);
  }
  std::vector<int> row_of(mesh.nodes.rows());
  for (MotionSet& set : sets) {
    keep_each_once(set.nodes);
    for (std::size_t i = 0; i < set.nodes.size(); ++i) row_of[set.nodes[i]] = int(2 * i);
    set.fields = MatX::Zero(2 * set.nodes.size(), set.motions.size());
    for (std::size_t k = 0; k < set.motions.size(); ++k)
      for (const RigidMotion& motion : motions[set.motions[k]])
        for (int p = points.first[motion.body]; p < points.first[motion.body + 1]; ++p)
          set.fields.block<2, 1>(row_of[points.node[p]], k) = motion.at(mesh.nodes.row(points.node[p]));
  }
  return sets;
}

namespace {

struct MassRule {
  std::vector<double> weights;
  std::vector<CellShape> shapes;
};

ForEachKind<MassRule> mass_rules() {
  ForEachKind<MassRule> rules;
  for (const CellKind kind : all_cell_kinds) {
    const CellRule rule = product_rule(kind, 3);  // exact for motions times u
    rules[int(kind)].weights = rule.weights;
    for (const Vec2& xi : rule.points) rules[int(kind)].shapes.push_back(cell_shape(kind, xi));
  }
  return rules;
}

using MassOfCell = Eigen::Matrix<double, 9, 9>;

// int N_a N_b over its area, of its nodes.
MassOfCell mass_of(const Mesh& mesh, const Cell& cell, const MassRule& rule) {
  MassOfCell mass = MassOfCell::Zero();
  const int count = node_count(cell.kind);
  for (std::size_t q = 0; q < rule.shapes.size(); ++q) {
    const auto& N = rule.shapes[q].N;
    const double area = rule.weights[q] * cell_point(mesh.nodes, cell, rule.shapes[q]).jacobian();
    for (int b = 0; b < count; ++b)
      for (int a = 0; a < count; ++a) mass(a, b) += area * N[a] * N[b];
  }
  return mass;
}

}  // namespace

std::vector<VecX> least_parts(const Mesh& mesh, const std::vector<MotionSet>& sets, const VecX& u) {
  const ForEachKind<MassRule> rules = mass_rules();
  std::vector<MatX> products;  // of motions by motions and, in the last column, by u
  std::vector<int> set_of(mesh.nodes.rows(), -1), row_of(mesh.nodes.rows(), -1);
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const Eigen::Index count = sets[s].fields.cols();
    products.emplace_back(MatX::Zero(count, count + 1));
    for (std::size_t i = 0; i < sets[s].nodes.size(); ++i) {
      set_of[sets[s].nodes[i]] = int(s);
      row_of[sets[s].nodes[i]] = int(2 * i);
    }
  }
  for (const Cell& cell : mesh.cells) {
    const int count = node_count(cell.kind), set = set_of[cell.nodes[0]];
    if (set < 0 || std::any_of(cell.nodes.begin(), cell.nodes.begin() + count, [&](int i) { return set_of[i] != set; }))
      continue;
    const MatX& fields = sets[set].fields;
    const Eigen::Index motions = fields.cols();
    const MassOfCell mass = mass_of(mesh, cell, rules[int(cell.kind)]);
    for (Eigen::Index k = 0; k <= motions; ++k) {
      const auto at = [&](int a) -> Vec2 {
        return k < motions ? Vec2(fields.block<2, 1>(row_of[cell.nodes[a]], k)) : Vec2(u.segment<2>(2 * cell.nodes[a]));
      };
      for (int b = 0; b < count; ++b) {
        Vec2 sum = Vec2::Zero();
        for (int a = 0; a < count; ++a) sum += mass(a, b) * at(a);
        for (Eigen::Index m = 0; m < motions; ++m)
          products[set](m, k) += fields.block<2, 1>(row_of[cell.nodes[b]], m).dot(sum);
      }
    }
  }
  std::vector<VecX> parts;
  for (const MatX& p : products) parts.push_back(-p.leftCols(p.rows()).ldlt().solve(p.rightCols<1>()));
  return parts;
}

std::vector<int> grounding_unknowns(const Mesh& mesh, const Constraints& constraints,
                                    const std::vector<std::vector<RigidMotion>>& motions) {
  std::vector<int> unknowns(motions.size());
  for (MotionSet& set : motion_sets(mesh, motions)) {
    MatX& fields = set.fields;
    for (Eigen::Index i = 0; i < fields.rows(); ++i)
      if (const int unknown = set.unknown(i);
          constraints.fixed[unknown] || (constraints.multipoint && constraints.multipoint->coupled[unknown]))
        fields.row(i).setZero();
    for (Eigen::Index m = 0; m < fields.cols(); ++m) {  // Gaussian elimination with row pivots
      const VecX sizes = fields.col(m).cwiseAbs();
      const double least = (1 - 1e-6) * sizes.maxCoeff();
      Eigen::Index pivot = 0;  // the first of those that are as large but for round-off
      while (sizes(pivot) < least) ++pivot;
      unknowns[set.motions[m]] = set.unknown(pivot);
      for (Eigen::Index other = m + 1; other < fields.cols(); ++other)
        fields.col(other) -= fields(pivot, other) / fields(pivot, m) * fields.col(m);
    }
  }
  return unknowns;
}

MatX motions_at(const MotionSet& set, const std::vector<int>& unknowns) {
  MatX at(set.motions.size(), set.motions.size());
  for (std::size_t k = 0; k < set.motions.size(); ++k) {
    const int unknown = unknowns[set.motions[k]];
    const auto node = std::ranges::lower_bound(set.nodes, unknown / 2);
    at.row(k) = set.fields.row(2 * (node - set.nodes.begin()) + unknown % 2);
  }
  return at;
}

namespace {

// `parts`: of each motion.
std::vector<RigidMotion> combined(const std::vector<std::vector<RigidMotion>>& motions, const VecX& parts,
                                  const BodyFrames& frames) {
  std::map<int, RigidMotion> sum;  // by body
  for (std::size_t m = 0; m < motions.size(); ++m)
    for (const RigidMotion& motion : motions[m]) {
      RigidMotion& total = sum.try_emplace(motion.body, motion.body, Vec2::Zero(), 0.0, motion.centre).first->second;
      total.translation += parts(m) * motion.translation;
      total.rotation += parts(m) * motion.rotation;
    }
  double size = 0, turning = 0;
  for (const auto& [body, motion] : sum) {
    size = std::max(size, motion.translation.norm());
    turning = std::max(turning, std::abs(motion.rotation) * frames.size[body]);
  }
  if (size < 1e-6 * turning) {  // round-off
    size = 0;
    for (auto& [body, motion] : sum) {
      motion.translation.setZero();
      size = std::max(size, std::abs(motion.rotation));
    }
  }
  std::vector<RigidMotion> result;
  for (auto& [body, motion] : sum) {
    motion.translation /= size;
    motion.rotation /= size;
    result.push_back(motion);
  }
  return result;
}

}  // namespace

std::vector<std::vector<RigidMotion>> motions_through(const Mesh& mesh,
                                                      const std::vector<std::vector<RigidMotion>>& motions,
                                                      const std::vector<int>& unknowns, const MatX& values) {
  std::vector<std::vector<RigidMotion>> through;
  if (values.cols() == 0) return through;
  MatX parts(values.rows(), values.cols());
  for (const MotionSet& set : motion_sets(mesh, motions))
    parts(set.motions, Eigen::all) = inverse_of(motions_at(set, unknowns)) * values(set.motions, Eigen::all);
  const BodyFrames frames = body_frames(mesh, body_points(mesh));
  for (const auto& of_one : parts.colwise()) through.push_back(combined(motions, of_one, frames));
  return through;
}

}  // namespace mortise
