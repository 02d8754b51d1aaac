#include "results/point_supports.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "contact/coupling.hpp"

namespace mortise {
namespace {

constexpr double shorter = 10;  // elements, by about as much as meshes of one accuracy differ at a point

// A body about a node.
struct Wedge {
  int body;
  double angle = 0;            // of its cells, as of a vertex; 0: the middle of a side
  Vec2 toward = Vec2::Zero();  // along the bisector
};

std::map<int, Wedge> wedges_at(const Mesh& mesh, const std::set<int>& nodes) {
  std::map<int, Wedge> wedges;
  for (const Cell& cell : mesh.cells)
    for (int a = 0; a < node_count(cell.kind); ++a) {
      if (!nodes.contains(cell.nodes[a])) continue;
      Wedge& wedge = wedges.try_emplace(cell.nodes[a], Wedge{cell.body}).first->second;
      const int corners = corner_count(cell.kind);
      if (a >= corners || wedge.body != cell.body) continue;
      const auto to = [&](int b) -> Vec2 {
        return (mesh.nodes.row(cell.nodes[b % corners]) - mesh.nodes.row(cell.nodes[a])).transpose().normalized();
      };
      const Vec2 one = to(a + 1), other = to(a + corners - 1);
      wedge.angle += angle_between(one, other);
      wedge.toward += (one + other).normalized() * (one - other).norm();  // the integral of directions
    }
  return wedges;
}

// By how much more a force of 1 per depth at the tip sinks in where elements are shorter, times E: a wedge's radial
// stresses (Timoshenko & Goodier 1970, section 38), which are a half plane's and a whole plane's too.
Eigen::Matrix2d sinking_of(const Wedge& wedge) {
  const double angle = wedge.angle > 0 ? wedge.angle : std::numbers::pi;
  const double along = 2 * std::log(shorter) / (angle + std::sin(angle)),
               across = 2 * std::log(shorter) / (angle - std::sin(angle));
  const Vec2 b = wedge.toward.norm() > 1e-6 ? wedge.toward.normalized() : Vec2::UnitX();
  return across * Eigen::Matrix2d::Identity() + (along - across) * b * b.transpose();
}

std::set<int> nodes_of(const Mesh& mesh, const BoundaryEntry& entry) {
  std::set<int> nodes;
  for (const int point : entry.points) nodes.insert(mesh.points[point].nodes.begin(), mesh.points[point].nodes.end());
  return nodes;
}

// What entry i holds its points with, n; of a point that is several bodies', all that is held there.
VecX forces_at_points(const Reactions& reactions, const Mesh& mesh, const BoundaryEntry& entry, int i) {
  VecX forces = VecX::Zero(reactions.nodal.size());
  auto reaction = std::ranges::find(reactions.curves, i, &Reaction::entry);
  reaction += std::ptrdiff_t(entry.curves.size());
  for (const int point : entry.points) {
    const std::vector<int>& nodes = mesh.points[point].nodes;
    for (const int node : nodes)
      forces.segment<2>(2 * node) =
          nodes.size() == 1 ? reaction->sum.force : Vec2(reactions.nodal.segment<2>(2 * node));
    ++reaction;
  }
  return forces;
}

// What an entry's points sink by, n.
VecX sinking(const Problem& p, const VecX& forces, const BoundaryEntry& entry) {
  VecX by = VecX::Zero(forces.size());
  for (const auto& [node, wedge] : wedges_at(p.mesh, nodes_of(p.mesh, entry))) {
    const ElasticLaw& law = p.discretisation.laws[wedge.body];
    const double depth = law.model.depth(p.mesh.nodes(node, 0));
    if (depth > 0) by.segment<2>(2 * node) = -sinking_of(wedge) * forces.segment<2>(2 * node) / (law.young * depth);
  }
  return by;
}

// Over all pairs, of a change of the multipliers.
double part_of_pressure(const Results& r, const VecX& change) {
  double off = 0, whole = 0;
  for (std::size_t k = 0; k < r.problem.pairs.size(); ++k) {
    const ContactPair& pair = r.problem.pairs[k];
    const VecX values = multiplier_values(pair.coupling, change.segment(pair.first_row, pair.coupling.B.rows()));
    for (const ContactPoint& point : pair.points) {
      off += std::abs(interpolate(pair, values, {point.edge, point.xi})) * point.dA;
      whole += std::abs(interpolate(pair, r.recovery.contacts[k].pressure, {point.edge, point.xi})) * point.dA;
    }
  }
  return whole > 0 ? off / whole : 0;
}

}  // namespace

std::vector<double> changes_by_point_supports(const Results& r) {
  const Problem& p = r.problem;
  const SaddlePointSystem& system = p.discretisation.system;
  std::vector<double> parts(p.entries.boundaries.size(), 0);
  if (!r.solution.factor || p.pairs.empty()) return parts;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const BoundaryEntry& entry = p.entries.boundaries[i];
    if (entry.points.empty() || is_load(entry.spec.what)) continue;
    const VecX by = sinking(p, forces_at_points(r.recovery.reactions, p.mesh, entry, int(i)), entry);
    if (!by.any()) continue;
    VecX load, gap = VecX::Zero(system.B.rows());
    if (const auto* spring = std::get_if<PointSpring>(&entry.spec.what)) {
      load = VecX::Zero(by.size());
      for (const int node : nodes_of(p.mesh, entry))
        load.segment<2>(2 * node) = spring->stiffness.cwiseProduct(by.segment<2>(2 * node));
    } else {
      load = -(system.K.selfadjointView<Eigen::Lower>() * by);
      gap = -(system.B * by);
    }
    parts[i] = part_of_pressure(r, r.solution.factor->multipliers(gap, load));
  }
  return parts;
}

}  // namespace mortise
