#include "fem/multipoint.hpp"

#include <algorithm>
#include <cmath>

#include "base/each_once.hpp"
#include "base/errors.hpp"
#include "base/printable.hpp"
#include "base/vectors.hpp"

namespace mortise {
namespace {

constexpr double parallel = 1e-6;  // sine between directions that are one

// Displacement of a place when it turns about another by 1.
Vec2 turned(const Vec2& place, const Vec2& about) { return {about.y() - place.y(), place.x() - about.x()}; }

bool agree(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b)); }

std::string other_value(const Vec2& direction, double value, double other) {
  return worded("prescribes a displacement of ", value, " along (", direction.x(), ", ", direction.y(),
                "), where another entry makes it ", other, "; expected one value a node,");
}

// The node that is farthest from the first one along x or y, and the displacement at right angles, which shows the
// turn.
std::pair<int, int> turning_unknown(const Points& at, const std::vector<int>& nodes) {
  const int first = nodes.front();
  int last = first, along = 0;
  for (const int node : nodes)
    for (int c = 0; c < 2; ++c)
      if (std::abs(at(node, c) - at(first, c)) > std::abs(at(last, along) - at(first, along))) {
        last = node;
        along = c;
      }
  return {last, 1 - along};
}

}  // namespace

void add_rigid_load(const Mesh& mesh, const RigidCurve& curve, const Vec2& force, double moment, VecX& f) {
  // On the first node, and on the unknown that tells the turn with its opposite on the first node.
  const int first = curve.q[0], turn = curve.q[2];
  const Vec2 lever = turned(mesh.nodes.row(first / 2).transpose(), curve.about);
  const double couple = (moment - lever.dot(force)) / curve.arm;
  f.segment<2>(first) += force;
  f(first + turn % 2) -= couple;
  f(turn) += couple;
}

Eigen::Vector3d rigid_motion(const RigidCurve& curve, const MultipointConstraints& multipoint, const VecX& u) {
  Eigen::Vector3d motion;
  for (int k = 0; k < 3; ++k) motion(k) = multipoint.inverse.row(curve.q[k]).dot(u);
  motion(2) /= curve.arm;
  return motion;
}

double overlap_of(const TieOverlap& tie, const MultipointConstraints& multipoint, const VecX& u) {
  return multipoint.inverse.row(tie.q).dot(u) / tie.part;
}

void hold_differences(const std::vector<std::array<int, 2>>& pairs, Constraints& constraints) {
  if (pairs.empty()) return;
  const Eigen::Index n = constraints.value.size();
  SparseRows same(n, n);
  same.setIdentity();
  if (!constraints.multipoint) constraints.multipoint = {same, same, std::vector<char>(n, 0), std::vector<char>(n, 0)};
  MultipointConstraints& multipoint = *constraints.multipoint;
  Triplets differences;
  for (const auto& [one, other] : pairs) {
    differences.emplace_back(one, other, 1);
    multipoint.coupled[one] = constraints.fixed[one] = 1;
  }
  const SparseRows added =
      filled<SparseRows>(n, n, differences);  // the q before are (1 + this) times those from now on
  const SparseRows of_T = multipoint.T * added, of_inverse = added * multipoint.inverse;
  multipoint.T += of_T;
  multipoint.inverse -= of_inverse;
}

MultipointBuilder::MultipointBuilder(const Mesh& mesh, Constraints& constraints)
    : mesh_(mesh), constraints_(constraints) {}

void MultipointBuilder::refuse(const std::string& key, int node, const std::string& why) const {
  throw SceneError(key + ": " + why + " " + near_point(place(node)));
}

