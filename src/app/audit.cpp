#include "app/audit.hpp"

#include "app/audit_after.hpp"
#include "app/audit_before.hpp"

namespace mortise {

std::vector<std::string> audit_scene(const Scene& scene, const Mesh& mesh, const std::vector<ContactPair>& pairs) {
  refuse_double_loads(scene, mesh);
  const AuditedBodies bodies = audited_bodies(mesh, pairs);
  if (bodies.outline.pieces.size() < 2) return {};
  const std::vector<Encounter> found = encounters(bodies);
  LineOfBodies found_lines = overlap_lines(scene, bodies, found);
  found_lines.merge(meeting_lines(bodies, found));  // of two bodies the overlap speaks
  std::vector<std::string> lines;
  for (auto& [pair, line] : found_lines) lines.push_back(std::move(line));
  return lines;
}

std::vector<std::string> audit_solution(const Scene&, const Results& r) {
  if (r.status == Status::not_converged) return {};  // where the bodies are is not known
  if (r.mesh.bodies.size() < 2 && r.pairs.empty()) return {};
  const AuditedBodies bodies = audited_bodies(r.mesh, r.pairs);
  std::vector<std::string> lines = end_lines(bodies, r);
  const std::vector<std::string> crossings = crossing_lines(bodies, r);
  lines.insert(lines.end(), crossings.begin(), crossings.end());
  return lines;
}

}  // namespace mortise
