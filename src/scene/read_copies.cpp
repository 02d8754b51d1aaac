// [[copies]]
#include <algorithm>

#include "base/printable.hpp"
#include "model/patterns.hpp"
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

// [copies.grid] but for the count.
struct Grid {
  Vec2 step = Vec2::Zero(), start = Vec2::Zero();
  double shift = 0;
};

Keys grid_keys(Grid& grid) {
  return {
      required({"count", list_of(whole_number(1, most_copies).schema, 2, 2), "[columns, rows]"}, "[columns, rows]"),
      required(key("step", grid.step, a_pair(), "[x, y], from one to the next"),
               "[x, y], from one column and row to the next"),
      key("start", grid.start, a_pair(), "[x, y], how far the first is moved"),
      key("shift", grid.shift, a_number(), "how far every other row is moved along x"),
  };
}

std::vector<CopyPlace> read_grid(const Node& node) {
  Grid grid;
  read(node, grid_keys(grid));
  const Node &count = *find(node, "count"), &step = *find(node, "step");
  number_pair(count);
  const int columns = whole(count.items[0], 1, most_copies), rows = whole(count.items[1], 1, most_copies / columns);
  for (int k = 0; k < 2; ++k)
    if ((k == 0 ? columns : rows) > 1 && grid.step(k) == 0)
      fail(step.items[k], "expected a step other than 0, as there are several: they would lie on one another");
  std::vector<CopyPlace> places;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      places.push_back({i, j, 0, grid.start + Vec2(i * grid.step.x() + (j % 2) * grid.shift, j * grid.step.y())});
  return places;
}

std::vector<CopyPlace> read_places(const Node& node) {
  if (node.kind != Node::Kind::list || node.items.empty())
    fail_expected(node, "a list of places [[x, y], [x, y, degrees], ...]");
  std::vector<CopyPlace> places;
  for (const Node& item : node.items) {
    if (item.kind != Node::Kind::list || item.items.size() < 2 || item.items.size() > 3)
      fail_expected(item, "[x, y] or [x, y, degrees]");
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
    fail_expected(node, std::string("a name with * for the number of the copy, such as \"block_*\"") +
                            (grid ? " or \"block_*_*\"" : ""));
  if (printable(node.text) != node.text || node.text.find('"') != std::string::npos)
    fail_expected(node, "one line of text without quotation marks");
}

void read_entry(const Node& entry, Scene& scene) {
  CopiesEntry copies;
  read(entry, copies_keys(copies));
  const Node& what = exactly_one(entry, {"grid", "places", "ring"});
  const bool grid = what.name == "grid";
  const std::vector<CopyPlace> places = grid                    ? read_grid(what)
                                        : what.name == "places" ? read_places(what)
                                                                : read_ring(what);
  check_name(*find(entry, "name"), grid, places.size());
  if (const Node* centre = find(entry, "centre"); centre && grid)
    fail(*centre, "goes with places = [[x, y, degrees], ...] or ring, whose copies are turned");
  for (const CopyPlace& place : places)
    scene.copies.push_back({.key = locate(entry),
                            .body = copies.bodies[(place.i + place.j) % copies.bodies.size()],
                            .name = name_of(copies.name, grid, place),
                            .degrees = place.degrees,
                            .centre = copies.centre,
                            .shift = place.shift});
}

}  // namespace

Keys copies_keys(CopiesEntry& copies) {
  Grid grid;
  return {
      required(key("body", copies.bodies, some_names(),
                   "a body of the file, or a list of bodies that take turns: in a grid like the squares of a "
                   "chessboard. They have nodes of their own"),
               "a body of the mesh, or a list of them"),
      required(key("name", copies.name, a_name(),
                   "names of the copies, by a pattern: `*` is the number of the copy, from 0; of a grid its column and "
                   "row: `\"b_*\"` is `b_3_4`, as `\"b_*_*\"` is"),
               "the names of the copies, such as \"block_*\""),
      {"grid", object_of(grid_keys(grid)),
       "one of these three: `count = [columns, rows]`, `step = [x, y]` from one to the next; also `start = [x, y]`, "
       "how far the first one is moved, and `shift`, how far every other row is moved along x"},
      {"places", list_of(list_of(a_number().schema, 2, 3), 1),
       "`[[x, y], [x, y, degrees], ...]`: how far each is moved, having been turned (counter-clockwise)"},
      {"ring", whole_number(2, most_copies).schema,
       "2 or more: so many all round, each turned on by the same part of a full turn"},
      key("centre", copies.centre, a_pair(), "`[x, y]`, about which they are turned, as drawn", "`[0, 0]`"),
  };
}

void read_copies(const Node& root, Scene& scene) {
  for (const Node* entry : entries(root, "copies")) read_entry(*entry, scene);
}

}  // namespace mortise::scene_file