void MultipointBuilder::prescribe(int support, const std::string& key, int node, const Vec2& direction, double value) {
  const int x = 2 * node;
  if (rigid_.contains(node)) refuse(key, node, "holds a node of a rigid curve; expected no other support there");
  std::vector<std::pair<Vec2, double>> given{{direction, value}};
  const auto skew = skew_.find(node);
  const bool is_skew = skew != skew_.end();
  if (is_skew)
    given.emplace_back(skew->second.direction, constraints_.value(x));
  else
    for (int c = 0; c < 2; ++c)
      if (constraints_.fixed[x + c]) given.emplace_back(Vec2::Unit(c), constraints_.value(x + c));

  const auto conflict = [&](double other) { refuse(key, node, other_value(direction, value, other)); };
  if (given.size() == 3) {  // already held in both directions
    const double there = direction.dot(constraints_.value.segment<2>(x));
    const double size = constraints_.value.segment<2>(x).norm();
    if (std::abs(there - value) > 1e-9 * std::max(size, std::abs(value))) conflict(there);
    return;
  }
  if (given.size() == 1) {
    if (std::abs(direction.x()) < parallel || std::abs(direction.y()) < parallel) {
      const int c = std::abs(direction.y()) > std::abs(direction.x()) ? 1 : 0;
      constraints_.fixed[x + c] = 1;
      constraints_.value(x + c) = value * direction(c);
      return;
    }
    skew_[node] = {support, direction};
    constraints_.fixed[x] = 1;
    constraints_.value(x) = value;
    return;
  }
  const double sine = cross(given[0].first, given[1].first);
  if (std::abs(sine) < parallel) {
    const double sign = given[0].first.dot(given[1].first) > 0 ? 1 : -1;
    if (!agree(given[1].second, sign * value)) conflict(sign * given[1].second);
    return;
  }
  // Two directions hold the node altogether: n1 . u = v1, n2 . u = v2.
  const Vec2 n1 = given[0].first, n2 = given[1].first;
  const double v1 = given[0].second, v2 = given[1].second;
  held_twice_[node] = {{support, is_skew ? skew->second.support : -1}, {n1, n2}};
  if (is_skew) skew_.erase(skew);
  constraints_.fixed[x] = constraints_.fixed[x + 1] = 1;
  constraints_.value.segment<2>(x) = Vec2(v1 * n2.y() - v2 * n1.y(), v2 * n1.x() - v1 * n2.x()) / sine;
}

// What holds the node already must be what the rigid motion makes of it. `lever`: its displacement by a turn of 1.
void MultipointBuilder::require_same_motion(const std::string& key, int node, const Vec2& lever,
                                            const PrescribedMotion& motion) const {
  if (rigid_.contains(node) || skew_.contains(node))
    refuse(key, node,
           "makes a node rigid that is held along another direction or rigid already; expected no such support");
  for (int k = 0; k < 2; ++k) {
    const int unknown = 2 * node + k;
    if (!constraints_.fixed[unknown] || (constraints_.rings && k == 0)) continue;
    const double there = constraints_.value(unknown), turn = motion[2].value_or(0);
    const bool known = motion[k] && (motion[2] || std::abs(lever(k)) <= 1e-9 * lever.norm());
    const double made = motion[k].value_or(0) + lever(k) * turn,
                 size = std::max({std::abs(there), std::abs(made), std::abs(lever(k) * turn)});
    if (known && std::abs(made - there) <= 1e-9 * size) continue;
    refuse(key, node,
           worded("makes a node rigid whose displacement ", (k == 0 ? "x" : "y"), " another entry prescribes as ",
                  there, "; expected rigid = { ", (k == 0 ? "x" : "y"),
                  ", rotation } that prescribe the same there, or no such support"));
  }
}

