#include <algorithm>
#include <array>
#include <sstream>

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "problem/audit_lines.hpp"

namespace mortise {
namespace {

// Two pieces that cover one another in part: what lies inside, seen from both.
struct Overlap {
  std::array<std::vector<int>, 2>
      edges;                    // of either piece: unpaired ones inside the other, and what is nearest to them
  double depth = 0;             // of those
  double deepest = 0;           // of all, in a pair or not
  double length = 0, area = 0;  // of all, the larger of both directions; the area if it is thin
};

// Runs of edges that hang together; a run in a contact pair with the other body, at least at its end, is meant.
std::vector<const Encounter*> unpaired_runs(const AuditedBodies& b, const std::vector<const Encounter*>& inside) {
  std::map<int, const Encounter*> by_edge;
  for (const Encounter* e : inside) by_edge[e->edge] = e;
  std::vector<const Encounter*> unpaired;
  while (!by_edge.empty()) {
    std::vector<const Encounter*> run{by_edge.begin()->second};
    by_edge.erase(by_edge.begin());
    bool is_paired = false;
    for (std::size_t i = 0; i < run.size(); ++i) {
      const int body = b.outline.pieces[run[i]->piece].body;
      is_paired = is_paired || paired_with_body(b, run[i]->edge, body);
      for (const int other : b.outline.neighbour[run[i]->edge]) {
        is_paired = is_paired || (other >= 0 && paired_with_body(b, other, body));
        const auto next = by_edge.find(other);
        if (next == by_edge.end()) continue;
        run.push_back(next->second);
        by_edge.erase(next);
      }
    }
    if (!is_paired) unpaired.insert(unpaired.end(), run.begin(), run.end());
  }
  return unpaired;
}

// What one piece, the first or the second, has inside the other.
void add_direction(const AuditedBodies& b, const std::vector<const Encounter*>& inside, int own, Overlap& overlap) {
  double length = 0, area = 0;
  for (const Encounter* e : inside) {
    length += e->inside;
    area += e->overlap;
    overlap.deepest = std::max(overlap.deepest, e->depth);
  }
  overlap.length = std::max(overlap.length, length);
  overlap.area = std::max(overlap.area, area);
  for (const Encounter* e : unpaired_runs(b, inside)) {
    overlap.edges[own].push_back(e->edge);
    overlap.edges[1 - own].insert(overlap.edges[1 - own].end(), e->facing.begin(), e->facing.end());
    overlap.depth = std::max(overlap.depth, e->depth);
  }
}

// Area of the first piece's cells whose centre lies in the second.
double covered_area(const AuditedBodies& b, int piece, int other) {
  double sum = 0;
  for (const int c : b.cells[piece]) {
    const Cell& cell = b.mesh.cells[c];
    const int corners = corner_count(cell.kind);
    Vec2 centre = Vec2::Zero();
    double area = 0;
    const Vec2 origin = b.mesh.nodes.row(cell.nodes[0]);
    for (int i = 0; i < corners; ++i) {
      const Vec2 x = b.mesh.nodes.row(cell.nodes[i]), y = b.mesh.nodes.row(cell.nodes[(i + 1) % corners]);
      centre += x / corners;
      area += ((x - origin).x() * (y - origin).y() - (x - origin).y() * (y - origin).x()) / 2;
    }
    if (b.outline.pieces[other].box.contains(centre) && nearest(b.outline, other, centre).distance < 0) sum += area;
  }
  return sum;
}

// What part of the smaller piece the larger one covers. Counted by cells only where it may be much.
double covered_part(const AuditedBodies& b, int first, int second, const Overlap& overlap) {
  const bool swap = b.outline.pieces[second].area < b.outline.pieces[first].area;
  const int small = swap ? second : first, large = swap ? first : second;
  const PieceOutline& piece = b.outline.pieces[small];
  const double thin = overlap.area / piece.area;
  return thin > 0.1 || overlap.length > 0.5 * piece.perimeter ? covered_area(b, small, large) / piece.area : thin;
}

// Of a strip its width.
double thickness(const PieceOutline& piece) { return 2 * piece.area / piece.perimeter; }

[[noreturn]] void refuse(const AuditedBodies& b, int first, int second, double depth, const Vec2& place) {
  std::ostringstream text;
  text << two_bodies(b.mesh, b.outline.pieces[first].body, b.outline.pieces[second].body)
       << " are drawn over one another";
  if (depth > 0) text << " by " << depth;
  text << " " << near_point(place)
       << ", too deep for contact to press apart; expected each place in at most one body (in a "
          ".geo: Translate moves one off the other, BooleanDifference cuts one out of the other; an interference fit "
          "is drawn touching, with a negative clearance)";
  throw SceneError(text.str());
}

std::string line(const AuditedBodies& b, const Overlap& overlap, int first, int second) {
  return worded(two_bodies(b.mesh, first, second), " are drawn into one another by ", overlap.depth, " ",
                near_point(middle_of(b, overlap.edges[0])), " (", name_of(b, overlap.edges[0]), ", ",
                name_of(b, overlap.edges[1]),
                "), and no contact pair presses them apart there: ", advice(b, overlap.edges[0], overlap.edges[1]),
                (first == second ? "" : " or draw them apart"));
}

}  // namespace

LineOfBodies overlap_lines(const AuditedBodies& b, const std::vector<Encounter>& encounters) {
  std::map<std::pair<int, int>, std::vector<const Encounter*>> directions;
  for (const Encounter& e : encounters)
    if (e.inside > 0) directions[{b.outline.edges[e.edge].piece, e.piece}].push_back(&e);
  std::map<std::pair<int, int>, Overlap> overlaps;
  for (const auto& [pieces, inside] : directions)
    add_direction(b, inside, pieces.first < pieces.second ? 0 : 1, overlaps[std::minmax(pieces.first, pieces.second)]);

  std::map<std::pair<int, int>, Overlap> by_body;  // the deepest
  for (const auto& [pieces, overlap] : overlaps) {
    const PieceOutline &first = b.outline.pieces[pieces.first], &second = b.outline.pieces[pieces.second];
    const double thin = std::min(thickness(first), thickness(second));
    const bool deep = (!overlap.edges[0].empty() && overlap.depth > thin / 4) || overlap.deepest > thin / 2;
    if (deep || covered_part(b, pieces.first, pieces.second, overlap) > 0.5) {
      const auto& inside = directions.count(pieces) ? directions[pieces] : directions[{pieces.second, pieces.first}];
      std::vector<int> edges;
      for (const Encounter* e : inside) edges.push_back(e->edge);
      refuse(b, pieces.first, pieces.second, overlap.deepest, middle_of(b, edges));
    }
    if (overlap.edges[0].empty() || overlap.depth == 0) continue;
    Overlap& deepest = by_body[std::minmax(first.body, second.body)];
    if (overlap.depth > (1 + 1e-6) * deepest.depth) deepest = overlap;
  }
  LineOfBodies lines;
  for (const auto& [bodies, overlap] : by_body) lines[bodies] = line(b, overlap, bodies.first, bodies.second);
  return lines;
}

}  // namespace mortise
