#include "app/diagnose.hpp"

#include <sstream>

#include "app/refusals.hpp"
#include "contact/pressure_norm.hpp"
#include "mesh/place.hpp"
#include "solve/inf_sup.hpp"

namespace mortise {
namespace {

// S of all pairs, each over its contact modulus E* (1 / E* = sum of the bodies' 1 / E').
SparseMatrix stacked_norm(const Scene& scene, const Results& r, const StackedCoupling& coupling) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < r.pairs.size(); ++k) {
    const ContactPair& pair = r.pairs[k];
    double compliance = 0;
    for (const Curve* side : {&pair.multiplier, &pair.opposite})
      compliance += 1 / contact_modulus(r.discretisation.laws[side->body]);
    const SparseMatrix S =
        pressure_norm(r.mesh.nodes, pair.multiplier, pair.points, scene.method.multipliers, pair.coupling);
    for (Eigen::Index j = 0; j < S.outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(S, j); it; ++it)
        entries.emplace_back(coupling.first_row[k] + int(it.row()), coupling.first_row[k] + int(it.col()),
                             compliance * it.value());
  }
  SparseMatrix all(coupling.gap0.size(), coupling.gap0.size());
  all.setFromTriplets(entries.begin(), entries.end());
  return all;
}

}  // namespace

void diagnose(const Scene& scene, Results& r) {
  if (r.pairs.empty()) return;
  const Discretisation& d = r.discretisation;
  const StackedCoupling coupling = stack(r.pairs, d.load.size());
  const Floating floating = find_floating(r.mesh, d.constraints);
  const ContactSystem system{d.stiffness,      coupling.B,     d.constraints.fixed,
                             largest_young(d), coupling.scale, floating.grounded};
  const InfSup found = inf_sup(system, stacked_norm(scene, r, coupling), r.active);
  if (found.mode.size() == 0) return;
  Eigen::Index worst = 0;
  found.mode.maxCoeff(&worst);
  r.inf_sup = InfSupReport{found.beta, r.mesh.nodes.row(row_nodes(r.pairs)[worst]).transpose()};
  if (found.beta >= inf_sup_limit) return;
  std::ostringstream text;
  text << "the inf-sup constant is " << found.beta << " (below " << inf_sup_limit
       << "): the meshes do not feel a pressure that swings " << near_point(r.inf_sup->position)
       << ", so p may be noise there; expected multipliers_on the other curve, or a finer mesh on the opposite one";
  r.notes.push_back(text.str());
}

}  // namespace mortise
