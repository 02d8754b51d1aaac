#include "results/reactions.hpp"

#include <Eigen/LU>
#include <map>
#include <utility>

#include "base/overloaded.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

// What supports put on the nodes, and what ties do.
struct NodalForces {
  VecX supports, ties;
};

NodalForces nodal_forces(const SaddlePointSystem& s, const Solution& solution) {
  const VecX residual = -unbalanced_forces(s, solution);
  const auto& multipoint = s.constraints.multipoint;
  if (!multipoint)
    return {constraint_forces(s.constraints, s.constraints.fixed, residual), VecX::Zero(residual.size())};
  std::vector<char> held = s.constraints.fixed;
  for (std::size_t q = 0; q < held.size(); ++q) held[q] = held[q] && !multipoint->tied[q];
  return {constraint_forces(s.constraints, held, residual),
          constraint_forces(s.constraints, multipoint->tied, residual)};
}

// Adds up the reactions, each once: what has been added is 0 in `left`.
class Collector {
 public:
  Collector(const Mesh& mesh, const VecX& nodal, const std::map<int, HeldTwice>& held_twice)
      : mesh_(mesh), left_(nodal) {
    for (const auto& [node, held] : held_twice) {
      Eigen::Matrix2d directions;
      directions << held.direction[0], held.direction[1];
      const Vec2 parts = directions.inverse() * left_.segment<2>(2 * node);
      for (int k = 0; k < 2; ++k) {
        if (held.support[k] < 0) continue;
        apart_[{held.support[k], node}] = parts(k) * held.direction[k];
        left_.segment<2>(2 * node) -= parts(k) * held.direction[k];
      }
    }
  }

  // Of a support along directions that are neither x nor y.
  Resultant take_skew(int support, const std::vector<int>& nodes) {
    Resultant sum;
    for (const int node : nodes) {
      if (const auto part = apart_.find({support, node}); part != apart_.end()) {
        sum.add(mesh_.nodes.row(node).transpose(), part->second);
        part->second.setZero();
      } else {
        take_node(node, true, true, sum);
      }
    }
    return sum;
  }

  Resultant take(const std::vector<int>& nodes, bool x, bool y) {
    Resultant sum;
    for (const int node : nodes) take_node(node, x, y, sum);
    return sum;
  }

  /// What has not been added, n.
  const VecX& rest() const { return left_; }

 private:
  void take_node(int node, bool x, bool y, Resultant& sum) {
    Vec2 force = Vec2::Zero();
    if (x) std::swap(force.x(), left_(2 * node));
    if (y) std::swap(force.y(), left_(2 * node + 1));
    sum.add(mesh_.nodes.row(node).transpose(), force);
  }

  const Mesh& mesh_;
  VecX left_;
  std::map<std::pair<int, int>, Vec2> apart_;  // of a support and a node that is held twice
};

std::vector<int> nodes_of(const Boundary& curve) {
  std::vector<int> nodes;
  for (const Edge& edge : curve.edges)
    nodes.insert(nodes.end(), edge.nodes.begin(), edge.nodes.begin() + edge.node_count);
  return nodes;
}

// Of the nodes of a curve or point that a support is on.
Resultant reaction_at(const std::vector<int>& nodes, const BoundaryCondition& what, int number, Collector& collector,
                      Collector& springs) {
  const auto of_springs = [&] { return springs.take(nodes, true, true); };
  const auto skew = [&] { return collector.take_skew(number, nodes); };
  return std::visit(
      Overloaded{[&](const Displacement& u) { return collector.take(nodes, u.x.has_value(), u.y.has_value()); },
                 [&](const NormalDisplacement&) { return skew(); }, [&](const DirectedDisplacement&) { return skew(); },
                 [&](const RigidSpec&) { return collector.take(nodes, true, true); },
                 [](const Pressure&) { return Resultant(); }, [](const SurfaceTraction&) { return Resultant(); },
                 [](const TotalForce&) { return Resultant(); }, [&](const NormalFoundation&) { return of_springs(); },
                 [&](const AxesFoundation&) { return of_springs(); }, [&](const PointSpring&) { return of_springs(); }},
      what);
}

