#include "contact/multiplier_rows.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "contact/segments.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

enum class State { free, prescribed, apart, tip, tied_tip, weightless, hardly_facing, unsupported };

std::string reason(State state) {
  switch (state) {
    case State::free:
      break;
    case State::prescribed:
      return "with normal displacement prescribed on both sides: pressure of the nearest free node";
    case State::apart:
      return "with normal displacement prescribed on both sides, which stay apart: pressure zero";
    case State::tip:
      return "of both sides, the tip of a crack: pressure of the nearest free node";
    case State::tied_tip:
      return "where a tie ends, the tip of a crack: pressure of the nearest free node";
    case State::weightless:
    case State::hardly_facing:
      return "whose edges hardly face the other side: pressure of the nearest free node";
    case State::unsupported:  // beyond the end of the other side, which is as it should be
      break;
  }
  return "";
}

std::string between(const Numbering& of) {
  return of.mesh.source + ": contact between '" + of.mesh.boundaries[of.interface.multiplier.boundary].name +
         "' and '" + of.mesh.boundaries[of.interface.opposite.boundary].name + "': ";
}

// The gap that prescribed displacements leave at a node of the multiplier side; nothing unless both sides' normal
// displacements are prescribed there.
std::optional<double> prescribed_gap(const Numbering& of, int e, int local) {
  const auto& [mesh, interface, constraints, initial_gap] = of;
  const Curve &multiplier = interface.multiplier, &opposite = interface.opposite;
  const Edge& edge = multiplier.edges[e];
  const Place at{e, xi_of_node(local)};
  const Line line = interface.geometry.line_from(mesh.nodes, multiplier, at);
  const Vec2& n = line.n;
  if (!prescribed_along(constraints, edge.nodes[local], n)) return {};
  const auto hit = project_onto_curve(mesh.nodes, opposite, line);
  if (!hit) return {};
  const auto value = [&](int node) { return prescribed_displacement(constraints, node).dot(n); };
  double gap = (initial_gap == InitialGap::closed ? 0 : interface.geometry.initial_gap(line, at, *hit)) -
               value(edge.nodes[local]);
  const Edge& other = opposite.edges[hit->edge];
  const EdgeShape s = edge_shape(other.node_count, hit->xi);
  for (int b = 0; b < other.node_count; ++b) {
    if (std::abs(s.N[b]) > 1e-8 && !prescribed_along(constraints, other.nodes[b], n)) return {};
    gap += s.N[b] * value(other.nodes[b]);
  }
  return gap;
}

// Whether a tie ends at this end of the multiplier side and holds it to the end of the other, which has its place.
bool is_tied_to_an_end(const Mesh& mesh, const ContactInterface& interface, int node) {
  if (!is_end(interface.multiplier, node)) return false;
  const auto holds = [&](const TiedNode& one) {
    return std::ranges::any_of(one.weights, [&](const auto& weight) {
      const int other = weight.first;
      return (one.node == node && is_end(interface.opposite, other)) ||
             (other == node && is_end(interface.opposite, one.node));
    });
  };
  return std::ranges::any_of(mesh.ties, [&](const Tie& tie) {
    return tie.turn.isIdentity() && !tie.pretension && std::ranges::any_of(tie.nodes, holds);
  });
}

