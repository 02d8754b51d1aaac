#include "support/manufactured.hpp"

#include <Eigen/LU>
#include <complex>
#include <stdexcept>

#include "contact/coupling.hpp"
#include "fem/assembly.hpp"
#include "fem/edges.hpp"
#include "fem/elements.hpp"
#include "fem/error_products.hpp"
#include "fem/patch_recovery.hpp"
#include "fem/quadrature.hpp"
#include "solve/direct.hpp"
#include "support/field_errors.hpp"

namespace mortise::test {
namespace {

using Complex = std::complex<double>;
const Complex c2(0.3, -0.2), c3(-0.4, 0.3), c4(0.25, 0.35), d1(-0.5, 0.1), d2(0.3, 0.4), d3(-0.2, 0.3);

Vec2 traction_of(const Vec4& s, const Vec2& n) { return {s(0) * n.x() + s(3) * n.y(), s(3) * n.x() + s(1) * n.y()}; }

Vec2 traction_at(const ExactField& exact, const Vec2& x, const Vec2& n) { return traction_of(exact.stress(x), n); }

// What the slip of the upper body adds to the loads: tractions on its sides and its contact curve, and a body force.
void add_slip_loads(const Mesh& mesh, const ExactField& exact, const Slip& slip, VecX& load) {
  for (const char* side : {"upper_left", "upper_right", "upper_contact"})
    add_traction(
        mesh, {}, sides_of(mesh, mesh.boundaries[boundary_index(mesh, side)]),
        [&](const Vec2& x, const Vec2& n) -> Vec2 {
          return traction_of(slip.stress(x, exact.young, exact.poisson), n);
        },
        load);
  const int upper = body_index(mesh, "upper");
  for (const Cell& cell : mesh.cells) {
    if (cell.body != upper) continue;
    const CellRule rule = product_rule(cell.kind, 4);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const CellShape shape = cell_shape(cell.kind, rule.points[q]);
      const CellPoint at = cell_point(mesh.nodes, cell, shape);
      const Vec2 force = rule.weights[q] * at.jacobian() * slip.body_force(at.x, exact.young, exact.poisson);
      for (int a = 0; a < node_count(cell.kind); ++a) load.segment<2>(2 * cell.nodes[a]) += shape.N[a] * force;
    }
  }
}

double pressure_error(const Mesh& mesh, const ExactField& exact, const TwoPlates& plates,
                      const ContactInterface& interface, const VecX& pressure) {
  const Curve& curve = interface.multiplier;
  const LineRule rule = gauss_legendre(5);
  double sum = 0;
  for (int e = 0; e < int(curve.edges.size()); ++e)
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const EdgePoint p = edge_point(mesh.nodes, curve.edges[e], rule.points[q]);
      const double h = 1e-6, slope = (plates.height(p.position.x() + h) - plates.height(p.position.x() - h)) / (2 * h);
      const Vec2 n = Vec2(-slope, 1).normalized();  // of the exact line; its sign does not matter
      const double sigma_n = traction_at(exact, p.position, n).dot(n);
      const double difference = interpolate(interface, pressure, {e, rule.points[q]}) + sigma_n;
      sum += rule.weights[q] * p.jacobian() * difference * difference;
    }
  return std::sqrt(sum);
}

}  // namespace

Vec2 Slip::displacement(const Vec2& x) const { return (s0 + s1 * x.x()) * Vec2(1, derivatives(x.x())[0]); }

Vec4 Slip::stress(const Vec2& x, double young, double poisson) const {
  const double mu = young / (2 * (1 + poisson)), lambda = 2 * mu * poisson / (1 - 2 * poisson);
  const auto [h1, h2, h3] = derivatives(x.x());
  return {(lambda + 2 * mu) * s1, lambda * s1, lambda * s1, mu * (s1 * h1 + (s0 + s1 * x.x()) * h2)};
}

Vec2 Slip::body_force(const Vec2& x, double young, double poisson) const {  // -div of the stress
  const double mu = young / (2 * (1 + poisson));
  const auto [h1, h2, h3] = derivatives(x.x());
  return {0, -mu * (2 * s1 * h2 + (s0 + s1 * x.x()) * h3)};
}

Vec2 ExactField::displacement(const Vec2& x) const {
  const double mu = young / (2 * (1 + poisson)), kappa = 3 - 4 * poisson;
  const Complex z(x.x(), x.y());
  const Complex phi = z * z * (c2 + z * (c3 + z * c4)), dphi = z * (2. * c2 + z * (3. * c3 + z * 4. * c4));
  const Complex psi = z * (d1 + z * (d2 + z * d3));
  const Complex u = (kappa * phi - z * std::conj(dphi) - std::conj(psi)) / (2 * mu);
  return {u.real(), u.imag()};
}

