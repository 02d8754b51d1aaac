#include "mesh_files/set_mesh.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "base/errors.hpp"
#include "base/union_find.hpp"
#include "mesh_files/element_types.hpp"

namespace mortise {

bool is_cell(const SetElement& element) { return cell_kind(element.type).has_value(); }

int corners_of(const SetElement& cell) { return corner_count(*cell_kind(cell.type)); }

void add_property_sets(const std::vector<std::int64_t>& properties, SetMesh& mesh) {
  const auto line = [&](int e) { return is_line(mesh.elements[e].type); };
  std::vector<int> with_cells;
  bool curves = !mesh.node_sets.empty();
  for (int s = 0; s < int(mesh.element_sets.size()); ++s) {
    const std::vector<int>& members = mesh.element_sets[s].members;
    if (std::ranges::any_of(members, [&](int e) { return is_cell(mesh.elements[e]); })) with_cells.push_back(s);
    curves = curves || std::ranges::any_of(members, line);
  }
  std::map<std::pair<bool, std::int64_t>, std::vector<int>> sets;
  for (int e = 0; e < int(properties.size()); ++e)
    if (properties[e] >= 0 && (is_cell(mesh.elements[e]) || (line(e) && !curves)))
      sets[{line(e), properties[e]}].push_back(e);
  if (!with_cells.empty()) mesh.candidates.push_back(with_cells);
  std::vector<int> by_property;
  for (auto& [key, members] : sets) {
    const auto& [lines, property] = key;
    if (!lines) by_property.push_back(int(mesh.element_sets.size()));
    mesh.element_sets.push_back({(lines ? "curve_" : "surface_") + std::to_string(property), std::move(members)});
  }
  mesh.candidates.push_back(by_property);
  mesh.named_by_tag = !curves || with_cells.empty();
}

namespace {

/// A side of a cell, by its ends in rising order.
struct Side {
  int low, high, body;
  std::array<int, 3> nodes;  // as in Edge
  int cell;
  bool outer;  // no other cell of the body has it
};

bool ends_before(const Side& a, const Side& b) { return std::tie(a.low, a.high) < std::tie(b.low, b.high); }

// ---- Bodies ----

struct Bodies {
  std::vector<std::string> names;
  std::vector<int> of_element;  // -1 of those that are no cells
  bool named_by_tag = false;
};

/// Whether each cell is in exactly one of the sets; then `of_element` is set.
bool parts_the_cells(const SetMesh& mesh, const std::vector<int>& sets, std::vector<int>& of_element) {
  of_element.assign(mesh.elements.size(), -1);
  for (int s = 0; s < int(sets.size()); ++s)
    for (const int element : mesh.element_sets[sets[s]].members)
      if (is_cell(mesh.elements[element]) && std::exchange(of_element[element], s) >= 0) return false;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (is_cell(mesh.elements[e]) && of_element[e] < 0) return false;
  return true;
}

[[noreturn]] void fail_bodies(const SetMesh& mesh) {
  std::vector<int> body(mesh.elements.size(), -1);
  const auto name = [&](int s) { return "'" + mesh.element_sets[s].name + "'"; };
  for (const int s : mesh.bodies)
    for (const int e : mesh.element_sets[s].members)
      if (const int other = std::exchange(body[e], s); other >= 0 && is_cell(mesh.elements[e]))
        throw InputError(mesh.file + ": the element " + std::to_string(mesh.elements[e].tag) + " is in two bodies, " +
                         name(other) + " and " + name(s));
  for (std::size_t e = 0; e < body.size(); ++e)
    if (body[e] < 0 && is_cell(mesh.elements[e]))
      throw InputError(mesh.file + ": the element " + std::to_string(mesh.elements[e].tag) +
                       " is in no body; expected it in the set of a *SOLID SECTION");
  throw InputError(mesh.file + ": no bodies");
}

/// Cells with common nodes are of one part.
Bodies connected_parts(const SetMesh& mesh) {
  UnionFind nodes(mesh.nodes.size());
  for (const SetElement& element : mesh.elements)
    if (is_cell(element))
      for (const int node : element.nodes) nodes.join(node, element.nodes[0]);
  Bodies bodies{.names = {}, .of_element = std::vector<int>(mesh.elements.size(), -1), .named_by_tag = true};
  std::map<int, int> numbers;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (!is_cell(mesh.elements[e])) continue;
    const auto [number, starts] = numbers.emplace(nodes.find(mesh.elements[e].nodes[0]), int(numbers.size()));
    if (starts) bodies.names.push_back("surface_" + std::to_string(numbers.size()));
    bodies.of_element[e] = number->second;
  }
  return bodies;
}

/// Sets of parts that have no nodes in common become a body for each part.
Bodies divided(const SetMesh& mesh, const std::vector<int>& sets, const Bodies& whole) {
  const Bodies parts = connected_parts(mesh);
  std::vector<std::set<int>> parts_of(sets.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (whole.of_element[e] >= 0) parts_of[whole.of_element[e]].insert(parts.of_element[e]);
  Bodies bodies{.names = {}, .of_element = whole.of_element};
  std::map<std::pair<int, int>, int> numbers;  // by set and part
  for (int s = 0; s < int(sets.size()); ++s) {
    const std::string& name = mesh.element_sets[sets[s]].name;
    int count = 0;
    for (const int part : parts_of[s]) {
      numbers[{s, part}] = int(bodies.names.size());
      bodies.names.push_back(parts_of[s].size() == 1 ? name : name + "_" + std::to_string(++count));
    }
    bodies.named_by_tag = bodies.named_by_tag || count > 0;
  }
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (int& body = bodies.of_element[e]; body >= 0) body = numbers.at({body, parts.of_element[e]});
  return bodies;
}

Bodies bodies_of(const SetMesh& mesh) {
  std::vector<std::vector<int>> candidates = mesh.candidates;
  if (!mesh.bodies.empty()) candidates = {mesh.bodies};
  for (const std::vector<int>& sets : candidates) {
    Bodies whole;
    if (parts_the_cells(mesh, sets, whole.of_element)) return divided(mesh, sets, whole);
  }
  if (!mesh.bodies.empty()) fail_bodies(mesh);
  return connected_parts(mesh);
}

// ---- Sides ----

/// Of all cells, by their ends.
std::vector<Side> sides_of(const SetMesh& mesh, const Bodies& bodies) {
  std::vector<Side> sides;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const SetElement& cell = mesh.elements[e];
    if (!is_cell(cell)) continue;
    const int corners = corners_of(cell);
    for (int i = 0; i < corners; ++i) {
      const int a = cell.nodes[i], b = cell.nodes[(i + 1) % corners];
      const int middle = int(cell.nodes.size()) > corners ? cell.nodes[corners + i] : -1;
      sides.push_back({std::min(a, b), std::max(a, b), bodies.of_element[e], {a, b, middle}, int(e), true});
    }
  }
  std::stable_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.body) < std::tie(b.low, b.high, b.body);
  });
  for (std::size_t i = 1; i < sides.size(); ++i)
    if (!ends_before(sides[i - 1], sides[i]) && sides[i - 1].body == sides[i].body)
      sides[i - 1].outer = sides[i].outer = false;
  return sides;
}

