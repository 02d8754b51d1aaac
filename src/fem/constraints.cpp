#include "fem/constraints.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <map>
#include <sstream>

#include "base/errors.hpp"
#include "mesh/body_points.hpp"
#include "mesh/place.hpp"

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
    Vec2 low = mesh.nodes.row(points.node[std::size_t(points.first[b])]).transpose(), high = low;
    for (int p = points.first[b]; p < points.first[b + 1]; ++p) {
      const Vec2 x = mesh.nodes.row(points.node[std::size_t(p)]).transpose();
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

// The displacements of all nodes, a column a motion.
MatX displacements(const Mesh& mesh, const std::vector<std::vector<RigidMotion>>& motions) {
  const BodyPoints points = body_points(mesh);
  MatX fields = MatX::Zero(2 * mesh.nodes.rows(), Eigen::Index(motions.size()));
  for (std::size_t m = 0; m < motions.size(); ++m)
    for (const RigidMotion& motion : motions[m])
      for (int p = points.first[std::size_t(motion.body)]; p < points.first[std::size_t(motion.body) + 1]; ++p) {
        const int node = points.node[std::size_t(p)];
        const Vec2 arm = mesh.nodes.row(node).transpose() - motion.centre;
        fields.block<2, 1>(2 * node, Eigen::Index(m)) = motion.translation + motion.rotation * Vec2(-arm.y(), arm.x());
      }
  return fields;
}

}  // namespace

Constraints no_constraints(const Mesh& mesh) {
  return {std::vector<char>(std::size_t(2 * mesh.nodes.rows()), 0), VecX::Zero(2 * mesh.nodes.rows())};
}

void prescribe(const Mesh& mesh, int boundary, int component, double value, Constraints& constraints) {
  const Boundary& curve = mesh.boundaries[std::size_t(boundary)];
  for (const Edge& edge : curve.edges)
    for (std::size_t a = 0; a < std::size_t(edge.node_count); ++a) {
      const int dof = 2 * edge.nodes[a] + component;
      if (constraints.fixed[std::size_t(dof)] && constraints.value(dof) != value) {
        std::ostringstream text;
        text << mesh.source << ": boundary '" << curve.name << "': displacement " << (component ? "y" : "x") << " = "
             << value << " " << near_point(mesh.nodes.row(edge.nodes[a]).transpose())
             << ", where another boundary prescribes " << constraints.value(dof) << "; expected one value a node";
        throw InputError(text.str());
      }
      constraints.fixed[std::size_t(dof)] = 1;
      constraints.value(dof) = value;
    }
}

bool prescribed_along(const Constraints& constraints, int node, const Vec2& n) {
  for (int c = 0; c < 2; ++c)
    if (std::abs(n(c)) > 1e-8 && !constraints.fixed[std::size_t(2 * node + c)]) return false;
  return true;
}

