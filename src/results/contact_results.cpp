#include "results/contact_results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "contact/tied_vertices.hpp"
#include "error/pressure_form.hpp"
#include "error/pressure_line.hpp"
#include "fem/edges.hpp"
#include "results/contact_length.hpp"

namespace mortise {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double normal_stress(const Eigen::Ref<const Eigen::RowVector4d>& s, const Vec2& n) {
  return s(0) * n.x() * n.x() + s(1) * n.y() * n.y() + 2 * s(3) * n.x() * n.y();
}

// Of each edge of one side of a pair; of one that faces the other side in part, what acts there over all its length.
// `nodes`: of that side, in the curve's order; `acting`: the integral of p over what faces the other side, an edge.
std::vector<double> mean_pressures(const Points& places, const Curve& curve, const std::vector<ContactNode>& nodes,
                                   const std::vector<double>& acting) {
  std::vector<double> list;
  for (std::size_t e = 0; e < curve.edges.size(); ++e) {
    const std::size_t steps = curve.edges[e].node_count - 1;
    const auto node = [&](std::size_t k) -> const ContactNode& { return nodes[(steps * e + k) % nodes.size()]; };
    bool faces = true;
    for (std::size_t k = 0; k <= steps; ++k) faces = faces && !std::isnan(node(k).gap);
    if (!faces)
      list.push_back(acting[e] / edge_length(places, curve.edges[e]));
    else
      list.push_back(steps == 1 ? (node(0).p + node(1).p) / 2 : (node(0).p + 4 * node(1).p + node(2).p) / 6);
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

  ContactNode node(const FacingNode& at, int body) const {
    const auto s = stress.points.row(point_of(points, body, at.node));
    const bool on_line = at.on_multiplier.edge >= 0;
    const double p = on_line ? interpolate(pair, pressure, at.on_multiplier) : 0;
    // The multiplier of an edge of which a part faces the other side goes on to its end, p does not.
    const bool faces = on_line && at.faces;
    return {.node = at.node,
            .s = at.s,
            .position = mesh.nodes.row(at.node).transpose(),
            .normal = at.normal,
            .u_n = u.segment<2>(2 * at.node).dot(at.normal),
            .p = faces ? p : 0,
            .gap = at.faces ? gap(at) : nan,
            .sigma_n = normal_stress(s, at.own_normal),
            .sigma_2 = s(1),
            .on_multiplier = at.on_multiplier,
            .p_multiplier = p,
            .p_fluid = faces ? interpolate(pair, fluid, at.on_multiplier) : 0};
  }

  // Deformed.
  double gap(const FacingNode& at) const {
    const auto& [line, hit] = *at.faces;
    const Place& own = at.on_multiplier;
    const double undeformed =
        pair.spec.initial_gap == InitialGap::closed ? 0 : pair.geometry.initial_gap(line, own, hit);
    const auto moved = [&](const Curve& curve, int edge, double xi) {
      return edge_value(u, curve.edges[edge], xi).dot(at.normal);
    };
    return undeformed + moved(pair.opposite, hit.edge, hit.xi) - moved(pair.multiplier, own.edge, own.xi);
  }

  ContactSide side(const Curve& curve, const CurveNodes& along) const {
    ContactSide found;
    found.curve = mesh.boundaries[curve.boundary].name;
    for (const FacingNode& at : along.nodes) found.nodes.push_back(node(at, curve.body));
    found.centres = centres(curve, along.middles, mean_pressures(mesh.nodes, curve, found.nodes, acting(curve)));
    return found;
  }

  // The integral of p along each edge of either curve.
  std::vector<double> acting(const Curve& curve) const {
    std::vector<double> list(curve.edges.size(), 0);
    for (const ContactPoint& c : pair.points)
      list[&curve == &pair.multiplier ? c.edge : c.opposite_edge] += c.ds * interpolate(pair, pressure, {c.edge, c.xi});
    return list;
  }

  // `p`: one an edge.
  std::vector<ContactCentre> centres(const Curve& curve, const std::vector<EdgeMiddle>& middles,
                                     const std::vector<double>& p) const {
    std::vector<ContactCentre> list;
    for (std::size_t e = 0; e < curve.edges.size(); ++e) {
      const auto row = stress.centres.row(curve.sides[e].cell);
      list.push_back({middles[e].s, middles[e].position, p[e], normal_stress(row, middles[e].normal), row(1)});
    }
    return list;
  }
};

// Both curves keep their bodies on the left, so they run against each other.
void run_together(bool multiplier_runs_backwards, const ContactNodes& nodes, ContactResults& r) {
  if (multiplier_runs_backwards)
    reverse(r.multiplier, nodes.multiplier.length);
  else
    reverse(r.opposite, nodes.opposite.length);
}

void set_extremes(ContactResults& r) {
  r.p_min = std::numeric_limits<double>::infinity();
  r.p_max = -r.p_min;
  for (const ContactNode* n : nodes_of_extremes(r)) {
    r.p_min = std::min(r.p_min, n->p);
    r.p_max = largest(r.p_max, n->p);
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

Resultant fluid_besides(const Problem& p, const ContactPair& pair, const VecX& of_fluid) {
  VecX rows = VecX::Zero(p.fluid.size());
  rows.segment(pair.first_row, of_fluid.size()) = of_fluid;
  const VecX forces = p.fluid_loads.transpose() * rows - p.discretisation.system.B.transpose() * rows;
  Resultant sum;
  for (Eigen::Index i = 0; i < p.mesh.nodes.rows(); ++i)
    if (const Vec2 f = forces.segment<2>(2 * i); f.any()) sum.add(p.mesh.nodes.row(i).transpose(), f);
  return sum;
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

// Whether the sides overlap wherever they press, but for the vertices beside an end of contact. Those of a layer that
// hardly gives way do in the mean alone: between vertices the bodies' own shapes are more than p over its stiffness.
bool overlap_where_pressed(const ContactPair& pair, const VecX& pressure, const VecX& overlaps) {
  std::vector<char> at_end(std::size_t(pressure.size()), 0);
  for (const auto& on : pair.coupling.on_edge)
    for (const int end : {0, 1})
      if (!(pressure(on[end]) > 0)) at_end[on[1 - end]] = 1;
  for (Eigen::Index a = 0; a < pressure.size(); ++a)
    if (pressure(a) > 0 && !(overlaps(a) > 0) && !at_end[a]) return false;
  return true;
}

Resultant force_on_multiplier_side(const Points& nodes, const Coupling& coupling, const VecX& row_values) {
  Resultant sum;
  for (const auto& [node, force] : contact_forces(coupling.own, row_values))
    sum.add(nodes.row(node).transpose(), force);
  return sum;
}

}  // namespace

ContactNumbers contact_numbers(const Problem& problem) {
  const auto& pairs = problem.pairs;
  const auto& ties = problem.mesh.ties;
  ContactNumbers numbers;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    numbers.pairs.push_back(
        int(k + std::ranges::count_if(ties, [&](const Tie& tie) { return tie.entry < pairs[k].spec.entry; })));
  for (std::size_t k = 0; k < ties.size(); ++k)
    numbers.ties.push_back(int(
        k + std::ranges::count_if(pairs, [&](const ContactPair& pair) { return pair.spec.entry < ties[k].entry; })));
  return numbers;
}

ContactResults contact_results(const Problem& problem, const ContactPair& pair, const ContactNodes& nodes,
                               const StressField& stress, const Solution& solution, double displacement) {
  const Mesh& mesh = problem.mesh;
  const VecX lambda = solution.lambda.segment(pair.first_row, pair.coupling.B.rows());
  ContactResults r;
  r.pressure = 0 - multiplier_values(pair.coupling, lambda).array();  // 0 - 0 is 0, -0 is not
  const VecX of_fluid = fluid_rows(problem, pair), fluid = multiplier_values(pair.coupling, of_fluid);
  const Asked asked{mesh, pair, problem.points, stress, solution.u, r.pressure, fluid};
  r.multiplier = asked.side(pair.multiplier, nodes.multiplier);
  r.opposite = asked.side(pair.opposite, nodes.opposite);
  // Where contact lies between nodes, these are all there are.
  if (std::ranges::all_of(r.multiplier.nodes, [](const ContactNode& n) { return std::isnan(n.gap); }))
    for (ContactNode& n : r.multiplier.nodes) n.p = n.p_multiplier;
  r.length = nodes.multiplier.length;
  const bool backwards = runs_backwards(mesh.nodes, pair.multiplier);
  run_together(backwards, nodes, r);
  r.p_least = least_pressure(pair, r.pressure);
  r.gives_way = gives_way(pair);
  set_extremes(r);
  r.p_mean = mean_pressure(pair, r.pressure);
  const double round_off = round_off_pressure(mesh, pair, problem.discretisation.laws, displacement);
  const VecX overlap = gives_way(pair) ? overlaps(pair, r) : VecX();
  const ContactLength in_contact = gives_way(pair) && overlap_where_pressed(pair, r.pressure, overlap)
                                       ? length_of_overlap(mesh.nodes, pair, overlap, 1e-12 * displacement)
                                       : length_in_contact(mesh.nodes, pair, r.pressure, fluid, round_off);
  r.length_in_contact = in_contact.length;
  r.ends = in_contact.ends;
  if (r.ends && backwards) r.ends = {r.length - (*in_contact.ends)[1], r.length - (*in_contact.ends)[0]};
  const Resultant sum = force_on_multiplier_side(mesh.nodes, pair.coupling, lambda);
  r.force = sum.force;
  r.moment = sum.moment;
  r.centre = centre_of(mesh.nodes, pair.multiplier.edges);
  if (pair.spec.fluid)
    r.fluid = FluidResults{.force = force_on_multiplier_side(mesh.nodes, pair.coupling, -of_fluid).force,
                           .wet_length = wet_length(pair, fluid),
                           .besides = fluid_besides(problem, pair, of_fluid)};
  return r;
}

std::vector<const ContactNode*> nodes_of_extremes(const ContactResults& r) {
  std::vector<const ContactNode*> nodes;
  for (const ContactNode& n : r.multiplier.nodes)
    if (!std::isnan(n.gap) || n.p != 0) nodes.push_back(&n);
  for (const ContactNode& n : r.opposite.nodes)
    if (r.gives_way && !std::isnan(n.gap)) nodes.push_back(&n);
  return nodes;
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
      if (edge < 0 || std::isnan(node.gap)) continue;
      const auto p = fitted.at(start(edge) + (1 + xi) / 2 * (start(edge + 1) - start(edge)));
      // At one place with a vertex where it has no limit, it may be any number: that of the vertex stands.
      const bool at_vertex = 1 - std::abs(xi) < 2 * at_one_place && !fitted.at(start(xi < 0 ? edge : edge + 1));
      if (p && !at_vertex) node.p = *p;
    }
  set_extremes(results);
}

}  // namespace mortise