/// Curves and points while they are gathered. Each keeps a side once.
class Curves {
 public:
  Curves(const SetMesh& mesh, const std::vector<Side>& sides, MeshData& data)
      : mesh_(mesh), sides_(sides), data_(data) {}

  void add(const SideSet& set) {
    std::vector<int> found;
    for (const auto& [a, b] : set.ends) add_side(a, b, found);
    std::vector<char> in(mesh_.elements.size(), 0);
    for (const int cell : set.cells) in[cell] = 1;
    for (int s = 0; !set.cells.empty() && s < int(sides_.size()); ++s)
      if (sides_[s].outer && in[sides_[s].cell]) found.push_back(s);
    add_curve(set.name, std::move(found));
  }

  /// The lines of a set of elements; of one with three nodes the second or the last is the middle one.
  void add_lines(const NamedSet& set) {
    std::vector<int> found;
    for (const int e : set.members)
      if (const SetElement& element = mesh_.elements[e]; is_line(element.type))
        for (std::size_t i = 1; i < element.nodes.size(); ++i) add_side(element.nodes[0], element.nodes[i], found);
    if (!found.empty()) add_curve(set.name, std::move(found));
  }

  void add_nodes(const NamedSet& set) {
    const auto has = [&](int node) { return node < 0 || std::ranges::binary_search(set.members, node); };
    std::vector<int> found;
    for (const int node : set.members)
      for (int s = first_side(node, -1); s < int(sides_.size()) && sides_[s].low == node; ++s)
        if (sides_[s].outer && has(sides_[s].high) && has(sides_[s].nodes[2])) found.push_back(s);
    if (found.empty()) return add_point(set);
    add_curve(set.name, std::move(found));
  }

