#include "problem/validate.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>
#include <span>

#include "base/dense.hpp"
#include "base/errors.hpp"
#include "base/printable.hpp"
#include "contact/curve_resolution.hpp"
#include "contact/outline.hpp"
#include "contact/smooth_normals.hpp"
#include "fem/multipoint.hpp"
#include "mesh/box_index.hpp"

namespace mortise {
namespace {

// Rows of B over their size: what contact can hold.
SparseMatrix unit_rows(const SaddlePointSystem& system) {
  SparseMatrix rows = system.B;
  for (Eigen::Index k = 0; k < rows.nonZeros(); ++k) rows.valuePtr()[k] /= system.row_scale(rows.innerIndexPtr()[k]);
  return rows;
}

// One unknown a motion, away from the contact curves where there are enough: what is prescribed on these changes them.
std::vector<int> unknowns_to_hold(const Mesh& mesh, const std::vector<ContactPair>& pairs, Constraints constraints,
                                  const std::vector<std::vector<RigidMotion>>& motions) {
  const std::vector<int> anywhere = grounding_unknowns(mesh, constraints, motions);
  for (const ContactPair& pair : pairs)
    for (const Curve* curve : {&pair.multiplier, &pair.opposite})
      for (const int node : curve_nodes(*curve)) constraints.fixed[2 * node] = constraints.fixed[2 * node + 1] = 1;
  const std::vector<int> away = grounding_unknowns(mesh, constraints, motions);
  const auto held = [&](const MotionSet& set) { return kernel_of(motions_at(set, away)).cols() == 0; };
  return std::ranges::all_of(motion_sets(mesh, motions), held) ? away : anywhere;
}

// Of each motion, whether the load drives it: by work of more than a part of its terms, round-off or what the mesh
// leaves unknown of its bodies (mesh_errors), and than what rounding makes of the motion and of edges' `turn`, radians.
std::vector<char> driven(const Mesh& mesh, const std::vector<std::vector<RigidMotion>>& motions, const VecX& load,
                         const VecX& mesh_error, double turn) {
  std::vector<char> driven(motions.size(), 0);
  const double load_size = load.lpNorm<1>();
  for (const MotionSet& set : motion_sets(mesh, motions))
    for (std::size_t k = 0; k < set.motions.size(); ++k) {
      const auto motion = set.fields.col(k);
      VecX work(motion.size());
      for (Eigen::Index i = 0; i < work.size(); ++i) work(i) = motion(i) * load(set.unknown(i));
      double part = 1e-9;
      for (const RigidMotion& of : motions[set.motions[k]]) part = std::max(part, mesh_error(of.body));
      const double least = std::max(1e-12, turn) * load_size * motion.lpNorm<Eigen::Infinity>();
      driven[set.motions[k]] = std::abs(work.sum()) > std::max(part * work.lpNorm<1>(), least);
    }
  return driven;
}

}  // namespace

Floating find_floating(const Mesh& mesh, const Constraints& constraints) {
  Floating floating;
  floating.motions = free_motions(mesh, constraints, SparseMatrix(0, 2 * mesh.nodes.rows()));
  floating.grounded = grounding_unknowns(mesh, constraints, floating.motions);
  return floating;
}

namespace {

// By how much rounded coordinates, both of both ends, turn the shortest edge of the contact: radians.
double rounding_of_edges(const Mesh& mesh, const std::vector<ContactPair>& pairs) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const ContactPair& pair : pairs)
    for (const Curve* curve : {&pair.multiplier, &pair.opposite})
      for (const Edge& edge : curve->edges)
        shortest = std::min(shortest, (mesh.nodes.row(edge.nodes[1]) - mesh.nodes.row(edge.nodes[0])).norm());
  return 4 * std::numeric_limits<double>::epsilon() * mesh.nodes.cwiseAbs().maxCoeff() / shortest;
}

// Of each body: how far its contact edges leave the curves that they stand for, as part of the radius, or the area
// between its outline and these curves, as part of its own: what loads do in a turn, and what weighs, is known no
// better.
VecX mesh_errors(const Mesh& mesh, const std::vector<ContactPair>& pairs) {
  VecX area = VecX::Zero(Eigen::Index(mesh.bodies.size())), unknown = area;
  const Outline o = outline(boundary_edges(mesh), mesh.nodes);
  for (const PieceOutline& piece : o.pieces) area(piece.body) += piece.area;
  for (std::size_t e = 0; e < o.edges.size(); ++e) unknown(o.edges[e].body) += o.sagitta[e] * o.length[e];
  VecX error = unknown.cwiseQuotient(area);
  for (const ContactPair& pair : pairs)
    for (const Curve* curve : {&pair.multiplier, &pair.opposite})
      error(curve->body) = std::max(error(curve->body), edge_error(mesh.nodes, *curve));
  return error;
}