RigidCurve MultipointBuilder::make_rigid(const std::string& key, std::vector<int> nodes, const Vec2& about,
                                         const PrescribedMotion& motion) {
  keep_each_once(nodes);
  const auto lever_of = [&](int node) { return turned(place(node), about); };
  for (const int node : nodes) {
    require_same_motion(key, node, lever_of(node), motion);
    rigid_.insert(node);
    for (const int unknown : {2 * node, 2 * node + 1}) {
      constraints_.fixed[unknown] = 0;
      constraints_.value(unknown) = 0;
    }
  }
  const int first = nodes.front();
  const auto [last, c] = turning_unknown(mesh_.nodes, nodes);
  if (last == first) refuse(key, first, "makes a single node rigid; expected a curve");
  const double arm = lever_of(last)(c) - lever_of(first)(c);
  const RigidCurve curve{std::move(nodes), about, {2 * first, 2 * first + 1, 2 * last + c}, arm};
  const auto [qx, qy, turn] = curve.q;
  const std::array<int, 2> of{qx, qy};
  // q_turn = u_last,c - u_first,c; the displacement of `about` is that of the first node less what its turn makes.
  for (const int node : curve.nodes)
    for (int k = 0; k < 2; ++k) {
      const int u = 2 * node + k;
      const double lever = lever_of(node)(k) / arm;
      if (u == turn) {
        inverse_.emplace_back(turn, turn, 1);
        inverse_.emplace_back(turn, of[c], -1);
      } else {
        const double of_turn = u == of[k] ? lever : lever - lever_of(first)(k) / arm;
        inverse_.emplace_back(u, u, 1);
        if (u != of[k]) inverse_.emplace_back(u, of[k], -1);
        inverse_.emplace_back(u, turn, -of_turn);
        inverse_.emplace_back(u, of[c], of_turn);
        if (u != of[k]) {
          rows_[u].emplace_back(u, 1);
          constraints_.fixed[u] = 1;
        }
      }
      rows_[u].emplace_back(of[k], 1);
      rows_[u].emplace_back(turn, lever);
    }
  for (int k = 0; k < 3; ++k)
    if (motion[k]) {
      constraints_.fixed[curve.q[k]] = 1;
      constraints_.value(curve.q[k]) = *motion[k] * (k == 2 ? arm : 1);
    }
  return curve;
}

std::array<MultipointBuilder::Axis, 2> MultipointBuilder::axes(int node) const {
  const int x = 2 * node;
  if (const auto skew = skew_.find(node); skew != skew_.end()) {
    const Vec2& d = skew->second.direction;
    return {Axis{x, d, true}, Axis{x + 1, {-d.y(), d.x()}, false}};
  }
  return {Axis{x, Vec2::UnitX(), constraints_.fixed[x] != 0},
          Axis{x + 1, Vec2::UnitY(), constraints_.fixed[x + 1] != 0}};
}

std::optional<TieOverlap> MultipointBuilder::tie(const Tie& tie) {
  std::map<int, double> area, drawn;  // of the tied q
  const Vec2 normal = tie.pretension ? tie.pretension->normal : Vec2(0, 0);
  const auto add = [&](int q, const TiedNode& one, const Vec2& along) {
    const Vec2 of_other = tie.turn.transpose() * along;
    for (const auto& [other, weight] : one.weights)
      for (int c = 0; c < 2; ++c)
        if (of_other(c) != 0) ties_[q].emplace_back(2 * other + c, weight * of_other(c));
  };
  for (const TiedNode& one : tie.nodes) {
    if (rigid_.contains(one.node))
      refuse(tie.key, one.node, "ties a node of a rigid curve; expected multipliers_on the other curve");
    const bool is_its_own = std::ranges::any_of(one.weights, [&](const auto& w) { return w.first == one.node; });
    for (const Axis& axis : axes(one.node))
      if (!axis.held) {
        if (is_its_own)
          refuse(tie.key, one.node, "is on both curves; expected displacement = { x = 0, y = 0 } at the centre");
        area[axis.q] = one.area;
        drawn[axis.q] = normal.dot(axis.direction);
        add(axis.q, one, axis.direction);
      }
  }
  for (const TiedNode& one : tie.nodes)
    for (const Axis& held : axes(one.node))
      for (const Axis& beside : axes(one.beside)) {
        const double part =
            held.held && area.contains(beside.q) ? one.area / area[beside.q] * held.direction.dot(beside.direction) : 0;
        if (part == 0) continue;
        drawn[beside.q] += part * held.direction.dot(normal);
        add(beside.q, one, part * held.direction);
        for (int c = 0; c < 2; ++c) ties_[beside.q].emplace_back(2 * one.node + c, -part * held.direction(c));
      }
  if (!tie.pretension) return {};
  return draw(tie, drawn);
}

