#include "problem/audit.hpp"

#include "problem/audit_lines.hpp"

namespace mortise {

std::vector<std::string> audit_scene(const Scene& scene, const Mesh& mesh, const std::vector<ContactPair>& pairs) {
  refuse_double_loads(scene, mesh);
  const AuditedBodies bodies = audited_bodies(mesh, pairs);
  if (bodies.outline.pieces.size() < 2) return {};
  const std::vector<Encounter> found = encounters(bodies);
  LineOfBodies found_lines = overlap_lines(bodies, found);
  found_lines.merge(meeting_lines(bodies, found));  // of two bodies the overlap speaks
  std::vector<std::string> lines;
  for (auto& [pair, line] : found_lines) lines.push_back(std::move(line));
  return lines;
}

}  // namespace mortise
