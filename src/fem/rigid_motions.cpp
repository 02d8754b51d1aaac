#include "fem/rigid_motions.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "base/columns.hpp"
#include "base/dense.hpp"
#include "mesh/body_points.hpp"

namespace mortise {
namespace {

// Each body's centre and half-diagonal, so that the three motions of a body are of one size.
struct BodyFrames {
  std::vector<Vec2> centre;
  std::vector<double> size;
};

BodyFrames body_frames(const Mesh& mesh, const BodyPoints& points) {
  BodyFrames frames;
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    Vec2 low = mesh.nodes.row(points.node[points.first[b]]).transpose(), high = low;
    for (int p = points.first[b]; p < points.first[b + 1]; ++p) {
      const Vec2 x = mesh.nodes.row(points.node[p]).transpose();
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    frames.centre.push_back((low + high) / 2);
    frames.size.push_back((high - low).norm() / 2);
  }
  return frames;
}

// Motion k of a body (0, 1: translations; 2: rotation by 1/size) at x, component c.
double motion_at(int k, const Vec2& x, const Vec2& centre, double size, int c) {
  if (k < 2) return k == c ? 1 : 0;
  return c == 0 ? -(x.y() - centre.y()) / size : (x.x() - centre.x()) / size;
}

// What is asked of the 3 motions of each body: 3 columns a body.
struct Bodies {
  explicit Bodies(const Mesh& of) : mesh(of), points(body_points(of)), frames(body_frames(of, points)) {}

  Eigen::Index columns() const { return 3 * mesh.bodies.size(); }
  // Component c of the motions of body b at x.
  Eigen::RowVector3d at(int b, const Vec2& x, int c) const {
    Eigen::RowVector3d motion;
    for (int k = 0; k < 3; ++k) motion(k) = motion_at(k, x, frames.centre[b], frames.size[b], c);
    return motion;
  }
  // Calls visit(body, node, position) for each node of each body.
  template <typename Visit>
  void for_each_node(Visit visit) const {
    for (int b = 0; b < int(mesh.bodies.size()); ++b)
      for (int p = points.first[b]; p < points.first[b + 1]; ++p)
        visit(b, points.node[p], Vec2(mesh.nodes.row(points.node[p]).transpose()));
  }

