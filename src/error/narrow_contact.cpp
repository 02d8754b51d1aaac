#include "error/narrow_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/least_gap.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

// Contact that is two edges wide or less presses on so many vertices, side by side.
constexpr std::size_t most_vertices = 4;

// Those about an edge that are pressed without a break, if they are no more than that.
std::vector<Eigen::Index> few_pressed(const PressureLine& line, Eigen::Index edge) {
  std::vector<Eigen::Index> pressed;
  for (const int step : {-1, 1}) {
    std::optional<Eigen::Index> at = step < 0 ? edge : edge + 1;
    for (; at && line.p(*at) > 0; at = line.beside(*at, step)) {
      if (pressed.size() == most_vertices) return {};
      pressed.push_back(*at);
    }
  }
  return pressed;
}

// Whether the gap is as of round bodies: at corners and ends of flat ones it opens otherwise to either side.
bool is_parabola(const Trough& trough) {
  constexpr double alike = 2;  // elastic displacements are in it
  return trough.least_curvature > 0 && trough.curvature < alike * trough.least_curvature;
}

// Whether a place is as near as that to an end of the multiplier side: one half of a contact whose other half a line of
// symmetry has left out.
bool is_at_end(const Mesh& mesh, const Curve& curve, const Vec2& x, double near) {
  const auto is_near = [&](int node) { return (mesh.nodes.row(node).transpose() - x).norm() < near; };
  return !curve.closed && (is_near(curve.edges.front().nodes[0]) || is_near(curve.edges.back().nodes[1]));
}

// Of each vertex its force by length, int N_i p_i ds, and of rings about the axis, int N_i p_i 2 pi r ds.
MatX forces_of(const ContactPair& pair, const PressureLine& line) {
  MatX forces = MatX::Zero(line.p.size(), 2);
  for (const ContactPoint& point : pair.points)
    for (const int end : {0, 1}) {
      const double p = (end == 0 ? 1 - point.xi : 1 + point.xi) / 2 * line.p(point.edge + end);
      forces.row(point.edge + end) += p * Eigen::RowVector2d(point.ds, point.dA);
    }
  return forces;
}

// A contact as Hertz has it.
struct Patch {
  double half;    // of its width, length
  double square;  // int p^2 ds, stress^2 length
};

Patch cylinders(double force, double modulus, double curvature) {
  const double half = std::sqrt(4 * force / (std::numbers::pi * modulus * curvature)),
               most = modulus * curvature * half / 2;
  return {half, 4 * most * most * half / 3};
}

Patch spheres(double force, double modulus, double curvature) {
  const double half = std::cbrt(3 * force / (4 * modulus * curvature)),
               most = 2 * modulus * curvature * half / std::numbers::pi;
  return {half, 2 * most * most * half / 3};
}

}  // namespace

void add_narrow_contact(const Problem& p, const VecX& u, std::vector<PressureEstimate>& list) {
  for (std::size_t k = 0; k < p.pairs.size(); ++k) {
    const ContactPair& pair = p.pairs[k];
    PressureEstimate& e = list[k];
    if (pair.spec.condition != Condition::unilateral || pair.spec.stiffness) continue;
    std::vector<std::vector<Eigen::Index>> pressed;  // about each edge
    std::vector<char> few;
    for (Eigen::Index edge = 0; edge + 1 < e.line.p.size(); ++edge)
      few.push_back(!pressed.emplace_back(few_pressed(e.line, edge)).empty());
    if (!std::ranges::count(few, 1)) continue;
    const std::vector<ElasticLaw>& laws = p.discretisation.laws;
    const double modulus = contact_modulus(laws[pair.multiplier.body], laws[pair.opposite.body]);
    const bool rings = pair.geometry.model.axisymmetric();
    const MatX forces = forces_of(pair, e.line);
    std::vector<Trough> all = troughs(p.mesh.nodes, u, pair, few);
    const std::vector<Trough> drawn = troughs(p.mesh.nodes, VecX::Zero(u.size()), pair, few);
    all.insert(all.end(), drawn.begin(), drawn.end());
    for (const Trough& trough : all) {
      if (!is_parabola(trough)) continue;
      const Edge& edge = pair.multiplier.edges[trough.point.edge];
      const EdgePoint at = edge_point(p.mesh.nodes, edge, trough.point.xi);
      const double length = edge_length(p.mesh.nodes, edge);
      const Eigen::RowVector2d force = forces(pressed[trough.point.edge], Eigen::all).colwise().sum();
      const bool on_axis = rings && at.position.x() < length;
      Patch patch =
          on_axis ? spheres(force(1), modulus, trough.curvature) : cylinders(force(0), modulus, trough.curvature);
      if (!on_axis && is_at_end(p.mesh, pair.multiplier, at.position, patch.half))
        patch = cylinders(2 * force(0), modulus, trough.curvature);
      if (patch.half > length) continue;
      const Edge& other = pair.opposite.edges[trough.point.opposite_edge];
      const EdgePoint opposite = edge_point(p.mesh.nodes, other, trough.point.eta);
      for (const EdgePoint& place : {at, opposite})
        for (const int end : {-1, 0, 1})
          e.local.narrow_at.push_back({place.position + end * patch.half * place.tangent.normalized(),
                                       patch.half / edges_of_contact, patch.square / (2 * 6)});  // of two states
    }
  }
}

}  // namespace mortise
