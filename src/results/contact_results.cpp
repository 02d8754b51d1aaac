#include "results/contact_results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "error/pressure_form.hpp"
#include "error/pressure_line.hpp"
#include "fem/edges.hpp"
#include "model/resultant.hpp"
#include "results/contact_length.hpp"

namespace mortise {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct CurveNode {
  int node;
  double s;
  Place place;  // on one of the edges that meet at the node
  Vec2 normal;  // mean of the edges' normals there
};

// An end on a symmetry plane continues as its mirror image: the mean normal vanishes along what is prescribed.
Vec2 mirrored(const Vec2& n, const Constraints& constraints, int node) {
  Vec2 m = n;
  for (const Vec2& d : prescribed_directions(constraints, node)) m -= m.dot(d) * d;
  return m.norm() > 1e-3 ? m.normalized() : n;
}

// `line`: whose normals are taken instead of the edges'.
std::vector<CurveNode> nodes_along(const Mesh& mesh, const Curve& curve, const Constraints& constraints,
                                   const ContactLine* line) {
  const auto normal_at = [&](int e, double xi) {
    return line ? line->at(e, xi).normal() : edge_point(mesh.nodes, curve.edges[e], xi).normal();
  };
  std::vector<CurveNode> list;
  double s = 0;
  for (int e = 0; e < int(curve.edges.size()); ++e) {
    const Edge& edge = curve.edges[e];
    const Vec2 n = normal_at(e, -1);
    if (e == 0) {
      list.push_back({edge.nodes[0], s, {e, -1}, n});
    } else {
      list.back().normal = (list.back().normal + n).normalized();
    }
    const double length = edge_length(mesh.nodes, edge);
    if (edge.node_count == 3)  // the part of the length before the middle node: the same rule on half the edge
      list.push_back({edge.nodes[2], s + length_to(mesh.nodes, edge, 0), {e, 0}, normal_at(e, 0)});
    s += length;
    list.push_back({edge.nodes[1], s, {e, 1}, normal_at(e, 1)});
  }
  if (curve.closed) {
    list.front().normal = (list.front().normal + list.back().normal).normalized();
    list.pop_back();
  } else {
    for (CurveNode* end : {&list.front(), &list.back()}) end->normal = mirrored(end->normal, constraints, end->node);
  }
  return list;
}

// Where the multiplier side's normal passes through a node of the opposite side, near its nearest node there.
std::optional<Place> foot_of(const Mesh& mesh, const Curve& multiplier, const std::vector<CurveNode>& along,
                             const Vec2& x) {
  const auto nearest = std::min_element(along.begin(), along.end(), [&](const CurveNode& a, const CurveNode& b) {
    return (mesh.nodes.row(a.node).transpose() - x).squaredNorm() <
           (mesh.nodes.row(b.node).transpose() - x).squaredNorm();
  });
  std::optional<Place> best;
  double distance = std::numeric_limits<double>::infinity();
  const int count = int(multiplier.edges.size());
  for (int step = -1; step <= 1; ++step) {
    int e = nearest->place.edge + step;
    if (multiplier.closed) e = (e + count) % count;
    if (e < 0 || e >= count) continue;
    const auto xi = foot_on_edge(mesh.nodes, multiplier.edges[e], x);
    if (!xi) continue;
    const double d = (edge_point(mesh.nodes, multiplier.edges[e], *xi).position - x).norm();
    if (d < distance) {
      distance = d;
      best = Place{e, *xi};
    }
  }
  // Between two edges' normals, or at the very node: the node itself, unless it is an end that lies off to the side.
  const Vec2 away = x - mesh.nodes.row(nearest->node).transpose();
  const double sideways = std::abs(away.x() * nearest->normal.y() - away.y() * nearest->normal.x());
  const double size = edge_length(mesh.nodes, multiplier.edges[nearest->place.edge]);
  if (away.norm() < distance && sideways < 0.1 * size) best = nearest->place;
  return best;
}

double normal_stress(const Eigen::Ref<const Eigen::RowVector4d>& s, const Vec2& n) {
  return s(0) * n.x() * n.x() + s(1) * n.y() * n.y() + 2 * s(3) * n.x() * n.y();
}

// `nodes`: of the same side, in the curve's order.
std::vector<ContactCentre> centre_results(const Mesh& mesh, const Curve& curve, const std::vector<ContactNode>& nodes,
                                          const StressField& stress) {
  const auto p = [&](std::size_t k) { return nodes[k % nodes.size()].p; };
  std::vector<ContactCentre> list;
  double s = 0;
  for (std::size_t e = 0; e < curve.edges.size(); ++e) {
    const EdgePoint middle = edge_point(mesh.nodes, curve.edges[e], 0);
    const auto row = stress.centres.row(curve.sides[e].cell);
    const double mean =
        curve.edges[e].node_count == 2 ? (p(e) + p(e + 1)) / 2 : (p(2 * e) + 4 * p(2 * e + 1) + p(2 * e + 2)) / 6;
    list.push_back({s + length_to(mesh.nodes, curve.edges[e], 0), middle.position, mean,
                    normal_stress(row, middle.normal()), row(1)});
    s += edge_length(mesh.nodes, curve.edges[e]);
  }
  return list;
}

// Turns s around.
void reverse(ContactSide& side, double length) {
  std::reverse(side.nodes.begin(), side.nodes.end());
  std::reverse(side.centres.begin(), side.centres.end());
  for (ContactNode& n : side.nodes) n.s = length - n.s;
  for (ContactCentre& c : side.centres) c.s = length - c.s;
}

// The smallest p at the contact points, and between those of an edge where the parabola through its three is lowest.
double least_pressure(const ContactPair& pair, const VecX& pressure) {
  const auto& points = pair.points;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ContactPoint& c = points[i];
    least = std::min(least, interpolate(pair, pressure, {c.edge, c.xi}));
    const auto& on = pair.coupling.on_edge[c.edge];
    if (on[2] < 0 || i + 1 == points.size() || points[i + 1].edge != c.edge) continue;
    const double start = pressure(on[0]), end = pressure(on[1]), middle = pressure(on[2]);
    const double slope = (end - start) / 2, bend = (start + end) / 2 - middle;  // p = middle + slope xi + bend xi^2
    const double lowest = bend > 0 ? -slope / (2 * bend) : c.xi;
    if (lowest > c.xi && lowest < points[i + 1].xi) least = std::min(least, middle - slope * slope / (4 * bend));
  }
  return least;
}