Vec4 ExactField::stress(const Vec2& x) const {
  const Complex z(x.x(), x.y());
  const Complex dphi = z * (2. * c2 + z * (3. * c3 + z * 4. * c4)), ddphi = 2. * c2 + z * (6. * c3 + z * 12. * c4);
  const Complex dpsi = d1 + z * (2. * d2 + z * 3. * d3);
  const double sum = 4 * dphi.real();
  const Complex deviator = 2. * (std::conj(z) * ddphi + dpsi);  // s22 - s11 + 2 i s12
  const double s22 = (sum + deviator.real()) / 2, s11 = (sum - deviator.real()) / 2;
  return {s11, s22, poisson * sum, deviator.imag() / 2};
}

void prescribe_exactly(const Mesh& mesh, const ExactField& exact, const std::string& name, Constraints& constraints) {
  for (const Edge& edge : mesh.boundaries[boundary_index(mesh, name)].edges)
    for (int a = 0; a < edge.node_count; ++a) {
      const int node = edge.nodes[a];
      constraints.fixed[2 * node] = constraints.fixed[2 * node + 1] = 1;
      constraints.value.segment<2>(2 * node) = exact.displacement(mesh.nodes.row(node).transpose());
    }
}

VecX exact_loads(const Mesh& mesh, const ExactField& exact) {
  VecX load = VecX::Zero(2 * mesh.nodes.rows());
  for (const char* side : {"upper_left", "upper_right", "lower_left", "lower_right"})
    add_traction(
        mesh, {}, sides_of(mesh, mesh.boundaries[boundary_index(mesh, side)]),
        [&](const Vec2& x, const Vec2& n) -> Vec2 { return traction_at(exact, x, n); }, load);
  for (const char* curve : {"upper_contact", "lower_contact"})
    add_traction(
        mesh, {}, sides_of(mesh, mesh.boundaries[boundary_index(mesh, curve)]),
        [&](const Vec2& x, const Vec2& n) -> Vec2 {
          const Vec2 t = traction_at(exact, x, n);
          return t - t.dot(n) * n;
        },
        load);
  return load;
}

Errors manufactured_errors(const ManufacturedCase& which) {
  const ExactField exact;
  const Mesh mesh = mesh_of(which.plates);
  const std::vector<ElasticLaw> laws(2, elastic_law(exact.young, exact.poisson, {Plane::strain}));
  const SparseMatrix K = assemble_stiffness(mesh, laws);
  VecX load = exact_loads(mesh, exact);
  if (which.slip) add_slip_loads(mesh, exact, *which.slip, load);
  Constraints constraints = no_constraints(mesh);
  prescribe_exactly(mesh, exact, "top", constraints);
  prescribe_exactly(mesh, exact, "bottom", constraints);
  const int upper_body = body_index(mesh, "upper");
  const auto displacement = [&](const Vec2& x, int body) -> Vec2 {
    return exact.displacement(x) + (which.slip && body == upper_body ? which.slip->displacement(x) : Vec2(0, 0));
  };
  const auto stress = [&](const Vec2& x, int body) -> Vec4 {
    const Vec4 s = exact.stress(x);
    return which.slip && body == upper_body ? Vec4(s + which.slip->stress(x, exact.young, exact.poisson)) : s;
  };
  if (which.slip)
    for (const Edge& edge : mesh.boundaries[boundary_index(mesh, "top")].edges)
      for (int a = 0; a < edge.node_count; ++a)
        constraints.value.segment<2>(2 * edge.nodes[a]) = displacement(mesh.nodes.row(edge.nodes[a]), upper_body);

  const Curve upper = contact_curve(mesh, boundary_index(mesh, "upper_contact"));
  const Curve lower = contact_curve(mesh, boundary_index(mesh, "lower_contact"));
  ContactInterface interface {
    which.multipliers_on_lower ? lower : upper, which.multipliers_on_lower ? upper : lower, {}, {}, {}
  };
  interface.geometry = {ContactLine(mesh.nodes, interface.multiplier), ContactLine(mesh.nodes, interface.opposite),
                        which.normals == Normals::curve};
  interface.points = contact_points(mesh.nodes, interface, which.integration);
  interface.coupling = couple(mesh, interface, constraints, {which.multipliers, InitialGap::closed});
  const Coupling& coupling = interface.coupling;
  const VecX g = -coupling.gap0;
  const Solution s = solve_directly({.K = K,
                                     .f = load,
                                     .constraints = constraints,
                                     .stiffness_scale = exact.young,
                                     .grounded = {},
                                     .B = coupling.B,
                                     .g = g,
                                     .row_scale = coupling.scale,
                                     .unilateral = {},
                                     .start = {}});
  if (s.status != SolveStatus::converged) throw std::runtime_error("manufactured case not solved");
  const FieldErrors e = field_errors(mesh, laws, s.u, {displacement, stress});
  const BodyPoints points = body_points(mesh);
  const StressPatches patches = recover_patches(mesh, points, sample_stresses(mesh, laws, s.u));
  return {e.displacement, e.energy,
          pressure_error(mesh, exact, which.plates, interface, -multiplier_values(coupling, s.lambda)),
          std::sqrt(error_products(mesh, points, laws, {s.u, patches}, {}).products.sum())};
}

}  // namespace mortise::test
