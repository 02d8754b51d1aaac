#include "results/contact_length.hpp"

#include <algorithm>

#include "fem/edges.hpp"

namespace mortise {
namespace {

// A vertex before the one at which p is last seen: how far before, and p^2 there.
struct Sample {
  double before, square;
};

// Where the least-squares line through the samples falls to zero, measured from the last loaded vertex on.
double end_of_contact(const std::vector<Sample>& samples, double limit) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const auto count = double(samples.size());
  for (const Sample& s : samples) {
    x -= s.before / count;
    y += s.square / count;
  }
  for (const Sample& s : samples) {
    xx += (-s.before - x) * (-s.before - x);
    xy += (-s.before - x) * (s.square - y);
  }
  return xy < 0 ? std::clamp(x - y * xx / xy, 0.0, limit) : limit;
}

struct LoadedLine {
  const Points& nodes;
  const ContactPair& pair;
  const VecX& pressure;  // or overlap
  const VecX& fluid;     // of it, at wet multipliers
  double loaded;         // p above it
  bool overlap = false;

  double solid(int multiplier) const { return pressure(multiplier) - fluid(multiplier); }
};

// Part of edge e that is in contact, where p ends on it: it carries p at vertex `last` (0: start, 1: end) only. Beyond
// fluid p rises from what that presses with.
double part_in_contact(const LoadedLine& line, int e, int last) {
  const auto& [nodes, pair, pressure, fluid, loaded, overlap] = line;
  const int count = int(pair.multiplier.edges.size()), back = last == 0 ? -1 : 1;  // away from the end of contact
  const double length = edge_length(nodes, pair.multiplier.edges[e]);
  const double outside = fluid(pair.coupling.on_edge[e][1 - last]);
  const double at_last = pressure(pair.coupling.on_edge[e][last]) - outside;
  if (overlap) return at_last / (at_last - pressure(pair.coupling.on_edge[e][1 - last]));
  std::vector<Sample> samples{{0, at_last * at_last}};
  double before = 0;
  for (int k = e + back; samples.size() < 3; k += back) {
    if (pair.multiplier.closed) k = (k + count) % count;
    if (k < 0 || k >= count) break;
    const double p = pressure(pair.coupling.on_edge[k][last]) - outside;
    if (!(p > loaded)) break;
    before += edge_length(nodes, pair.multiplier.edges[k]);
    samples.push_back({before, p * p});
  }
  return samples.size() > 1 ? end_of_contact(samples, length) / length : 1;
}

// Of an edge in contact the part, and whether that is its end rather than its start.
struct EdgePart {
  double part = 1;
  bool at_end = false;
};

std::vector<EdgePart> parts_in_contact(const LoadedLine& line) {
  const auto& [nodes, pair, pressure, fluid, loaded, overlap] = line;
  std::vector<EdgePart> parts(pair.multiplier.edges.size());
  if (pair.spec.condition != Condition::unilateral) return parts;
  for (std::size_t e = 0; e < parts.size(); ++e) {
    const auto& on = pair.coupling.on_edge[e];
    const bool start = line.solid(on[0]) > loaded, end = line.solid(on[1]) > loaded;
    if (!start && !end) parts[e].part = on[2] >= 0 && line.solid(on[2]) > loaded ? 1 : 0;
    if (start != end) parts[e] = {part_in_contact(line, int(e), start ? 0 : 1), end};
  }
  return parts;
}

ContactLength length_of(const LoadedLine& line) {
  const auto& [nodes, pair, pressure, fluid, loaded, overlap] = line;
  const std::vector<EdgePart> parts = parts_in_contact(line);
  ContactLength found;
  std::vector<char> faced(parts.size(), 0);
  for (const ContactPoint& c : pair.points) {
    found.length += c.ds * parts[c.edge].part;
    faced[c.edge] = 1;
  }
  double s = 0;
  for (std::size_t e = 0; e < parts.size(); ++e) {
    const double length = edge_length(nodes, pair.multiplier.edges[e]), part = parts[e].part * length;
    if (part > 0 && faced[e] && !pair.multiplier.closed) {
      const double from = parts[e].at_end ? s + length - part : s;
      found.ends = {found.ends ? (*found.ends)[0] : from, from + part};
    }
    s += length;
  }
  return found;
}

// Above round-off, of the values themselves too.
double loaded(double round_off, const VecX& values) {
  return std::max(round_off, 1e-9 * (values.size() > 0 ? values.maxCoeff() : 0));
}

}  // namespace

ContactLength length_in_contact(const Points& nodes, const ContactPair& pair, const VecX& pressure, const VecX& fluid,
                                double round_off) {
  return length_of({nodes, pair, pressure, fluid, loaded(round_off, pressure)});
}

ContactLength length_of_overlap(const Points& nodes, const ContactPair& pair, const VecX& overlap, double round_off) {
  return length_of({nodes, pair, overlap, VecX::Zero(overlap.size()), loaded(round_off, overlap), true});
}

}  // namespace mortise