std::vector<char> driven(const Mesh& mesh, const std::vector<ContactPair>& pairs,
                         const std::vector<std::vector<RigidMotion>>& motions, const VecX& load) {
  if (motions.empty()) return {};
  return driven(mesh, motions, load, mesh_errors(mesh, pairs), rounding_of_edges(mesh, pairs));
}

std::vector<ContactNormal> normals_of(const Mesh& mesh, const ContactPair& pair) {
  std::vector<char> faces(pair.multiplier.edges.size(), 0);
  for (const ContactPoint& point : pair.points) faces[point.edge] = 1;
  return smooth_normals(mesh.nodes, pair.multiplier, pair.opposite.body, faces);
}

// Motions that leave the contact curves of their bodies where they are, as the turn of a disc does, and that no load
// drives. No contact resists them, but rows do, as they have the normals of one side: those of a bore resist the turn
// of a shaft about its own centre where the bore's is another, and none resists its turn about that of the bore, which
// shifts it.
std::vector<std::vector<RigidMotion>> idle_motions(const Mesh& mesh, const std::vector<ContactPair>& pairs,
                                                   const SaddlePointSystem& system) {
  std::vector<ContactNormal> normals;
  for (const ContactPair& pair : pairs) {
    std::vector<char> faces(pair.multiplier.edges.size(), 0), opposite(pair.opposite.edges.size(), 0);
    for (const ContactPoint& point : pair.points) faces[point.edge] = opposite[point.opposite_edge] = 1;
    std::ranges::copy(smooth_normals(mesh.nodes, pair.multiplier, -1, faces), std::back_inserter(normals));
    std::ranges::copy(smooth_normals(mesh.nodes, pair.opposite, -1, opposite), std::back_inserter(normals));
  }
  std::vector<std::vector<RigidMotion>> idle;
  const auto motions = free_motions(mesh, system.constraints, normals);
  const std::vector<char> moves = driven(mesh, pairs, motions, system.f);
  for (std::size_t k = 0; k < motions.size(); ++k)
    if (!moves[k]) idle.push_back(motions[k]);
  return idle;
}

// Of each unknown, whether it is no place for a force: held, no q of its own number, or of a contact curve.
std::vector<char> not_to_be_held(const std::vector<ContactPair>& pairs, const Constraints& constraints) {
  std::vector<char> not_to_be = constraints.fixed;
  if (const auto& multipoint = constraints.multipoint)
    std::ranges::transform(not_to_be, multipoint->coupled, not_to_be.begin(), [](char a, char b) { return a || b; });
  for (const ContactPair& pair : pairs)
    for (const Curve* curve : {&pair.multiplier, &pair.opposite})
      for (const int node : curve_nodes(*curve)) not_to_be[2 * node] = not_to_be[2 * node + 1] = 1;
  return not_to_be;
}

// Two displacements of a body along one axis whose difference shows its turn: at the nodes nearest to places half of
// the body's size apart, where forces do least to the contact. Nothing where there are none, or the motion does not
// turn.
std::optional<std::array<int, 2>> unknowns_of_couple(const Mesh& mesh, const BodyPoints& points,
                                                     const std::vector<char>& not_to_be_held,
                                                     const RigidMotion& motion) {
  constexpr double round_off = 1e-6;  // of a motion's size, which is about 1
  const std::span nodes(points.node.begin() + points.first[motion.body],
                        points.node.begin() + points.first[motion.body + 1]);
  Box box;
  for (const int node : nodes) box.extend(mesh.nodes.row(node).transpose());
  const int along = box.sizes().x() >= box.sizes().y() ? 0 : 1, moved = 1 - along;
  std::array<int, 2> nearest{-1, -1};
  for (const int end : {0, 1}) {
    Vec2 place = box.center();
    place(along) += (end - 0.5) / 2 * box.sizes()(along);
    double least = std::numeric_limits<double>::infinity();
    for (const int node : nodes)
      if (const double away = (mesh.nodes.row(node).transpose() - place).norm();
          away < least && !not_to_be_held[2 * node + moved]) {
        least = away;
        nearest[end] = node;
      }
  }
  if (nearest[0] < 0) return {};
  const double lever = mesh.nodes(nearest[1], along) - mesh.nodes(nearest[0], along);
  if (!(std::abs(motion.rotation) * lever > round_off)) return {};
  return std::array{2 * nearest[0] + moved, 2 * nearest[1] + moved};
}

