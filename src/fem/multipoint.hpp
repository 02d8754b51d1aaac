// Displacements prescribed along any direction, and curves that stay rigid.
#pragma once

#include <map>
#include <set>

#include "base/constraints.hpp"
#include "mesh/mesh.hpp"

namespace mortise {

/// Nodes that move as a rigid body: u = q_x e1 + q_y e2 + q_turn / arm * (-(x2 - about2), x1 - about1).
struct RigidCurve {
  std::vector<int> nodes;
  Vec2 about;
  std::array<int, 3> q;  ///< displacement of `about`, and the turn; three of the Constraints' unknowns
  double arm;            ///< length: the turn in radians is q[2] / arm
};

/// How far the faces of a tie are drawn into each other, a length: q / part, q one of the Constraints' unknowns.
struct TieOverlap {
  int q;
  double part;
};

/// Displacement of a point, and the turn about it; none: free.
using PrescribedMotion = std::array<std::optional<double>, 3>;

/// A node that supports hold along two directions, of which one is neither x nor y at least: a reaction there is a sum
/// of forces along both.
struct HeldTwice {
  std::array<int, 2> support;  ///< as the caller counts them; -1: one along x or y
  std::array<Vec2, 2> direction;
};

/// Adds a force at `about` and a moment to the nodes of a rigid curve: of all forces with this sum the curve feels the
/// same.
void add_rigid_load(const Mesh& mesh, const RigidCurve& curve, const Vec2& force, double moment, VecX& f);

/// Displacement of `about` and the turn in radians, of the nodes' displacements.
Eigen::Vector3d rigid_motion(const RigidCurve& curve, const MultipointConstraints& multipoint, const VecX& u);

/// The overlap, a length, of the nodes' displacements.
double overlap_of(const TieOverlap& tie, const MultipointConstraints& multipoint, const VecX& u);

/// Holds the difference of the two unknowns of each pair, u_0 - u_1 = 0, by forces that are equal and opposite: a
/// couple, if both are displacements along one axis. All are free, q of their own number, and in one pair.
void hold_differences(const std::vector<std::array<int, 2>>& pairs, Constraints& constraints);

/// Collects, after all displacements along x and y, what the others prescribe.
class MultipointBuilder {
 public:
  MultipointBuilder(const Mesh& mesh, Constraints& constraints);

  /// Prescribes u . direction = value at a node; `direction` is a unit vector, `support` the caller's number. Throws
  /// SceneError that begins with `key` where the node already has another value.
  void prescribe(int support, const std::string& key, int node, const Vec2& direction, double value);

  /// Two nodes or more, and what is prescribed of the displacement of `about` and of the turn, radians. Throws
  /// SceneError that begins with `key` where a node is held in another way than by that motion too (of rings but on the
  /// axis).
  RigidCurve make_rigid(const std::string& key, std::vector<int> nodes, const Vec2& about,
                        const PrescribedMotion& motion);

  /// Ties nodes to others in the components that nothing else prescribes; after all else. Where one is prescribed, its
  /// multiplier is added to that beside it, so that they still add up to 1 (the end edges of a mortar: Wohlmuth 2000).
  /// With pretension u_follow = sum_c w_c u_c + overlap * normal, and the overlap is returned. Throws SceneError that
  /// begins with the tie's key where the curve is rigid, or held along the normal.
  std::optional<TieOverlap> tie(const Tie& tie);

  /// Puts the multi-point constraints, if there are any, into the Constraints. Returns the nodes that are held twice.
  std::map<int, HeldTwice> finish();

 private:
  // The q of a node's own number.
  struct Axis {
    int q;
    Vec2 direction;
    bool held;
  };
  std::array<Axis, 2> axes(int node) const;
  // Adds weight * u by the q.
  void add_row(int u, double weight, int depth, std::map<int, double>& row) const;
  Vec2 place(int node) const { return mesh_.nodes.row(node).transpose(); }
  void require_same_motion(const std::string& key, int node, const Vec2& lever, const PrescribedMotion& motion) const;
  // `drawn`: of each tied q what it is as the faces overlap by 1.
  TieOverlap draw(const Tie& tie, const std::map<int, double>& drawn);
  void take_overlaps(MultipointConstraints& multipoint);
  [[noreturn]] void refuse(const std::string& key, int node, const std::string& why) const;

  const Mesh& mesh_;
  Constraints& constraints_;
  struct Skew {
    int support;
    Vec2 direction;
  };
  std::map<int, Skew> skew_;  // of nodes that are held in one direction, neither x nor y
  std::map<int, HeldTwice> held_twice_;
  std::set<int> rigid_;  // nodes
  using Weights = std::vector<std::pair<int, double>>;
  std::map<int, Weights> rows_;  // of T without the ties, by u: those that are not q of their own number
  std::map<int, Weights> ties_;  // of q, by u
  Triplets drawn_;               // of q, by the q of an overlap that is an unknown
  Triplets inverse_;
};

}  // namespace mortise
