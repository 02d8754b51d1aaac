#include "problem/audit.hpp"

#include "problem/audit_lines.hpp"

namespace mortise {
namespace {

// Meant where a ring closes, and of a crack, whose faces meet at its tip; more often two names were taken for one
// another.
std::vector<std::string> self_contact_lines(const Mesh& mesh, const std::vector<ContactPair>& pairs) {
  std::vector<std::string> lines;
  for (const ContactPair& pair : pairs)
    if (pair.multiplier.body == pair.opposite.body && !meet_at_a_tip(pair.multiplier, pair.opposite))
      lines.push_back(pair.spec.key + ": '" + pair.spec.between[0] + "' and '" + pair.spec.between[1] +
                      "' are both curves of body '" + mesh.bodies[pair.multiplier.body] +
                      "', which is in contact with itself there");
  return lines;
}

}  // namespace

std::vector<std::string> audit(const Mesh& mesh, const std::vector<BoundaryEntry>& entries,
                               const std::vector<ContactPair>& pairs) {
  refuse_double_loads(mesh, entries);
  std::vector<std::string> lines = self_contact_lines(mesh, pairs);
  const AuditedBodies bodies = audited_bodies(mesh, pairs);
  if (bodies.outline.pieces.size() < 2) return lines;
  const std::vector<Encounter> found = encounters(bodies);
  LineOfBodies found_lines = overlap_lines(bodies, found);
  found_lines.merge(meeting_lines(bodies, found));  // of two bodies the overlap speaks
  for (auto& [pair, line] : found_lines) lines.push_back(std::move(line));
  return lines;
}

}  // namespace mortise