// Holds the turns of single bodies by couples, and returns the other motions. Where rows have the normals of a bore,
// they turn a shaft beside its middle by a moment that it does not feel: a force that took this would be missing at the
// contact.
std::vector<std::vector<RigidMotion>> hold_turns(const Mesh& mesh, const std::vector<ContactPair>& pairs,
                                                 std::vector<std::vector<RigidMotion>> motions,
                                                 Constraints& constraints, Floating& held) {
  if (motions.empty()) return motions;
  const BodyPoints points = body_points(mesh);
  const std::vector<char> taken = not_to_be_held(pairs, constraints);
  std::vector<int> motions_of(mesh.bodies.size(), 0);
  for (const std::vector<RigidMotion>& motion : motions)
    for (const RigidMotion& part : motion) ++motions_of[part.body];
  std::vector<std::array<int, 2>> couples;
  std::erase_if(motions, [&](const std::vector<RigidMotion>& motion) {
    if (motion.size() != 1 || motions_of[motion[0].body] != 1) return false;
    const auto couple = unknowns_of_couple(mesh, points, taken, motion[0]);
    if (!couple) return false;
    couples.push_back(*couple);
    held.motions.push_back(motion);
    held.grounded.push_back((*couple)[0]);
    return true;
  });
  hold_differences(couples, constraints);
  return motions;
}

}  // namespace

void refuse_driven(const Mesh& mesh, const std::vector<ContactPair>& pairs,
                   const std::vector<std::vector<RigidMotion>>& motions, const std::vector<std::string>& findings,
                   const VecX& load) {
  const std::vector<char> moves = driven(mesh, pairs, motions, load);
  for (std::size_t k = 0; k < motions.size(); ++k)
    if (moves[k])
      throw SceneError("nothing holds " + describe(mesh, motions[k]) +
                       "; expected prescribed displacements or contact that prevent it" +
                       (findings.empty() ? "" : ": " + findings.front()));
}

Floating hold_free_motions(const Mesh& mesh, const std::vector<ContactPair>& pairs,
                           const std::vector<std::string>& findings, SaddlePointSystem& system) {
  Floating held;
  const auto hold = [&](const std::vector<std::vector<RigidMotion>>& motions) {
    refuse_driven(mesh, pairs, motions, findings, system.f);
    held.motions.insert(held.motions.end(), motions.begin(), motions.end());
    for (const int unknown : unknowns_to_hold(mesh, pairs, system.constraints, motions)) {
      held.grounded.push_back(unknown);
      system.constraints.fixed[unknown] = 1;
    }
  };
  auto motions = free_motions(mesh, system.constraints, unit_rows(system));
  if (std::ranges::count(driven(mesh, pairs, motions, system.f), 1) > 0) {
    hold(hold_turns(mesh, pairs, idle_motions(mesh, pairs, system), system.constraints, held));
    motions = free_motions(mesh, system.constraints, unit_rows(system));
  }
  hold(motions);
  std::vector<ContactNormal> normals;
  for (const ContactPair& pair : pairs) std::ranges::copy(normals_of(mesh, pair), std::back_inserter(normals));
  hold(free_motions(mesh, system.constraints, normals));
  return held;
}

std::vector<std::string> held_lines(const Mesh& mesh, const std::vector<std::vector<RigidMotion>>& motions) {
  const std::string held = " either: held";
  std::vector<std::string> lines;
  if (motions.size() <= told_in_full) {
    for (const std::vector<RigidMotion>& motion : motions)
      lines.push_back("nothing holds " + describe(mesh, motion) + ", but no load drives it" + held);
    return lines;
  }
  std::set<int> bodies;
  for (const std::vector<RigidMotion>& motion : motions)
    for (const RigidMotion& part : motion) bodies.insert(part.body);
  std::vector<std::string> names;
  for (const int body : bodies) names.push_back("'" + mesh.bodies[body] + "'");
  lines.push_back("nothing holds " + std::to_string(motions.size()) + " motions of " + listed(names) +
                  ", but no load drives them" + held);
  return lines;
}

void require_closed(const Mesh& mesh, const std::vector<ContactPair>& pairs) {
  for (const ContactPair& pair : pairs) {
    if (pair.spec.initial_gap != InitialGap::closed) continue;
    const auto open = open_place(mesh.nodes, pair);
    if (!open) continue;
    throw SceneError(worded(pair.spec.key, ".initial_gap = \"closed\", but '", pair.spec.between[0], "' and '",
                            pair.spec.between[1], "' are ", open->gap, " apart ", near_point(open->position),
                            ", where two meshes of one curve differ by at most ", open->limit,
                            "; expected the default, initial_gap = \"curve\", or curves that are one curve"));
  }
}

}  // namespace mortise
