#include "results/audit_solution.hpp"

namespace mortise {

std::vector<std::string> audit_solution(const Results& r) {
  if (r.status == Status::not_converged) return {};  // where the bodies are is not known
  if (r.problem.mesh.bodies.size() < 2 && r.problem.pairs.empty()) return {};
  const AuditedBodies bodies = audited_bodies(r.problem.mesh, r.problem.pairs);
  std::vector<std::string> lines = end_lines(bodies, r);
  const std::vector<std::string> crossings = crossing_lines(bodies, r);
  const std::vector<std::string> overlaps = drawn_overlap_lines(r);
  lines.insert(lines.end(), crossings.begin(), crossings.end());
  lines.insert(lines.end(), overlaps.begin(), overlaps.end());
  return lines;
}

}  // namespace mortise