 private:
  int first_side(int low, int high) const {
    const Side wanted{low, high, 0, {}, 0, true};
    return int(std::lower_bound(sides_.begin(), sides_.end(), wanted, ends_before) - sides_.begin());
  }

  void add_side(int a, int b, std::vector<int>& found) const {
    const auto [low, high] = std::minmax(a, b);
    const int s = first_side(low, high);
    if (s < int(sides_.size()) && sides_[s].low == low && sides_[s].high == high) found.push_back(s);
  }

  void add_curve(const std::string& name, std::vector<int> found) {
    std::ranges::sort(found);
    const auto same = [&](int a, int b) { return !ends_before(sides_[a], sides_[b]); };
    found.erase(std::unique(found.begin(), found.end(), same), found.end());
    // A set of nodes is often made beside a surface, with its name.
    if (const auto known = curves_.find(name); known != curves_.end() && known->second == found) return;
    curves_.emplace(name, found);
    const int tag = ++count_;
    data_.groups.push_back({1, tag, name});
    ElementBlock straight{1, tag, line_type(2), {tag}, {}}, quadratic{1, tag, line_type(3), {tag}, {}};
    for (const int s : found) {
      const auto& [a, b, middle] = sides_[s].nodes;
      ElementBlock& block = middle < 0 ? straight : quadratic;
      block.nodes.insert(block.nodes.end(), {a, b});
      if (middle >= 0) block.nodes.push_back(middle);
    }
    for (ElementBlock* block : {&straight, &quadratic})
      if (!block->nodes.empty()) data_.blocks.push_back(std::move(*block));
  }

  void add_point(const NamedSet& set) {
    const int tag = ++points_;
    data_.groups.push_back({0, tag, set.name});
    if (!set.members.empty()) data_.blocks.push_back({0, tag, point_type, {tag}, set.members});
  }

  const SetMesh& mesh_;
  const std::vector<Side>& sides_;
  MeshData& data_;
  std::map<std::string, std::vector<int>> curves_;
  int count_ = 0, points_ = 0;
};

void add_bodies(const SetMesh& mesh, const Bodies& bodies, MeshData& data) {
  for (int b = 0; b < int(bodies.names.size()); ++b) data.groups.push_back({2, b + 1, bodies.names[b]});
  std::map<std::pair<int, int>, ElementBlock> blocks;  // by body and kind
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const int body = bodies.of_element[e], type = mesh.elements[e].type;
    if (body < 0) continue;
    ElementBlock& block =
        blocks.try_emplace({body, type}, ElementBlock{2, body + 1, type, {body + 1}, {}}).first->second;
    block.nodes.insert(block.nodes.end(), mesh.elements[e].nodes.begin(), mesh.elements[e].nodes.end());
  }
  for (auto& [key, block] : blocks) data.blocks.push_back(std::move(block));
}

}  // namespace

MeshData data_of_sets(const SetMesh& mesh) {
  if (std::ranges::none_of(mesh.elements, is_cell)) throw InputError(mesh.file + ": no elements of plane bodies");
  MeshData data;
  data.file = mesh.file;
  data.nodes = mesh.nodes;
  data.notes = mesh.notes;
  const Bodies bodies = bodies_of(mesh);
  data.named_by_tag = bodies.named_by_tag || mesh.named_by_tag;
  add_bodies(mesh, bodies, data);
  const std::vector<Side> sides = sides_of(mesh, bodies);
  Curves curves(mesh, sides, data);
  for (const SideSet& set : mesh.sides) curves.add(set);
  for (const NamedSet& set : mesh.element_sets) curves.add_lines(set);
  for (const NamedSet& set : mesh.node_sets) curves.add_nodes(set);
  return data;
}

}  // namespace mortise
