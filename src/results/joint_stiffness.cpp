#include "results/joint_stiffness.hpp"

#include <set>

#include "base/dense.hpp"
#include "fem/edges.hpp"
#include "problem/boundary_fields.hpp"
#include "solve/contact_factor.hpp"
#include "solve/layered_system.hpp"

namespace mortise {
namespace {

// The nodes that an entry is on, each once.
std::set<int> nodes_of(const Mesh& mesh, const BoundaryEntry& entry) {
  std::set<int> nodes;
  for (const Edge& edge : edges_of(mesh, entry)) nodes.insert(edge.nodes.begin(), edge.nodes.begin() + edge.node_count);
  for (const int point : entry.points) nodes.insert(mesh.points[point].nodes.begin(), mesh.points[point].nodes.end());
  return nodes;
}

// The mean place along its curves, or of its points.
Vec2 centre_of(const Mesh& mesh, const BoundaryEntry& entry) {
  if (const std::vector<Edge> edges = edges_of(mesh, entry); !edges.empty()) return centre_of(mesh.nodes, edges);
  const std::set<int> nodes = nodes_of(mesh, entry);
  return mesh.nodes(std::vector<int>(nodes.begin(), nodes.end()), Eigen::all).colwise().mean().transpose();
}

// The support's three motions in the q (base/constraints.hpp), n x 3: of rings only that along the axis.
MatX motions_in_q(const Problem& p, const BoundaryEntry& entry, const RigidCurve* rigid, const Vec2& about) {
  MatX q = MatX::Zero(p.discretisation.system.K.cols(), 3);
  if (rigid) {
    for (int k = 0; k < 3; ++k) q(rigid->q[k], k) = k == 2 ? rigid->arm : 1;
  } else {
    const auto& held = std::get<Displacement>(entry.spec.what);
    for (const int node : nodes_of(p.mesh, entry)) {
      const Vec2 arm = p.mesh.nodes.row(node).transpose() - about;
      if (held.x) q.row(2 * node) = Eigen::RowVector3d(1, 0, -arm.y());
      if (held.y) q.row(2 * node + 1) = Eigen::RowVector3d(0, 1, arm.x());
    }
  }
  if (p.discretisation.model.axisymmetric())
    for (const int k : {0, 2}) q.col(k).setZero();
  return q;
}

// Which of a rigid curve's motions are free.
std::vector<int> free_motions(const Constraints& constraints, const RigidCurve* rigid, const MatX& q) {
  std::vector<int> free;
  for (int k = 0; rigid && k < 3; ++k)
    if (!constraints.fixed[rigid->q[k]] && !q.col(k).isZero(0)) free.push_back(k);
  return free;
}

// Displacements, n x 3, and changes of the multipliers with them: those of the support's prescribed motions by 1, and
// of forces of the stiffness' size on the free ones. Contact stays as it is, and all other forces do.
DualAnswers responses(const SaddlePointSystem& s, const ContactFactor& factor, const RigidCurve* rigid, MatX q,
                      const std::vector<int>& free) {
  const auto& multipoint = s.constraints.multipoint;
  for (const int k : free) q.col(k).setZero();
  const MatX moved = multipoint ? MatX(multipoint->T * q) : q;
  MatX loads = -(s.K.selfadjointView<Eigen::Lower>() * moved);
  for (const int k : free) loads.col(k) = s.stiffness_scale * multipoint->inverse.row(rigid->q[k]).transpose();
  DualAnswers found = factor.answers(-(s.B * moved), loads);
  found.z += moved;
  return found;
}

std::optional<Eigen::Matrix3d> stiffness_of(const Problem& p, const Solution& solution, const ContactFactor& factor,
                                            const RigidCurve* rigid, const MatX& q) {
  const SaddlePointSystem& s = p.discretisation.system;
  const bool all_held = p.held.motions.empty() && solution.rigid_modes.cols() == 0;
  const std::vector<int> free = free_motions(s.constraints, rigid, q);
  if (!free.empty() && !all_held) return std::nullopt;
  const auto [u, lambda] = responses(s, factor, rigid, q, free);
  Eigen::Matrix3d moved = Eigen::Matrix3d::Identity();  // column j: the support's motions in u_j
  for (const int j : free) moved.col(j).setZero();
  for (const int i : free)
    for (int j = 0; j < 3; ++j) moved(i, j) = rigid_motion(*rigid, *s.constraints.multipoint, u.col(j))(i);
  if (kernel_of(moved).cols() > 0) return std::nullopt;
  const Eigen::Matrix3d to_units = inverse_of(moved),
                        stored = u.transpose() * (s.K.selfadjointView<Eigen::Lower>() * u).eval() -
                                 lambda.transpose() * layer_openings(s.layers, solution.compression, lambda),
                        stiffness = to_units.transpose() * stored * to_units;
  return (stiffness + stiffness.transpose()) / 2;
}

}  // namespace

std::vector<JointStiffness> joint_stiffnesses(const Problem& p, const Solution& solution) {
  std::vector<JointStiffness> found;
  if (solution.status != SolveStatus::converged) return found;
  std::shared_ptr<const ContactFactor> factor;
  for (int i = 0; i < int(p.entries.boundaries.size()); ++i) {
    const BoundaryEntry& entry = p.entries.boundaries[i];
    if (!entry.spec.stiffness) continue;
    const SaddlePointSystem& s = p.discretisation.system;
    if (!factor) factor = s.layers.are_linear() ? contact_factor(s, solution) : exact_factor(s, solution);
    const RigidCurve* rigid = nullptr;
    for (const RigidSupport& support : p.discretisation.multipoint.rigid_curves)
      if (support.entry == i) rigid = &support.curve;
    const Vec2 about = rigid ? rigid->about : centre_of(p.mesh, entry);
    const MatX q = motions_in_q(p, entry, rigid, about);
    found.push_back({i, about, stiffness_of(p, solution, *factor, rigid, q)});
  }
  return found;
}

}  // namespace mortise
