#include "results/audit_solution.hpp"

#include "base/printable.hpp"

namespace mortise {

std::vector<std::string> audit_solution(const Results& r) {
  if (r.status == Status::not_converged) return {};  // where the bodies are is not known
  if (r.problem.mesh.bodies.size() < 2 && r.problem.pairs.empty()) return {};
  const AuditedBodies bodies = audited_bodies(r.problem.mesh, r.problem.pairs);
  std::vector<std::string> lines = end_lines(bodies, r);
  append_lines(lines, crossing_lines(bodies, r));
  append_lines(lines, drawn_overlap_lines(r));
  return lines;
}

}  // namespace mortise