// What all nodes of a pair are asked with.
struct Asked {
  const Mesh& mesh;
  const ContactPair& pair;
  const BodyPoints& points;
  const StressField& stress;
  const VecX &u, &pressure, &fluid;

  // A node's stresses, and u_n along `normal`.
  ContactNode node(const CurveNode& at, int body, const Vec2& normal) const {
    const auto s = stress.points.row(point_of(points, body, at.node));
    return {.node = at.node,
            .s = at.s,
            .position = mesh.nodes.row(at.node).transpose(),
            .normal = normal,
            .u_n = u.segment<2>(2 * at.node).dot(normal),
            .p = nan,
            .gap = nan,
            .sigma_n = normal_stress(s, at.normal),
            .sigma_2 = s(1)};
  }

  double initial_gap(const Line& line, const Place& at, const Hit& hit) const {
    return pair.spec.initial_gap == InitialGap::closed ? 0 : pair.geometry.initial_gap(line, at, hit);
  }
};

ContactNode on_multiplier_side(const Asked& asked, const CurveNode& at) {
  const ContactPair& pair = asked.pair;
  ContactNode n = asked.node(at, pair.multiplier.body, at.normal);
  n.p = n.p_multiplier = interpolate(pair, asked.pressure, at.place);
  n.p_fluid = interpolate(pair, asked.fluid, at.place);
  n.on_multiplier = at.place;
  const Line line{n.position, at.normal, deepest_overlap(pair.multiplier, at.place.edge)};
  if (const auto hit = project_onto_curve(asked.mesh.nodes, pair.opposite, line)) {
    const Vec2 other = edge_value(asked.u, pair.opposite.edges[hit->edge], hit->xi);
    n.gap = asked.initial_gap(line, at.place, *hit) + other.dot(at.normal) - n.u_n;
  }
  return n;
}

