#include "app/audit.hpp"

#include "app/audit_after.hpp"
#include "app/audit_before.hpp"

namespace mortise {

std::vector<std::string> audit_scene(const Scene& scene, const Mesh& mesh, const std::vector<ContactPair>& pairs) {
  refuse_double_loads(scene, mesh);
  const AuditedBodies bodies = audited_bodies(mesh, pairs);
  if (bodies.outline.pieces.size() < 2) return {};
  const std::vector<Encounter> found = encounters(bodies);
  std::vector<std::string> lines = overlap_lines(scene, bodies, found);
  const std::vector<std::string> meetings = meeting_lines(bodies, found);
  lines.insert(lines.end(), meetings.begin(), meetings.end());
  return lines;
}

std::vector<std::string> audit_solution(const Scene&, const Results& r) {
  if (r.mesh.bodies.size() < 2 && r.pairs.empty()) return {};
  const AuditedBodies bodies = audited_bodies(r.mesh, r.pairs);
  std::vector<std::string> lines = end_lines(bodies, r);
  const std::vector<std::string> crossings = crossing_lines(bodies, r);
  lines.insert(lines.end(), crossings.begin(), crossings.end());
  return lines;
}

}  // namespace mortise