TieOverlap MultipointBuilder::draw(const Tie& tie, const std::map<int, double>& drawn) {
  const auto most = std::ranges::max_element(drawn, {}, [](const auto& one) { return std::abs(one.second); });
  if (most == drawn.end() || std::abs(most->second) < parallel)
    throw SceneError(tie.key + ": supports or other ties hold all nodes of '" + tie.curves[0] +
                     "' along its normal; expected multipliers_on the other curve, or a cut that nothing holds");
  const TieOverlap overlap{most->first, most->second};
  for (const auto& [q, part] : drawn)
    if (tie.pretension->overlap)
      constraints_.value(q) = part * *tie.pretension->overlap;
    else if (part != 0)
      drawn_.emplace_back(q, overlap.q, q == overlap.q ? 0 : part / overlap.part);
  return overlap;
}

void MultipointBuilder::add_row(int u, double weight, int depth, std::map<int, double>& row) const {
  constexpr int deepest = 10;  // ties that follow one another
  if (depth > deepest)
    throw SceneError("ties follow one another in a circle " + near_point(place(u / 2)) +
                     "; expected multipliers_on the other curve of one of them");
  const auto take = [&](int q, double part) {
    row[q] += part;
    if (const auto tie = ties_.find(q); tie != ties_.end())
      for (const auto& [other, of_other] : tie->second) add_row(other, part * of_other, depth + 1, row);
  };
  const auto own = rows_.find(u);
  if (own == rows_.end()) return take(u, weight);
  for (const auto& [q, part] : own->second) take(q, weight * part);
}

// T q with the tied q that an overlap draws along as multiples of its own.
void MultipointBuilder::take_overlaps(MultipointConstraints& multipoint) {
  if (drawn_.empty()) return;
  for (const auto& along : drawn_) constraints_.fixed[along.col()] = 0;
  const auto others = filled<SparseRows>(multipoint.T.rows(), multipoint.T.cols(), drawn_);
  multipoint.T += SparseRows(multipoint.T * others);
  multipoint.inverse -= SparseRows(others * multipoint.inverse);
}

std::map<int, HeldTwice> MultipointBuilder::finish() {
  if (skew_.empty() && rigid_.empty() && ties_.empty()) return std::move(held_twice_);
  const Eigen::Index n = constraints_.value.size();
  for (const auto& [node, skew] : skew_)
    for (const Axis& axis : axes(node))
      for (int c = 0; c < 2; ++c) {
        rows_[2 * node + c].emplace_back(axis.q, axis.direction(c));
        inverse_.emplace_back(axis.q, 2 * node + c, axis.direction(c));
      }
  MultipointConstraints multipoint{{}, {}, std::vector<char>(n, 0), std::vector<char>(n, 0)};
  for (const auto& [u, row] : rows_) multipoint.coupled[u] = 1;
  for (const auto& [q, weights] : ties_) {
    constraints_.fixed[q] = multipoint.tied[q] = 1;
    if (!rows_.contains(q)) inverse_.emplace_back(q, q, 1);
    if (!rows_.contains(q)) multipoint.coupled[q] = 1;
    for (const auto& [other, weight] : weights) inverse_.emplace_back(q, other, -weight);
  }
  Triplets entries;
  for (int u = 0; u < int(n); ++u) {
    std::map<int, double> row{{u, 0}};
    if (multipoint.coupled[u])
      add_row(u, 1, 0, row);
    else
      inverse_.emplace_back(u, u, row[u] = 1);
    for (const auto& [q, part] : row) entries.emplace_back(u, q, part);
  }
  multipoint.T = filled<SparseRows>(n, n, entries);
  multipoint.inverse = filled<SparseRows>(n, n, inverse_);
  take_overlaps(multipoint);
  constraints_.multipoint = std::move(multipoint);
  return std::move(held_twice_);
}

}  // namespace mortise