// `along`: the nodes of the multiplier side.
ContactNode on_opposite_side(const Asked& asked, const CurveNode& at, const std::vector<CurveNode>& along) {
  const Points& nodes = asked.mesh.nodes;
  const ContactPair& pair = asked.pair;
  const Vec2 x = nodes.row(at.node).transpose();
  const auto foot = foot_of(asked.mesh, pair.multiplier, along, x);
  if (!foot) {
    ContactNode n = asked.node(at, pair.opposite.body, -at.normal);
    n.p = n.p_multiplier = 0;
    return n;
  }
  const Edge& edge = pair.multiplier.edges[foot->edge];
  const Line line = pair.geometry.line_from(nodes, pair.multiplier, *foot);
  // At a vertex of the multiplier side its mean normal, as in that side's own rows.
  const auto vertex = std::find_if(along.begin(), along.end(), [&](const CurveNode& c) {
    return (nodes.row(c.node).transpose() - line.x).norm() < 1e-9 * edge_length(nodes, edge);
  });
  const Vec2 normal = vertex != along.end() ? vertex->normal : line.n;
  ContactNode n = asked.node(at, pair.opposite.body, normal);
  n.p = n.p_multiplier = interpolate(pair, asked.pressure, *foot);
  n.p_fluid = interpolate(pair, asked.fluid, *foot);
  n.on_multiplier = *foot;
  const Hit own{at.place.edge, at.place.xi, (x - line.x).dot(normal)};
  n.gap = asked.initial_gap({line.x, normal, line.depth}, *foot, own) + n.u_n -
          edge_value(asked.u, edge, foot->xi).dot(normal);
  return n;
}

// Both curves keep their bodies on the left, so they run against each other.
void run_together(const Points& nodes, const ContactPair& pair, ContactResults& r) {
  if (runs_backwards(nodes, pair.multiplier))
    reverse(r.multiplier, r.length);
  else
    reverse(r.opposite, curve_length(nodes, pair.opposite));
}

void set_extremes(ContactResults& r) {
  r.p_min = std::numeric_limits<double>::infinity();
  r.p_max = -r.p_min;
  for (const ContactNode& n : r.multiplier.nodes) {
    if (std::isnan(n.gap) && n.p == 0) continue;
    r.p_min = std::min(r.p_min, n.p);
    r.p_max = largest(r.p_max, n.p);
  }
  if (r.p_min > r.p_max) {  // the opposite side faces parts of edges only
    r.p_min = r.pressure.minCoeff();
    r.p_max = r.pressure.maxCoeff();
  }
}

double mean_pressure(const ContactPair& pair, const VecX& pressure) {
  double area = 0, sum = 0;
  for (const ContactPoint& c : pair.points) {
    area += c.dA;
    sum += c.dA * interpolate(pair, pressure, {c.edge, c.xi});
  }
  return sum / area;
}

// Row values of its fluid.
VecX fluid_rows(const Problem& problem, const ContactPair& pair) {
  const Eigen::Index rows = pair.coupling.B.rows();
  return problem.fluid.size() > 0 ? VecX(problem.fluid.segment(pair.first_row, rows)) : VecX(VecX::Zero(rows));
}

double wet_length(const ContactPair& pair, const VecX& fluid) {
  double length = 0;
  for (const ContactPoint& c : pair.points)
    if (const double p = interpolate(pair, fluid, {c.edge, c.xi}); p > 0)
      length += c.ds * p / pair.spec.fluid->pressure;
  return length;
}

// At its multipliers; 0 where nothing is faced.
VecX overlaps(const ContactPair& pair, const ContactResults& r) {
  std::map<int, double> at_node;
  for (const ContactNode& node : r.multiplier.nodes) at_node[node.node] = std::isfinite(node.gap) ? -node.gap : 0;
  VecX overlaps(r.pressure.size());
  for (Eigen::Index a = 0; a < overlaps.size(); ++a) overlaps(a) = at_node.at(pair.coupling.node[a]);
  return overlaps;
}

