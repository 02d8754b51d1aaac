#include "problem/ties.hpp"

#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "base/vectors.hpp"
#include "contact/mortar_projection.hpp"
#include "fem/edges.hpp"
#include "problem/contact_curves.hpp"
#include "scene/scene.hpp"

namespace mortise {
namespace {

// The curve that follows: the one that the scene names, else that with the shorter edges.
int following(const ContactCurves& pair) {
  if (!pair.spec.multipliers_on.empty()) return pair.spec.multipliers_on == pair.spec.between[1] ? 1 : 0;
  return pair.edge_size[1] < (1 - 1e-6) * pair.edge_size[0] ? 1 : 0;
}

// Out of the body; of rings along the axis.
Vec2 cut_normal(const Model& model, const Mesh& mesh, const ContactSpec& spec, const Curve& curve) {
  constexpr double straight = 1e-3;  // sine
  const Vec2 along =
      (mesh.nodes.row(curve.edges.back().nodes[1]) - mesh.nodes.row(curve.edges[0].nodes[0])).transpose();
  Vec2 normal = Vec2(along.y(), -along.x()).normalized();
  if (model.axisymmetric()) normal = {0, normal.y() > 0 ? 1 : -1};
  for (const Edge& edge : curve.edges)
    for (int a = 0; a < edge.node_count; ++a) {
      const EdgePoint at = edge_point(mesh.nodes, edge, xi_of_node(a));
      if ((at.normal() - normal).norm() > straight)
        throw SceneError(spec.key + (spec.overlap ? ".overlap: '" : ".pretension: '") +
                         mesh.boundaries[curve.boundary].name + "' is not straight" +
                         (model.axisymmetric() ? " across the axis " : " ") + near_point(at.position) +
                         "; expected a straight cut" + (model.axisymmetric() ? ", whose nodes have one y" : ""));
    }
  return normal;
}

// From curve `from` to curve `to` of the next sector, about the origin, by their ends that are farthest from it.
Eigen::Matrix2d turn_between(const Mesh& mesh, const ContactSpec& spec, const Curve& from, const Curve& to) {
  constexpr double whole = 1e-3;  // of a number of sectors
  const auto farthest = [&](const Curve& curve) {
    const Vec2 start = mesh.nodes.row(curve.edges.front().nodes[0]), end = mesh.nodes.row(curve.edges.back().nodes[1]);
    return start.norm() > end.norm() ? start : end;
  };
  const Vec2 a = farthest(from), b = farthest(to);
  const double angle = std::atan2(cross(a, b), a.dot(b)), count = 2 * std::numbers::pi / std::abs(angle);
  if (!(std::abs(count - std::round(count)) < whole * count)) {
    throw SceneError(worded(spec.key, ".condition = \"cyclic\": from '", spec.between[0], "' to '", spec.between[1],
                            "' there are ", 180 / std::numbers::pi * std::abs(angle),
                            " degrees about the origin; expected a whole part of 360"));
  }
  const double turn = std::copysign(2 * std::numbers::pi / std::round(count), angle);
  return Eigen::Matrix2d{{std::cos(turn), -std::sin(turn)}, {std::sin(turn), std::cos(turn)}};
}

Points turned(Points nodes, const Curve& curve, const Eigen::Matrix2d& turn) {
  for (const int node : curve_nodes(curve)) nodes.row(node) = (turn * nodes.row(node).transpose()).eval().transpose();
  return nodes;
}

// A node that follows another curve already is left out.
Tie tie_of(const Model& model, const Mesh& mesh, const ContactCurves& pair, std::set<int>& followers) {
  const int first = following(pair);
  Tie tie{.key = pair.spec.key, .entry = pair.spec.entry, .curves = {}, .boundary = {}, .body = {}, .nodes = {}};
  const Curve &follows = pair.curves[first], &leads = pair.curves[1 - first];
  if (pair.spec.condition == Condition::cyclic) {
    tie.turn = turn_between(mesh, pair.spec, leads, follows);
    tie.nodes = mortar_projection(turned(mesh.nodes, leads, tie.turn), follows, leads, model);
  } else {
    tie.nodes = mortar_projection(mesh.nodes, follows, leads, model);
  }
  for (const int k : {0, 1}) {
    const int of = k == 0 ? first : 1 - first;
    tie.curves[k] = pair.spec.between[of];
    tie.boundary[k] = pair.curves[of].boundary;
    tie.body[k] = pair.curves[of].body;
  }
  if (tie.nodes.empty())
    throw SceneError(tie.key + ": '" + tie.curves[0] + "' and '" + tie.curves[1] +
                     "' do not face each other anywhere; expected curves that coincide");
  if (pair.spec.pretension || pair.spec.overlap)
    tie.pretension = {.normal = cut_normal(model, mesh, pair.spec, pair.curves[first]),
                      .force = pair.spec.pretension,
                      .overlap = pair.spec.overlap};
  std::erase_if(tie.nodes, [&](const TiedNode& one) { return !followers.insert(one.node).second; });
  return tie;
}

Vec2 place_of(const Points& nodes, const Tie& tie, const TiedNode& one) {
  Vec2 place = Vec2::Zero();
  for (const auto& [node, weight] : one.weights) place += weight * nodes.row(node).transpose();
  return tie.turn * place;
}

void require_near(const Mesh& mesh, const Tie& tie, double edge) {
  for (const TiedNode& one : tie.nodes) {
    const Vec2 drawn = mesh.nodes.row(one.node).transpose();
    const double apart = (place_of(mesh.nodes, tie, one) - drawn).norm();
    if (apart <= 0.1 * edge) continue;
    throw SceneError(worded(tie.key, ": '", tie.curves[0], "' and '", tie.curves[1], "' are ", apart, " apart ",
                            near_point(drawn), "; expected tied curves that coincide, to a tenth of an edge"));
  }
}

}  // namespace

Mesh tied(const Scene& scene, Mesh mesh) {
  const std::vector<Tie> before = std::exchange(mesh.ties, {});
  if (scene.ties.empty()) return mesh;
  std::set<int> followers;
  for (const ContactCurves& pair : tied_curves(scene, mesh)) {
    mesh.ties.push_back(tie_of(scene.model, mesh, pair, followers));
    require_near(mesh, mesh.ties.back(), std::min(pair.edge_size[0], pair.edge_size[1]));
    if (const std::size_t k = mesh.ties.size() - 1; pair.spec.locked && k < before.size() && before[k].pretension)
      mesh.ties[k].pretension->overlap = before[k].pretension->overlap;
  }
  // Those that follow others that follow come after them, whatever the order of the entries.
  for (std::size_t round = 0; round < mesh.ties.size(); ++round)
    for (const Tie& tie : mesh.ties)
      for (const TiedNode& one : tie.nodes) {
        Vec2 to = place_of(mesh.nodes, tie, one);
        if (scene.model.axisymmetric() && mesh.nodes(one.node, 0) <= 0) to.x() = 0;  // stays on the axis
        mesh.nodes.row(one.node) = to.transpose();
      }
  return mesh;
}

std::map<int, TieOverlap> add_ties(const Mesh& mesh, MultipointBuilder& builder) {
  std::map<int, TieOverlap> overlaps;
  for (std::size_t k = 0; k < mesh.ties.size(); ++k)
    if (const auto overlap = builder.tie(mesh.ties[k])) overlaps.emplace(int(k), *overlap);
  return overlaps;
}

void take_pretensions(const Scene& scene, Mesh& mesh) {
  for (Tie& tie : mesh.ties)
    for (const ContactSpec& spec : scene.ties)
      if (tie.pretension && tie.key == spec.key && !spec.locked) {
        tie.pretension->force = spec.pretension;
        tie.pretension->overlap = spec.overlap;
      }
}

}  // namespace mortise
