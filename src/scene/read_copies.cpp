// [[copies]]
#include <algorithm>
#include <cmath>

#include "base/printable.hpp"
#include "model/patterns.hpp"
#include "scene/fail.hpp"
#include "scene/fields.hpp"
#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

constexpr int most_copies = 1000000;

// Where a copy stands: number i of a list, (i, j) of a grid.
struct CopyPlace {
  int i, j;
  double degrees;
  Vec2 shift;
};

std::vector<CopyPlace> read_grid(const Node& grid) {
  expect_keys(grid, {"count", "step", "start", "shift"});
  const Node& count = require(grid, "count", "[columns, rows]");
  const Node& step_node = require(grid, "step", "[x, y], from one column and row to the next");
  const Vec2 step = number_pair(step_node);
  number_pair(count);
  const int columns = whole(count.items[0], 1, most_copies), rows = whole(count.items[1], 1, most_copies / columns);
  for (int k = 0; k < 2; ++k)
    if ((k == 0 ? columns : rows) > 1 && step(k) == 0)
      fail(step_node.items[k], "expected a step other than 0, as there are several: they would lie on one another");
  const Node *start = find(grid, "start"), *shift = find(grid, "shift");
  const Vec2 from = start ? number_pair(*start) : Vec2::Zero();
  const double of_odd_rows = shift ? number(*shift) : 0;
  std::vector<CopyPlace> places;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      places.push_back({i, j, 0, from + Vec2(i * step.x() + (j % 2) * of_odd_rows, j * step.y())});
  return places;
}

std::vector<CopyPlace> read_places(const Node& node) {
  if (node.kind != Node::Kind::list || node.items.empty())
    fail(node, "expected a list of places [[x, y], [x, y, degrees], ...], found " + describe(node));
  std::vector<CopyPlace> places;
  for (const Node& item : node.items) {
    if (item.kind != Node::Kind::list || item.items.size() < 2 || item.items.size() > 3)
      fail(item, "expected [x, y] or [x, y, degrees], found " + describe(item));
    const double degrees = item.items.size() == 3 ? number(item.items[2]) : 0;
    places.push_back({int(places.size()), 0, degrees, Vec2(number(item.items[0]), number(item.items[1]))});
  }
  return places;
}

std::vector<CopyPlace> read_ring(const Node& node) {
  const int count = whole(node, 2, most_copies);
  std::vector<CopyPlace> places;
  for (int i = 0; i < count; ++i) places.push_back({i, 0, 360.0 * i / count, Vec2::Zero()});
  return places;
}

// The name of copy i: "roller_*" is "roller_i"; of a grid "block_*_*" is "block_i_j", as "block_*" is.
std::string name_of(const std::string& pattern, bool grid, const CopyPlace& place) {
  std::string name;
  const bool two = std::ranges::count(pattern, '*') == 2;
  const std::string i = std::to_string(place.i), j = std::to_string(place.j);
  bool first = true;
  for (const char letter : pattern) {
    if (letter != '*') {
      name += letter;
      continue;
    }
    name += two ? (first ? i : j) : grid ? i + "_" + j : i;
    first = false;
  }
  return name;
}

void check_name(const Node& node, bool grid, std::size_t count) {
  const auto stars = std::ranges::count(name(node), '*');
  if (stars > (grid ? 2 : 1) || (stars == 0 && count > 1))
    fail(node, std::string("expected a name with * for the number of the copy, such as \"block_*\"") +
                   (grid ? " or \"block_*_*\"" : "") + ", found " + describe(node));
  if (printable(node.text) != node.text || node.text.find('"') != std::string::npos)
    fail(node, "expected one line of text without quotation marks, found " + describe(node));
}

void read_entry(const Node& entry, Scene& scene) {
  expect_keys(entry, {"body", "name", "grid", "places", "ring", "centre"});
  const std::vector<const Node*> bodies = names(require(entry, "body", "a body of the mesh, or a list of them"));
  const Node& called = require(entry, "name", "the names of the copies, such as \"block_*\"");
  const Node& what = exactly_one(entry, {"grid", "places", "ring"});
  const bool grid = what.name == "grid";
  const std::vector<CopyPlace> places = grid                    ? read_grid(what)
                                        : what.name == "places" ? read_places(what)
                                                                : read_ring(what);
  check_name(called, grid, places.size());
  const Node* centre = find(entry, "centre");
  if (centre && grid) fail(*centre, "goes with places = [[x, y, degrees], ...] or ring, whose copies are turned");
  const Vec2 about = centre ? number_pair(*centre) : Vec2::Zero();
  for (const CopyPlace& place : places)
    scene.copies.push_back({.key = locate(entry),
                            .body = bodies[(place.i + place.j) % bodies.size()]->text,
                            .name = name_of(called.text, grid, place),
                            .degrees = place.degrees,
                            .centre = about,
                            .shift = place.shift});
}

}  // namespace

void read_copies(const Node& root, Scene& scene) {
  for (const Node* entry : entries(root, "copies")) read_entry(*entry, scene);
}

}  // namespace mortise::scene_file