Resultant force_on_multiplier_side(const Points& nodes, const Coupling& coupling, const VecX& row_values) {
  Resultant sum;
  for (const auto& [node, force] : contact_forces(coupling.own, row_values))
    sum.add(nodes.row(node).transpose(), force);
  return sum;
}

}  // namespace

ContactResults contact_results(const Problem& problem, const ContactPair& pair, const StressField& stress,
                               const Solution& solution) {
  const Mesh& mesh = problem.mesh;
  const Constraints& constraints = problem.discretisation.system.constraints;
  const VecX lambda = solution.lambda.segment(pair.first_row, pair.coupling.B.rows());
  const ContactGeometry& geometry = pair.geometry;
  const auto along =
      nodes_along(mesh, pair.multiplier, constraints, geometry.normals ? &*geometry.multiplier : nullptr);
  const auto facing = nodes_along(mesh, pair.opposite, constraints, geometry.normals ? &*geometry.opposite : nullptr);
  ContactResults r;
  r.pressure = 0 - multiplier_values(pair.coupling, lambda).array();  // 0 - 0 is 0, -0 is not
  const VecX of_fluid = fluid_rows(problem, pair), fluid = multiplier_values(pair.coupling, of_fluid);
  const Asked asked{mesh, pair, problem.points, stress, solution.u, r.pressure, fluid};

  r.multiplier.curve = mesh.boundaries[pair.multiplier.boundary].name;
  for (const CurveNode& at : along) r.multiplier.nodes.push_back(on_multiplier_side(asked, at));
  r.multiplier.centres = centre_results(mesh, pair.multiplier, r.multiplier.nodes, stress);

  r.opposite.curve = mesh.boundaries[pair.opposite.boundary].name;
  for (const CurveNode& at : facing) r.opposite.nodes.push_back(on_opposite_side(asked, at, along));
  r.opposite.centres = centre_results(mesh, pair.opposite, r.opposite.nodes, stress);

  r.length = curve_length(mesh.nodes, pair.multiplier);
  run_together(mesh.nodes, pair, r);
  r.p_least = least_pressure(pair, r.pressure);
  set_extremes(r);
  r.p_mean = mean_pressure(pair, r.pressure);
  const double round_off =
      round_off_pressure(mesh, {&pair, 1}, problem.discretisation.system.stiffness_scale, solution.u);
  const ContactLength in_contact =
      gives_way(pair) ? length_in_contact(mesh.nodes, pair, overlaps(pair, r), fluid, 1e-12 * largest_entry(solution.u))
                      : length_in_contact(mesh.nodes, pair, r.pressure, fluid, round_off);
  r.length_in_contact = in_contact.length;
  r.ends = in_contact.ends;
  if (r.ends && runs_backwards(mesh.nodes, pair.multiplier))
    r.ends = {r.length - (*in_contact.ends)[1], r.length - (*in_contact.ends)[0]};
  const Resultant sum = force_on_multiplier_side(mesh.nodes, pair.coupling, lambda);
  r.force = sum.force;
  r.moment = sum.moment;
  r.centre = centre_of(mesh.nodes, pair.multiplier.edges);
  if (pair.spec.fluid)
    r.fluid = FluidResults{.force = force_on_multiplier_side(mesh.nodes, pair.coupling, -of_fluid).force,
                           .wet_length = wet_length(pair, fluid)};
  return r;
}

void set_fitted_pressure(const Points& nodes, const Curve& multiplier, const FittedPressure& fitted,
                         ContactResults& results) {
  if (fitted.pieces.empty()) return;
  VecX start = VecX::Zero(Eigen::Index(multiplier.edges.size()) + 1);
  for (std::size_t e = 0; e < multiplier.edges.size(); ++e)
    start(e + 1) = start(e) + edge_length(nodes, multiplier.edges[e]);
  for (ContactSide* side : {&results.multiplier, &results.opposite})
    for (ContactNode& node : side->nodes) {
      const auto [edge, xi] = node.on_multiplier;
      if (edge < 0) continue;
      if (const auto p = fitted.at(start(edge) + (1 + xi) / 2 * (start(edge + 1) - start(edge)))) node.p = *p;
    }
  set_extremes(results);
}

}  // namespace mortise
