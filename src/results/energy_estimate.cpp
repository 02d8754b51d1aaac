#include "results/energy_estimate.hpp"

#include <cmath>
#include <sstream>

#include "base/printable.hpp"
#include "fem/patch_recovery.hpp"

namespace mortise {

EnergyEstimate estimate_energy_error(const Results& r) {
  const std::vector<ElasticLaw>& laws = r.discretisation.laws;
  const VecX& u = r.solution.u;
  const std::vector<StressPatch> patches = recover_patches(r.mesh, r.points, gauss_stresses(r.mesh, laws, u));
  const EnergyErrors found = energy_errors(r.mesh, r.points, laws, u, patches);
  EnergyEstimate estimate{.error = std::sqrt(found.errors.sum() / found.norm),
                          .density = found.errors.cwiseQuotient(found.areas),
                          .body = 0,
                          .part = 0,
                          .position = Vec2::Zero()};
  if (found.norm == 0) estimate.error = 0;  // no stress
  VecX of_body = VecX::Zero(r.mesh.bodies.size());
  for (std::size_t e = 0; e < r.mesh.cells.size(); ++e) of_body(r.mesh.cells[e].body) += found.errors(e);
  of_body.maxCoeff(&estimate.body);
  if (found.errors.sum() > 0) estimate.part = of_body(estimate.body) / found.errors.sum();
  double largest = -1;
  for (std::size_t e = 0; e < r.mesh.cells.size(); ++e) {
    const Cell& cell = r.mesh.cells[e];
    if (cell.body != estimate.body || !(found.errors(e) > largest)) continue;
    largest = found.errors(e);
    const int corners = corner_count(cell.kind);
    estimate.position.setZero();
    for (int a = 0; a < corners; ++a) estimate.position += r.mesh.nodes.row(cell.nodes[a]).transpose() / corners;
  }
  return estimate;
}

std::optional<std::string> energy_error_warning(const Mesh& mesh, const EnergyEstimate& estimate) {
  if (estimate.error <= energy_error_limit) return {};
  std::ostringstream text;
  text.precision(2);
  text << "the mesh is coarse: stresses are off by about " << 100 * estimate.error
       << " % in the energy norm, the most in body '" << mesh.bodies[estimate.body] << "' "
       << near_point(estimate.position) << "; expected a finer mesh there, or quadratic elements";
  return text.str();
}

}  // namespace mortise