std::vector<State> find_states(const Numbering& of, const Support& support, const Coupling& coupling) {
  const Mesh& mesh = of.mesh;
  const Curve& multiplier = of.interface.multiplier;
  std::vector<State> state(coupling.node.size(), State::free);
  VecX length = VecX::Zero(state.size());  // of each multiplier's edges
  for (std::size_t e = 0; e < multiplier.edges.size(); ++e)
    for (const int a : coupling.on_edge[e])
      if (a >= 0) length(a) += edge_length(mesh.nodes, multiplier.edges[e]);
  for (std::size_t e = 0; e < multiplier.edges.size(); ++e)
    for (int i = 0; i < 3; ++i) {
      const int a = coupling.on_edge[e][i];
      if (a < 0) continue;
      // Multipliers of less degree than u need no row less where both sides move as one (Seshaiyer & Suri 2000).
      const bool as_rich = multiplier.edges[e].node_count == 2 || coupling.on_edge[e][2] >= 0;
      State& found = state[a];
      if (support.extent(a) < 1e-10 * length(a)) {
        found = State::unsupported;
        continue;
      }
      const auto gap = prescribed_gap(of, int(e), i);
      const double round_off = 1e-9 * length(a);
      if (gap && *gap < -round_off) {
        throw InputError(worded(between(of), "the prescribed displacements of the two sides overlap by ", -*gap, " ",
                                near_point(mesh.nodes.row(coupling.node[a]).transpose()),
                                "; expected values that close the gap or leave it open"));
      }
      if (gap)
        found = *gap > round_off ? State::apart : State::prescribed;
      else if (as_rich && is_end(of.interface.opposite, coupling.node[a]))
        found = State::tip;
      else if (as_rich && is_tied_to_an_end(mesh, of.interface, coupling.node[a]))
        found = State::tied_tip;
      else if (support.weight(a) < 0.05 * std::max(support.scale(a), support.lagrange(a)))
        found = State::weightless;
      else if (support.faced(a) < faced_limit * length(a))
        found = State::hardly_facing;
    }
  return state;
}

}  // namespace

bool closes_in_the_next_sector(const Mesh& mesh, const Curve& curve) {
  const int start = curve.edges.front().nodes[0], end = curve.edges.back().nodes[1];
  const double near =
      0.1 * std::min(edge_length(mesh.nodes, curve.edges.front()), edge_length(mesh.nodes, curve.edges.back()));
  // By places, as near as ties must be (problem/ties.cpp): on meshes that do not match the end of a coarse cut follows
  // several nodes.
  return std::ranges::any_of(mesh.ties, [&](const Tie& tie) {
    return !tie.turn.isIdentity() && std::ranges::any_of(tie.nodes, [&](const TiedNode& one) {
      if (one.node != start && one.node != end) return false;
      const int other = one.node == start ? end : start;
      return (mesh.nodes.row(one.node).transpose() - tie.turn * mesh.nodes.row(other).transpose()).norm() <= near;
    });
  });
}

std::vector<int> multipliers_along(const Coupling& coupling) {
  std::vector<int> order;
  for (const auto& on : coupling.on_edge)
    for (const int a : {on[0], on[2], on[1]})
      if (a >= 0 && (order.empty() || order.back() != a)) order.push_back(a);
  return order;
}

void number_rows(const Numbering& of, const Support& support, Coupling& coupling) {
  std::vector<State> state = find_states(of, support, coupling);
  const auto count = [&](State which) { return std::count(state.begin(), state.end(), which); };
  if (count(State::free) == 0)  // better extrapolated than none
    std::replace(state.begin(), state.end(), State::hardly_facing, State::free);
  if (count(State::free) == 0 && count(State::prescribed) > 0)
    throw InputError(between(of) +
                     "the normal displacements are prescribed on both curves everywhere, so contact has nothing to "
                     "decide; expected at least one curve that is free to move along its normal");
  coupling.row.assign(coupling.node.size(), -1);
  const std::vector<int> order = multipliers_along(coupling);
  const auto free = [&](int i) { return state[order[i]] == State::free; };
  int rows = 0;
  if (free(0) && free(int(order.size()) - 1) && closes_in_the_next_sector(of.mesh, of.interface.multiplier))
    coupling.row[order.front()] = coupling.row[order.back()] = rows++;
  for (const int a : order)
    if (state[a] == State::free && coupling.row[a] < 0) coupling.row[a] = rows++;
  for (int i = 0; i < int(order.size()); ++i) {
    const int a = order[i];
    if (coupling.row[a] >= 0) continue;
    coupling.dropped.push_back({.multiplier = a,
                                .reason = reason(state[a]),
                                .faces = state[a] == State::prescribed || state[a] == State::apart,
                                .by_mesh = state[a] == State::weightless || state[a] == State::hardly_facing});
    if (state[a] == State::unsupported || state[a] == State::apart) continue;
    for (int away = 1; away < int(order.size()) && coupling.row[a] < 0; ++away)
      for (const int k : {i - away, i + away})
        if (k >= 0 && k < int(order.size()) && free(k)) coupling.row[a] = coupling.row[order[k]];
  }
  coupling.gap0 = VecX::Zero(rows);
  coupling.scale = VecX::Zero(rows);
}

}  // namespace mortise
