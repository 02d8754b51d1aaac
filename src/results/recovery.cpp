#include "results/recovery.hpp"

#include "base/parallel.hpp"
#include "solve/threads.hpp"

namespace mortise {

Recovery recover(const Problem& p, const std::vector<ContactNodes>& nodes, const Solution& solution) {
  const VecX& u = solution.u;
  Recovery r;
  r.stress = recover_stress(p.mesh, p.points, p.discretisation.laws, u);
  const SaddlePointSystem& s = p.discretisation.system;
  r.energy =
      strain_energy(p.discretisation, u, s.f - s.B.transpose() * solution.lambda - unbalanced_forces(s, solution));
  r.contacts.resize(p.pairs.size());
  const double displacement = largest_entry(u);
  for_each_index(p.pairs.size(), solver_threads(), [&](std::size_t k) {
    r.contacts[k] = contact_results(p, p.pairs[k], nodes[k], r.stress, solution, displacement);
  });
  r.probes = probe_values(p, u, r.stress);
  r.extremes = find_extremes(p.mesh, p.points, r.stress);
  r.reactions = find_reactions(p, solution);
  return r;
}

}  // namespace mortise