  const Mesh& mesh;
  BodyPoints points;
  BodyFrames frames;
};

// Gram matrix of what the constraints see of the motions, and of the jumps between bodies that share nodes: they move
// together.
MatX supports(const Bodies& bodies, const Constraints& constraints) {
  MatX gram = MatX::Zero(bodies.columns(), bodies.columns());
  std::vector<int> owner(bodies.mesh.nodes.rows(), -1);
  bodies.for_each_node([&](int b, int node, const Vec2& x) {
    const int other = owner[node];
    if (other < 0) owner[node] = b;
    for (int c = 0; c < 2; ++c) {
      Eigen::RowVectorXd seen = Eigen::RowVectorXd::Zero(bodies.columns());
      seen.segment<3>(3 * b) = bodies.at(b, x, c);
      if (constraints.fixed[2 * node + c]) gram += seen.transpose() * seen;
      if (other < 0) continue;
      seen.segment<3>(3 * other) -= bodies.at(other, x, c);
      gram += seen.transpose() * seen;
    }
  });
  return gram;
}

// How the motions open the rows. Of a shared node only the first body counts.
MatX openings(const Bodies& bodies, const SparseMatrix& rows) {
  MatX contact = MatX::Zero(rows.rows(), bodies.columns());
  std::vector<char> counted(bodies.mesh.nodes.rows(), 0);
  bodies.for_each_node([&](int b, int node, const Vec2& x) {
    if (counted[node]) return;
    counted[node] = 1;
    for (int c = 0; c < 2; ++c)
      for (SparseMatrix::InnerIterator it(rows, 2 * node + c); it; ++it)
        contact.block<1, 3>(it.row(), 3 * b) += it.value() * bodies.at(b, x, c);
  });
  return contact;
}

MatX openings(const Bodies& bodies, const std::vector<ContactNormal>& normals) {
  MatX contact = MatX::Zero(normals.size(), bodies.columns());
  for (std::size_t k = 0; k < normals.size(); ++k)
    for (int c = 0; c < 2; ++c) {
      const ContactNormal& at = normals[k];
      contact.block<1, 3>(k, 3 * at.other) += at.normal(c) * bodies.at(at.other, at.position, c);
      contact.block<1, 3>(k, 3 * at.body) -= at.normal(c) * bodies.at(at.body, at.position, c);
    }
  return contact;
}

// Motions that supports and contact resist by less than `part` of their size.
std::vector<std::vector<RigidMotion>> unresisted(const Bodies& bodies, const Constraints& constraints,
                                                 const MatX& contact, double part) {
  const MatX gram = supports(bodies, constraints) + contact.transpose() * contact;
  const SymmetricEigen eigen = symmetric_eigen(gram);
  Eigen::Index count = 0;  // relative to one fixed node
  const double limit = part * part * std::max(1.0, eigen.values(gram.cols() - 1));
  while (count < gram.cols() && eigen.values(count) <= limit) ++count;
  const MatX apart = told_apart(eigen.vectors.leftCols(count));
  std::vector<std::vector<RigidMotion>> motions;
  for (Eigen::Index m = 0; m < count; ++m) {
    std::vector<RigidMotion> motion;
    for (int b = 0; b < int(bodies.mesh.bodies.size()); ++b) {
      const Eigen::Vector3d of_body = apart.block<3, 1>(3 * b, m);
      if (of_body.norm() > 1e-6)
        motion.push_back({b, of_body.head<2>(), of_body(2) / bodies.frames.size[b], bodies.frames.centre[b]});
    }
    motions.push_back(motion);
  }
  std::stable_sort(motions.begin(), motions.end(),
                   [](const auto& a, const auto& b) { return a.front().body < b.front().body; });
  return motions;
}

}  // namespace

std::vector<std::vector<RigidMotion>> free_motions(const Mesh& mesh, const Constraints& constraints,
                                                   const SparseMatrix& rows) {
  const Bodies bodies(mesh);
  return unresisted(bodies, constraints, openings(bodies, rows), 1e-7);
}

std::vector<std::vector<RigidMotion>> free_motions(const Mesh& mesh, const Constraints& constraints,
                                                   const std::vector<ContactNormal>& normals) {
  const Bodies bodies(mesh);
  return unresisted(bodies, constraints, openings(bodies, normals), 1e-6);
}

MatX motion_fields(const Mesh& mesh, const std::vector<std::vector<RigidMotion>>& motions) {
  const BodyPoints points = body_points(mesh);
  MatX fields = MatX::Zero(2 * mesh.nodes.rows(), motions.size());
  for (std::size_t m = 0; m < motions.size(); ++m)
    for (const RigidMotion& motion : motions[m])
      for (int p = points.first[motion.body]; p < points.first[motion.body + 1]; ++p) {
        const int node = points.node[p];
        const Vec2 arm = mesh.nodes.row(node).transpose() - motion.centre;
        fields.block<2, 1>(2 * node, m) = motion.translation + motion.rotation * Vec2(-arm.y(), arm.x());
      }
  return fields;
}

std::vector<int> grounding_unknowns(const Mesh& mesh, const Constraints& constraints,
                                    const std::vector<std::vector<RigidMotion>>& motions) {
  MatX fields = motion_fields(mesh, motions);
  for (Eigen::Index i = 0; i < fields.rows(); ++i)
    if (constraints.fixed[i]) fields.row(i).setZero();
  std::vector<int> unknowns;
  for (Eigen::Index m = 0; m < fields.cols(); ++m) {  // Gaussian elimination with row pivots
    const VecX sizes = fields.col(m).cwiseAbs();
    Eigen::Index pivot = 0;  // the first of those that are as large but for round-off
    while (sizes(pivot) < (1 - 1e-6) * sizes.maxCoeff()) ++pivot;
    unknowns.push_back(int(pivot));
    for (Eigen::Index other = m + 1; other < fields.cols(); ++other)
      fields.col(other) -= fields(pivot, other) / fields(pivot, m) * fields.col(m);
  }
  return unknowns;
}

std::vector<RigidMotion> motion_through(const Mesh& mesh, const std::vector<std::vector<RigidMotion>>& motions,
                                        const std::vector<int>& unknowns, const VecX& values) {
  const MatX fields = motion_fields(mesh, motions);
  MatX at(values.size(), fields.cols());
  for (Eigen::Index k = 0; k < values.size(); ++k) at.row(k) = fields.row(unknowns[k]);
  const VecX parts = solve_square(at, values);
  std::map<int, RigidMotion> sum;  // by body
  for (std::size_t m = 0; m < motions.size(); ++m)
    for (const RigidMotion& motion : motions[m]) {
      RigidMotion& total = sum.try_emplace(motion.body, motion.body, Vec2::Zero(), 0.0, motion.centre).first->second;
      total.translation += parts(m) * motion.translation;
      total.rotation += parts(m) * motion.rotation;
    }
  const BodyFrames frames = body_frames(mesh, body_points(mesh));
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

std::string describe(const Mesh& mesh, const std::vector<RigidMotion>& motion) {
  std::ostringstream text;
  text.precision(3);
  double size = 0;
  for (const RigidMotion& m : motion) size = std::max({size, m.translation.norm(), std::abs(m.rotation)});
  const auto shown = [&](double value) { return std::abs(value) < 1e-6 * size ? 0 : value; };  // round-off
  const char* separator = "";
  for (const RigidMotion& m : motion) {
    if (m.translation.norm() < 1e-6 * size && std::abs(m.rotation) < 1e-6 * size) continue;
    text << separator << "body '" << mesh.bodies[m.body] << "': translation (" << shown(m.translation.x()) << ", "
         << shown(m.translation.y()) << "), rotation " << shown(m.rotation);
    separator = "; ";
  }
  return text.str();
}

}  // namespace mortise
