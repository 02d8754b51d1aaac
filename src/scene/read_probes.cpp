// [[probe]]
#include <algorithm>

#include "scene/fail.hpp"
#include "scene/fields.hpp"
#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

constexpr int most_points = 100000;

// One point [x, y], or a list of them.
std::vector<Vec2> read_points(const Node& at) {
  const bool many = at.kind == Node::Kind::list && !at.items.empty() &&
                    std::ranges::all_of(at.items, [](const Node& i) { return i.kind == Node::Kind::list; });
  if (!many) return {number_pair(at)};
  std::vector<Vec2> points;
  for (const Node& item : at.items) points.push_back(number_pair(item));
  return points;
}

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

void read_probes(const Node& root, Scene& scene) {
  for (const Node* entry : entries(root, "probe")) {
    expect_keys(*entry, {"at", "from", "to", "points", "body", "angle"});
    ProbeSpec probe;
    probe.key = locate(*entry);
    probe.line = exactly_one(*entry, {"at", "from"}).name == "from";
    for (const char* key : {"to", "points"})
      if (const Node* node = find(*entry, key); node && !probe.line) fail(*node, "goes with 'from', along a line");
    probe.at = probe.line ? read_line(*entry) : read_points(*find(*entry, "at"));
    if (const Node* body = find(*entry, "body")) probe.body = name(*body);
    if (const Node* angle = find(*entry, "angle")) probe.angle = number(*angle);
    scene.probes.push_back(probe);
  }
}

}  // namespace mortise::scene_file