// Of an entry's curves, or of its points, added to those that are known of it.
void add_reactions(const Mesh& mesh, const BoundaryEntry& entry, int number, bool of_points, Collector& collector,
                   Collector& springs, std::vector<Reaction>& reactions) {
  const auto add = [&](const std::string& name, const std::vector<int>& nodes, const Vec2& centre) {
    reactions.push_back({number, name, centre, reaction_at(nodes, entry.spec.what, number, collector, springs)});
  };
  if (of_points) {
    for (const int p : entry.points) {
      const NamedPoint& point = mesh.points[p];
      add(point.name, point.nodes, mesh.nodes(point.nodes, Eigen::all).colwise().mean().transpose());
    }
    return;
  }
  for (const NamedBoundary& on : entry.curves) {
    const Boundary& curve = mesh.boundaries[on.boundary];
    add(curve.name, nodes_of(curve), centre_of(mesh.nodes, curve.edges));
  }
}

// By entry: what curves hold is theirs, so that a point on them has the rest.
std::vector<std::vector<Reaction>> reactions_of_entries(const Problem& problem, Collector& collector,
                                                        Collector& springs) {
  const std::vector<BoundaryEntry>& entries = problem.entries.boundaries;
  std::vector<std::vector<Reaction>> reactions(entries.size());
  for (const bool of_points : {false, true})
    for (std::size_t i = 0; i < entries.size(); ++i)
      if (!is_load(entries[i].spec.what))
        add_reactions(problem.mesh, entries[i], int(i), of_points, collector, springs, reactions[i]);
  return reactions;
}

Resultant sum_of_loads(const Mesh& mesh, const Discretisation& d) {
  Resultant sum;
  const VecX loads = d.system.f - d.initial_load;
  for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i) sum.add(mesh.nodes.row(i).transpose(), loads.segment<2>(2 * i));
  return sum;
}

}  // namespace

Reactions find_reactions(const Problem& problem, const Solution& solution) {
  const Mesh& mesh = problem.mesh;
  const Discretisation& d = problem.discretisation;
  Reactions r;
  const NodalForces forces = nodal_forces(d.system, solution);
  r.nodal = forces.supports;
  const VecX of_springs = spring_forces(d, solution.u);
  Collector collector(mesh, r.nodal, d.multipoint.held_twice), springs(mesh, of_springs, {});
  r.nodal += of_springs + forces.ties;
  VecX tying = forces.ties;
  if (d.multipoint.pretension.size() > 0) tying += d.multipoint.pretension;
  for (const auto& [k, overlap] : d.multipoint.overlaps)
    r.overlaps[k] = overlap_of(overlap, *d.system.constraints.multipoint, solution.u);
  for (const Tie& tie : mesh.ties) {
    Resultant& sum = r.ties.emplace_back();
    for (const TiedNode& one : tie.nodes) sum.add(mesh.nodes.row(one.node).transpose(), tying.segment<2>(2 * one.node));
  }
  for (std::vector<Reaction>& of_entry : reactions_of_entries(problem, collector, springs)) {
    Resultant& all = r.entries.emplace_back();
    for (Reaction& part : of_entry) {
      all += part.sum;
      r.curves.push_back(std::move(part));
    }
    r.all += all;
  }
  for (const RigidSupport& rigid : d.multipoint.rigid_curves)
    r.rigid_motions.push_back(rigid_motion(rigid.curve, *d.system.constraints.multipoint, solution.u));
  r.stiffnesses = joint_stiffnesses(problem, solution);
  r.held_bodies.resize(mesh.bodies.size());
  std::vector<char> counted(mesh.nodes.rows(), 0);
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    for (int p = problem.points.first[b]; p < problem.points.first[b + 1]; ++p)
      if (const int node = problem.points.node[p]; !std::exchange(counted[node], 1)) {
        const Vec2 x = mesh.nodes.row(node);
        Vec2 force = collector.rest().segment<2>(2 * node);
        if (d.model.axisymmetric() && x.x() <= 0) force.x() = 0;  // what the axis holds is no motion
        r.held_bodies[b].add(x, force);
      }
    r.held += r.held_bodies[b];
  }
  r.all += r.held;
  r.loads = sum_of_loads(mesh, d);
  return r;
}

}  // namespace mortise
