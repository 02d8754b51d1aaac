#include "results/diagnose.hpp"

#include "base/printable.hpp"
#include "contact/pressure_norm.hpp"
#include "solve/inf_sup.hpp"
#include "solve/multipoint_system.hpp"

namespace mortise {
namespace {

// S of all pairs, each over its contact modulus E* (1 / E* = sum of the bodies' 1 / E').
SparseMatrix stacked_norm(const Results& r) {
  Triplets entries;
  for (const ContactPair& pair : r.problem.pairs) {
    const std::vector<ElasticLaw>& laws = r.problem.discretisation.laws;
    const double compliance = 1 / contact_modulus(laws[pair.multiplier.body], laws[pair.opposite.body]);
    const SparseMatrix S = pressure_norm(r.problem.mesh.nodes, pair, r.problem.method.multipliers);
    for_each_entry(S, [&](int i, int j, double value) {
      entries.emplace_back(pair.first_row + i, pair.first_row + j, compliance * value);
    });
  }
  const Eigen::Index rows = r.problem.discretisation.system.B.rows();
  return filled(rows, rows, entries);
}

}  // namespace

std::optional<InfSupReport> inf_sup_report(const Results& r) {
  if (r.problem.pairs.empty()) return {};
  const SaddlePointSystem& system = r.problem.discretisation.system;
  const InfSup found =
      inf_sup(system.constraints.multipoint ? independent_system(system) : system, stacked_norm(r), r.solution.active);
  if (found.mode.size() == 0) return {};
  Eigen::Index worst = 0;
  found.mode.maxCoeff(&worst);
  return InfSupReport{found.beta, r.problem.mesh.nodes.row(row_nodes(r.problem.pairs)[worst]).transpose()};
}

std::optional<std::string> inf_sup_warning(const InfSupReport& report) {
  if (report.beta >= inf_sup_limit) return {};
  return worded(
      "the inf-sup constant is ", report.beta, " (below ", inf_sup_limit,
      "): the meshes do not feel a pressure that swings ", near_point(report.position),
      ", so p may be noise there; expected multipliers_on the other curve, or a finer mesh on the opposite one");
}

}  // namespace mortise
