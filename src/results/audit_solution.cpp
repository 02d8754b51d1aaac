#include "results/audit_solution.hpp"

#include "base/printable.hpp"

namespace mortise {

namespace {

// Found anew for twice the displacements where these are more than before.
const std::vector<EdgeAndPiece>& those_that_may_cross(AuditMemory& memory, double largest) {
  if (!(largest <= memory.up_to)) {
    memory.up_to = 2 * largest;
    memory.may_cross = may_cross(*memory.bodies, memory.up_to);
  }
  return memory.may_cross;
}

}  // namespace

std::vector<std::string> audit_solution(const Results& r) {
  AuditMemory& memory = *r.audited;
  memory.missed.clear();
  if (r.status == Status::not_converged) return {};  // where the bodies are is not known
  if (r.problem.mesh.bodies.size() < 2 && r.problem.pairs.empty()) return {};
  const bool known = memory.bodies && &memory.bodies->mesh == &r.problem.mesh;
  if (!known) {
    memory = {};
    memory.bodies = std::make_unique<const AuditedBodies>(audited_bodies(r.problem.mesh, r.problem.pairs));
  }
  std::vector<std::string> lines = end_lines(*memory.bodies, r);
  const auto* some = known ? &those_that_may_cross(memory, largest_entry(r.solution.u)) : nullptr;
  append_lines(lines, crossing_lines(*memory.bodies, r, some, memory.missed));
  append_lines(lines, drawn_overlap_lines(r));
  return lines;
}

}  // namespace mortise
