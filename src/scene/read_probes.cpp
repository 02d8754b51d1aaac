// [[probe]]
#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

constexpr int most_points = 100000;

std::vector<Vec2> read_line(const Node& entry) {
  const Node& end = require(entry, "to", "[x, y], where the line ends");
  const Vec2 from = number_pair(*find(entry, "from")), to = number_pair(end);
  const int count = whole(require(entry, "points", "how many points the line has, both ends included"), 2, most_points);
  if (from == to) fail(end, "the line has no length; expected another place than 'from'");
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) points.push_back(from + (to - from) * i / (count - 1));
  points.back() = to;
  return points;
}

}  // namespace

Keys probe_keys(ProbeSpec& probe) {
  const Json pair = a_pair().schema;
  return {
      {"at", either(pair, list_of(pair, 1)), "`[x, y]`, or a list of such: places in a body or on its boundary",
       "this, or `from`"},
      {"from", pair, "the start of a straight line"},
      {"to", pair, "its end", "required with `from`"},
      {"points", whole_number(2, most_points).schema, "how many places along it, both ends included",
       "required with `from`"},
      key("body", probe.body, a_name(),
          "the body (or a pattern) that has the places: needed on a contact line, where two have them", "the only one"),
      key("angle", probe.angle, a_number(), "of the axes of the stresses: degrees counter-clockwise from $x_1$"),
  };
}

void read_probes(const Node& root, Scene& scene) {
  for (const Node* entry : entries(root, "probe")) {
    ProbeSpec probe;
    read(*entry, probe_keys(probe));
    probe.key = locate(*entry);
    probe.line = exactly_one(*entry, {"at", "from"}).name == "from";
    for (const char* key : {"to", "points"})
      if (const Node* node = find(*entry, key); node && !probe.line) fail(*node, "goes with 'from', along a line");
    probe.at = probe.line ? read_line(*entry) : one_or_more_points(*find(*entry, "at"));
    scene.probes.push_back(probe);
  }
}

}  // namespace mortise::scene_file
