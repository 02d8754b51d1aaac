#include "problem/audit.hpp"

#include <algorithm>

#include "base/printable.hpp"
#include "mesh/body_points.hpp"
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

bool have_a_pair(const SharedNodes& bodies, const std::vector<ContactPair>& pairs) {
  return std::ranges::any_of(pairs, [&](const ContactPair& pair) {
    return std::minmax(pair.multiplier.body, pair.opposite.body) == std::minmax(bodies.first, bodies.second);
  });
}

// Who cuts a bolt to stretch it has it in pieces that are one.
bool is_in_a_bolt(const SharedNodes& bodies, const std::vector<Tie>& ties) {
  return std::ranges::any_of(ties, [&](const Tie& tie) {
    return tie.pretension &&
           std::ranges::any_of(tie.body, [&](int body) { return body == bodies.first || body == bodies.second; });
  });
}

// One line, of the first two: who has cut all bodies out of one another has many.
std::vector<std::string> one_piece_lines(const Mesh& mesh, const Entries& entries,
                                         const std::vector<ContactPair>& pairs) {
  std::vector<SharedNodes> found = shared_nodes(mesh, body_points(mesh));
  std::erase_if(found, [&](const SharedNodes& bodies) {
    return entries.body(bodies.first).material != entries.body(bodies.second).material || have_a_pair(bodies, pairs) ||
           is_in_a_bolt(bodies, mesh.ties);
  });
  if (found.empty()) return {};
  const SharedNodes& first = found.front();
  return {
      "bodies '" + mesh.bodies[first.first] + "' and '" + mesh.bodies[first.second] + "' share " +
      (first.count > 1 ? std::to_string(first.count) + " nodes " : "a node ") + near_point(first.position) +
      (found.size() > 1 ? ", and so do " + std::to_string(found.size() - 1) + " more" : "") +
      ": they are one piece there; contact between them needs nodes of their own (in a .geo: a curve for each body, "
      "no BooleanFragments or Coherence)"};
}

}  // namespace

std::vector<std::string> audit(const Mesh& mesh, const Entries& entries, const std::vector<ContactPair>& pairs) {
  refuse_double_loads(mesh, entries.boundaries);
  std::vector<std::string> lines = self_contact_lines(mesh, pairs);
  append_lines(lines, one_piece_lines(mesh, entries, pairs));
  const AuditedBodies bodies = audited_bodies(mesh, pairs);
  if (bodies.outline.pieces.size() < 2) return lines;
  const std::vector<Encounter> found = encounters(bodies);
  LineOfBodies found_lines = overlap_lines(bodies, found);
  found_lines.merge(meeting_lines(bodies, found));  // of two bodies the overlap speaks
  for (auto& [pair, line] : found_lines) lines.push_back(std::move(line));
  return lines;
}

}  // namespace mortise