std::vector<std::vector<RigidMotion>> free_motions(const Mesh& mesh, const Constraints& constraints,
                                                   const SparseMatrix& rows) {
  const BodyPoints points = body_points(mesh);
  const BodyFrames frames = body_frames(mesh, points);
  const auto bodies = Eigen::Index(mesh.bodies.size());
  // Gram matrix of what the constraints and the contact rows see of the 3 motions of each body.
  MatX gram = MatX::Zero(3 * bodies, 3 * bodies);
  MatX contact = MatX::Zero(rows.rows(), 3 * bodies);
  std::vector<char> counted(std::size_t(mesh.nodes.rows()), 0);
  for (Eigen::Index b = 0; b < bodies; ++b)
    for (int p = points.first[std::size_t(b)]; p < points.first[std::size_t(b) + 1]; ++p) {
      const int node = points.node[std::size_t(p)];
      const Vec2 x = mesh.nodes.row(node).transpose();
      for (int c = 0; c < 2; ++c) {
        Eigen::Vector3d motion;
        for (int k = 0; k < 3; ++k)
          motion(k) = motion_at(k, x, frames.centre[std::size_t(b)], frames.size[std::size_t(b)], c);
        const int dof = 2 * node + c;
        if (constraints.fixed[std::size_t(dof)]) gram.block<3, 3>(3 * b, 3 * b) += motion * motion.transpose();
        if (counted[std::size_t(node)]) continue;  // of a shared node only the first body's contact rows count
        for (SparseMatrix::InnerIterator it(rows, dof); it; ++it)
          contact.block<1, 3>(it.row(), 3 * b) += it.value() * motion.transpose();
      }
      counted[std::size_t(node)] = 1;
    }
  // Bodies that share nodes move together.
  std::vector<int> owner(std::size_t(mesh.nodes.rows()), -1);
  for (Eigen::Index b = 0; b < bodies; ++b)
    for (int p = points.first[std::size_t(b)]; p < points.first[std::size_t(b) + 1]; ++p) {
      const int node = points.node[std::size_t(p)];
      int& other = owner[std::size_t(node)];
      if (other < 0) {
        other = int(b);
        continue;
      }
      const Vec2 x = mesh.nodes.row(node).transpose();
      for (int c = 0; c < 2; ++c) {
        VecX jump = VecX::Zero(3 * bodies);
        for (int k = 0; k < 3; ++k) {
          jump(3 * b + k) += motion_at(k, x, frames.centre[std::size_t(b)], frames.size[std::size_t(b)], c);
          jump(3 * other + k) -= motion_at(k, x, frames.centre[std::size_t(other)], frames.size[std::size_t(other)], c);
        }
        gram += jump * jump.transpose();
      }
    }
  gram += contact.transpose() * contact;

  const Eigen::SelfAdjointEigenSolver<MatX> eigen(gram);
  std::vector<std::vector<RigidMotion>> motions;
  for (Eigen::Index m = 0; m < 3 * bodies; ++m) {
    // Relative to one fixed node; sqrt(1e-14) is a motion resisted by 1e-7 of its size.
    if (eigen.eigenvalues()(m) > 1e-14 * std::max(1.0, eigen.eigenvalues()(3 * bodies - 1))) break;
    std::vector<RigidMotion> motion;
    for (Eigen::Index b = 0; b < bodies; ++b) {
      const Eigen::Vector3d part = eigen.eigenvectors().block<3, 1>(3 * b, m);
      if (part.norm() > 1e-6)
        motion.push_back(
            {int(b), part.head<2>(), part(2) / frames.size[std::size_t(b)], frames.centre[std::size_t(b)]});
    }
    motions.push_back(motion);
  }
  return motions;
}

std::vector<int> grounding_unknowns(const Mesh& mesh, const Constraints& constraints,
                                    const std::vector<std::vector<RigidMotion>>& motions) {
  MatX fields = displacements(mesh, motions);
  for (Eigen::Index i = 0; i < fields.rows(); ++i)
    if (constraints.fixed[std::size_t(i)]) fields.row(i).setZero();
  std::vector<int> unknowns;
  for (Eigen::Index m = 0; m < fields.cols(); ++m) {  // Gaussian elimination with row pivots
    Eigen::Index pivot = 0;
    fields.col(m).cwiseAbs().maxCoeff(&pivot);
    unknowns.push_back(int(pivot));
    for (Eigen::Index other = m + 1; other < fields.cols(); ++other)
      fields.col(other) -= fields(pivot, other) / fields(pivot, m) * fields.col(m);
  }
  return unknowns;
}

std::vector<RigidMotion> motion_through(const Mesh& mesh, const std::vector<std::vector<RigidMotion>>& motions,
                                        const std::vector<int>& unknowns, const VecX& values) {
  const MatX fields = displacements(mesh, motions);
  MatX at(values.size(), fields.cols());
  for (Eigen::Index k = 0; k < values.size(); ++k) at.row(k) = fields.row(unknowns[std::size_t(k)]);
  const VecX parts = at.partialPivLu().solve(values);
  std::map<int, RigidMotion> sum;  // by body
  for (std::size_t m = 0; m < motions.size(); ++m)
    for (const RigidMotion& motion : motions[m]) {
      RigidMotion& total = sum.try_emplace(motion.body, motion.body, Vec2::Zero(), 0.0, motion.centre).first->second;
      total.translation += parts(Eigen::Index(m)) * motion.translation;
      total.rotation += parts(Eigen::Index(m)) * motion.rotation;
    }
  double size = 0;
  for (const auto& [body, motion] : sum) size = std::max(size, motion.translation.norm());
  if (size == 0)
    for (const auto& [body, motion] : sum) size = std::max(size, std::abs(motion.rotation));
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
    text << separator << "body '" << mesh.bodies[std::size_t(m.body)] << "': translation (" << shown(m.translation.x())
         << ", " << shown(m.translation.y()) << "), rotation " << shown(m.rotation);
    separator = "; ";
  }
  return text.str();
}

}  // namespace mortise
