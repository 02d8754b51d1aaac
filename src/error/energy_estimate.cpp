#include "error/energy_estimate.hpp"

#include <cmath>

namespace mortise {
namespace {

// What round-off of the displacements makes of stresses squared, over their stiffness.
double round_off_energy(const ErrorProducts& found, double stiffness_scale, const VecX& u) {
  const double strain = 1e-12 * largest_entry(u) / std::sqrt(found.areas.minCoeff());
  return stiffness_scale * strain * strain;
}

}  // namespace

EnergyEstimate energy_estimate(const Mesh& mesh, const ErrorProducts& found, double stiffness_scale, const VecX& u) {
  const VecX errors = found.products.col(0);
  EnergyEstimate estimate{.error = std::sqrt(errors.sum() / found.norms.sum()),
                          .density = errors.cwiseQuotient(found.areas),
                          .areas = found.areas,
                          .body = 0,
                          .part = 0,
                          .position = Vec2::Zero()};
  if (found.norms.sum() <= round_off_energy(found, stiffness_scale, u) * found.areas.sum())
    estimate.error = 0;  // no stress
  VecX of_body = VecX::Zero(Eigen::Index(mesh.bodies.size()));
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) of_body(mesh.cells[e].body) += errors(e);
  of_body.maxCoeff(&estimate.body);
  if (errors.sum() > 0) estimate.part = of_body(estimate.body) / errors.sum();
  double largest = -1;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const Cell& cell = mesh.cells[e];
    if (cell.body != estimate.body || !(errors(e) > largest)) continue;
    largest = errors(e);
    estimate.position = centre_of(mesh.nodes, cell);
  }
  return estimate;
}

}  // namespace mortise
