#include "contact/gap_steps.hpp"

#include <algorithm>
#include <cmath>

#include "fem/edges.hpp"

namespace mortise {
namespace {

constexpr double least_step = 0.02;  // of the edge: displacements beyond are told of (results/large_displacement.cpp)
constexpr double one_direction = 1e-6;  // radians: of normals on both sides of a place of a smooth line

class Steps {
 public:
  Steps(const Points& nodes, const ContactInterface& interface, const std::vector<Segment>& segments)
      : nodes_(nodes), interface_(interface), segments_(segments) {}

  // The segment next to one by 1 or -1 that begins where it ends; -1 if there is none.
  int beside(int k, int step) const {
    const int count = int(segments_.size()), edges = int(interface_.multiplier.edges.size());
    const bool closed = interface_.multiplier.closed;
    int next = k + step;
    if (closed) next = (next + count) % count;
    if (next < 0 || next >= count || next == k) return -1;
    const Segment &first = segments_[step > 0 ? k : next], &second = segments_[step > 0 ? next : k];
    if (first.edge == second.edge) return std::abs(first.end - second.begin) < projection_tolerance ? next : -1;
    const bool follows = closed ? (first.edge + 1) % edges == second.edge : first.edge + 1 == second.edge;
    return follows && first.end == 1 && second.begin == -1 ? next : -1;
  }

  // By how much the gap rises from a segment to the one behind it, length; 0 where it is no step.
  double step(int k, int behind) const {
    const Segment &first = segments_[k], &second = segments_[behind];
    const Line before = line(first.edge, first.end), after = line(second.edge, second.begin);
    if ((before.n - after.n).norm() > one_direction) return 0;
    const auto from = project_onto_edge(nodes_, interface_.opposite, first.opposite_edge, before),
               to = project_onto_edge(nodes_, interface_.opposite, second.opposite_edge, after);
    if (!from || !to) return 0;
    const double rise = to->distance - from->distance;
    return std::abs(rise) > least_step * length(rise > 0 ? first.edge : second.edge) ? rise : 0;
  }

  // Whether two edges have a vertex in common.
  bool touch(int one, int other) const {
    const int apart = std::abs(one - other), edges = int(interface_.multiplier.edges.size());
    return apart <= 1 || (interface_.multiplier.closed && apart == edges - 1);
  }

 private:
  Line line(int edge, double xi) const {
    return interface_.geometry.line_from(nodes_, interface_.multiplier, {edge, xi});
  }
  double length(int edge) const { return edge_length(nodes_, interface_.multiplier.edges[edge]); }

  const Points& nodes_;
  const ContactInterface& interface_;
  const std::vector<Segment>& segments_;
};

}  // namespace

std::vector<Segment> up_to_steps(const Points& nodes, const ContactInterface& interface,
                                 std::vector<Segment> segments) {
  if (interface.geometry.given) return segments;
  const Steps steps(nodes, interface, segments);
  std::vector<char> far(segments.size(), 0);
  for (int k = 0; k < int(segments.size()); ++k) {
    const int behind = steps.beside(k, 1);
    const double rise = behind < 0 ? 0 : steps.step(k, behind);
    if (rise == 0) continue;
    const int way = rise > 0 ? 1 : -1, near = rise > 0 ? k : behind;
    for (int i = rise > 0 ? behind : k; i >= 0 && steps.touch(segments[i].edge, segments[near].edge);) {
      far[i] = 1;
      const int next = steps.beside(i, way);
      if (next < 0 || next == near || steps.step(way > 0 ? i : next, way > 0 ? next : i) != 0) break;
      i = next;
    }
  }
  std::size_t at = 0;
  std::erase_if(segments, [&](const Segment&) { return far[at++] != 0; });
  return segments;
}

}  // namespace mortise
