#include "fem/motion_sets.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <map>

#include "base/dense.hpp"
#include "base/each_once.hpp"
#include "base/union_find.hpp"
#include "fem/elements.hpp"
#include "fem/quadrature.hpp"

namespace mortise {

namespace {

// Motions that have bodies in common, directly or by others, ascending.
std::vector<std::vector<int>> linked(const Mesh& mesh, const std::vector<std::vector<RigidMotion>>& motions) {
  UnionFind bodies(mesh.bodies.size());
  for (const auto& motion : motions)
    for (const RigidMotion& of_body : motion) bodies.join(motion.front().body, of_body.body);
  std::vector<int> set_of(mesh.bodies.size(), -1);
  std::vector<std::vector<int>> sets;
  for (int m = 0; m < int(motions.size()); ++m) {
    int& set = set_of[bodies.find(motions[m].front().body)];
    if (set < 0) {
      set = int(sets.size());
      sets.emplace_back();
    }
    sets[set].push_back(m);
  }
  return sets;
}

}  // namespace

std::vector<MotionSet> motion_sets(const Mesh& mesh, const std::vector<std::vector<RigidMotion>>& motions) {
  const BodyPoints points = body_points(mesh);
  std::vector<MotionSet> sets;
  std::vector<int> row_of(mesh.nodes.rows());
  for (auto& members : linked(mesh, motions)) {
    MotionSet& set = sets.emplace_back(std::move(members));
    for (const int m : set.motions)
      for (const RigidMotion& motion : motions[m])
        set.nodes.insert(set.nodes.end(), points.node.begin() + points.first[motion.body],
                         points.node.begin() + points.first[motion.body + 1]);
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

struct ShapedRule {
  std::vector<double> weights;
  std::vector<CellShape> shapes;
};

// Exact for motions times u where cells' maps are affine.
ForEachKind<ShapedRule> shaped_rules() {
  ForEachKind<ShapedRule> rules;
  for (const CellKind kind : all_cell_kinds) {
    const CellRule rule = product_rule(kind, 3);
    rules[int(kind)].weights = rule.weights;
    for (const Vec2& xi : rule.points) rules[int(kind)].shapes.push_back(cell_shape(kind, xi));
  }
  return rules;
}

using Vec3 = Eigen::Vector3d;

// Of a body's motions, translations and the turn about its centre: mean products over its area, with one another and
// with u.
struct MotionProducts {
  Eigen::Matrix3d motions = Eigen::Matrix3d::Zero();
  Vec3 u = Vec3::Zero();
};

std::vector<MotionProducts> motion_products(const Mesh& mesh, const std::vector<const RigidMotion*>& moved,
                                            const VecX& u) {
  std::vector<MotionProducts> products(mesh.bodies.size());
  const ForEachKind<ShapedRule> rules = shaped_rules();
  for (const Cell& cell : mesh.cells) {
    if (!moved[cell.body]) continue;
    const ShapedRule& rule = rules[int(cell.kind)];
    for (std::size_t q = 0; q < rule.shapes.size(); ++q) {
      Vec2 arm = -moved[cell.body]->centre, value = Vec2::Zero();
      for (int a = 0; a < node_count(cell.kind); ++a) {
        arm += rule.shapes[q].N[a] * mesh.nodes.row(cell.nodes[a]).transpose();
        value += rule.shapes[q].N[a] * u.segment<2>(2 * cell.nodes[a]);
      }
      Eigen::Matrix<double, 2, 3> fields;
      fields << 1, 0, -arm.y(), 0, 1, arm.x();
      const double area = rule.weights[q] * cell_point(mesh.nodes, cell, rule.shapes[q]).jacobian();
      products[cell.body].motions += area * fields.transpose() * fields;
      products[cell.body].u += area * fields.transpose() * value;
    }
  }
  return products;
}

Vec3 components(const RigidMotion& motion) { return {motion.translation.x(), motion.translation.y(), motion.rotation}; }

// The sum of `parts` of `motions`, of each body that has one.
std::vector<RigidMotion> sum_of(const std::vector<std::vector<RigidMotion>>& motions, const VecX& parts) {
  std::map<int, RigidMotion> sum;  // by body
  for (std::size_t m = 0; m < motions.size(); ++m)
    for (const RigidMotion& motion : motions[m]) {
      RigidMotion& total = sum.try_emplace(motion.body, motion.body, Vec2::Zero(), 0.0, motion.centre).first->second;
      total.translation += parts(m) * motion.translation;
      total.rotation += parts(m) * motion.rotation;
    }
  std::vector<RigidMotion> list;
  for (const auto& [body, motion] : sum) list.push_back(motion);
  return list;
}

}  // namespace

std::vector<std::vector<RigidMotion>> least_motions(const Mesh& mesh,
                                                    const std::vector<std::vector<RigidMotion>>& motions,
                                                    const VecX& u) {
  std::vector<const RigidMotion*> moved(mesh.bodies.size());
  for (const auto& motion : motions)
    for (const RigidMotion& of_body : motion) moved[of_body.body] = &of_body;
  const std::vector<MotionProducts> products = motion_products(mesh, moved, u);
  std::vector<std::vector<RigidMotion>> least;
  for (const std::vector<int>& set : linked(mesh, motions)) {
    std::vector<std::vector<RigidMotion>> own;
    for (const int m : set) own.push_back(motions[m]);
    MatX among(set.size(), set.size());
    VecX with_u = VecX::Zero(set.size());
    std::vector<Vec3> of_body(mesh.bodies.size(), Vec3::Zero());
    for (std::size_t m = 0; m < set.size(); ++m) {
      for (const RigidMotion& motion : own[m]) {
        of_body[motion.body] = products[motion.body].motions * components(motion);
        with_u(m) += products[motion.body].u.dot(components(motion));
      }
      for (std::size_t k = 0; k < set.size(); ++k) {
        among(k, m) = 0;
        for (const RigidMotion& motion : own[k]) among(k, m) += of_body[motion.body].dot(components(motion));
      }
      for (const RigidMotion& motion : own[m]) of_body[motion.body].setZero();
    }
    least.push_back(sum_of(own, -among.ldlt().solve(with_u)));
  }
  return least;
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

// The sum of `parts` of `motions`, of unit size.
std::vector<RigidMotion> combined(const std::vector<std::vector<RigidMotion>>& motions, const VecX& parts,
                                  const BodyFrames& frames) {
  std::vector<RigidMotion> sum = sum_of(motions, parts);
  double size = 0, turning = 0;
  for (const RigidMotion& motion : sum) {
    size = std::max(size, motion.translation.norm());
    turning = std::max(turning, std::abs(motion.rotation) * frames.size[motion.body]);
  }
  if (size < 1e-6 * turning) {  // round-off
    size = 0;
    for (RigidMotion& motion : sum) {
      motion.translation.setZero();
      size = std::max(size, std::abs(motion.rotation));
    }
  }
  for (RigidMotion& motion : sum) {
    motion.translation /= size;
    motion.rotation /= size;
  }
  return sum;
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
