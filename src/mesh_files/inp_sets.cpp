#include "mesh_files/inp_sets.hpp"

#include <algorithm>

#include "base/each_once.hpp"

namespace mortise {
namespace {

bool is_entity_number(const std::string& field) {
  return !field.empty() && std::ranges::all_of(field, [](char c) { return c >= '0' && c <= '9'; });
}

// The number behind the name of an instance, or one that meshio writes as 12.0.
std::string member_tag(const std::string& field) {
  const std::size_t point = field.rfind('.');
  const bool real =
      point != std::string::npos && field.substr(point) == ".0" && is_entity_number(field.substr(0, point));
  return real ? field.substr(0, point) : field.substr(point + 1);
}

}  // namespace

InpSets::InpSets(Deck& deck)
    : deck_(deck),
      mesh_(deck.mesh),
      nodes_{"node", deck.nodes, deck.mesh.node_sets},
      elements_{"element", deck.elements, deck.mesh.element_sets} {}

NamedSet& InpSets::set_called(Sets& sets, const std::string& name) {
  const auto [found, is_new] = sets.by_key.emplace(inp_key(name), int(sets.sets.size()));
  if (is_new) sets.sets.push_back({name, {}});
  return sets.sets[found->second];
}

const NamedSet& InpSets::known_set(const Sets& sets, std::size_t place, const std::string& name) const {
  const auto found = sets.by_key.find(inp_key(name));
  if (found == sets.by_key.end()) {
    deck_.input.fail_at(place, std::string("there is no set of ") + sets.what + "s '" + name + "' before this line");
  }
  return sets.sets[found->second];
}

void InpSets::read(const InpCard& card, const OwnRows& own) {
  if (card.name == "NODE" || card.name == "NSET") {
    if (const auto name = parameter(card, "NSET")) read_set(card, own, nodes_, *name);
  } else if (card.name == "ELEMENT" || card.name == "ELSET") {
    if (const auto name = parameter(card, "ELSET")) read_set(card, own, elements_, *name);
  } else if (card.name == "SURFACE") {
    read_surface(card);
  } else if (card.name == "SOLIDSECTION") {
    read_section(card);
  }
}

void InpSets::read_set(const InpCard& card, const OwnRows& own, Sets& sets, const std::string& name) {
  if (name.empty()) fail(deck_.input, card, "the set has no name");
  if (name.starts_with("gmsh:")) return;  // meshio's, of what gmsh had, and no set
  std::vector<int>& members = set_called(sets, name).members;
  if (card.name == "NODE" || card.name == "ELEMENT") {
    for (int row = own.first; row < own.end; ++row) members.push_back(row);
    if (&sets == &elements_) made_.push_back(sets.by_key.at(inp_key(name)));
  } else {
    const bool generate = card.parameters.contains("GENERATE");
    for (const DeckRecord& line : card.lines)
      generate ? read_range(line, sets, members) : read_members(line, sets, members);
    if (&sets == &nodes_ && card.parameters.contains("ELSET")) {
      for (const int e : known_set(elements_, card.place, *parameter(card, "ELSET")).members)
        members.insert(members.end(), mesh_.elements[e].nodes.begin(), mesh_.elements[e].nodes.end());
    }
    // Names that a program made begin so: they name parts of surfaces.
    if (&sets == &elements_ && !name.starts_with('_')) listed_.push_back(sets.by_key.at(inp_key(name)));
  }
  keep_each_once(members);
}

void InpSets::read_range(const DeckRecord& line, const Sets& sets, std::vector<int>& members) const {
  if (line.fields.size() < 2) deck_.fail(line, "expected the first number, the last and the step");
  const std::int64_t first = deck_.integer(line, line.fields[0], "the first number");
  const std::int64_t last = deck_.integer(line, line.fields[1], "the last number");
  const std::int64_t step = line.fields.size() > 2 ? deck_.integer(line, line.fields[2], "the step") : 1;
  constexpr std::int64_t most = 10'000'000;
  if (last < first || (last - first) / step > most) {
    deck_.fail(line, "expected a last number from the first on, and at most " + std::to_string(most) + " numbers");
  }
  for (std::int64_t tag = first; tag <= last; tag += step)
    if (const int row = sets.rows.find(tag); row >= 0) members.push_back(row);
}

void InpSets::read_members(const DeckRecord& line, const Sets& sets, std::vector<int>& members) const {
  for (const std::string& field : line.fields) {
    if (field.empty()) continue;
    const std::string tag = member_tag(field);
    if (!is_entity_number(tag)) {
      const std::vector<int> others = known_set(sets, line.place, field).members;
      members.insert(members.end(), others.begin(), others.end());
      keep_each_once(members);
      continue;
    }
    const int row = sets.rows.find(deck_.integer(line, tag, "a number"));
    if (row < 0) deck_.fail(line, std::string("there is no ") + sets.what + " " + tag);
    members.push_back(row);
  }
}

void InpSets::read_surface(const InpCard& card) {
  const std::string name = parameter(card, "NAME").value_or("");
  if (name.empty()) fail(deck_.input, card, "expected NAME=");
  const std::string type = inp_key(parameter(card, "TYPE").value_or("ELEMENT"));
  if (type == "NODE") {
    std::vector<int>& members = set_called(nodes_, name).members;
    for (const DeckRecord& line : card.lines)
      read_members({line.place, {line.fields.begin(), line.fields.begin() + !line.fields.empty()}}, nodes_, members);
    return keep_each_once(members);
  }
  if (type != "ELEMENT") return mesh_.notes.push_back("left out: the surface " + name + " of TYPE=" + type);
  SideSet sides{name, {}, {}};
  for (const DeckRecord& line : card.lines) {
    std::vector<int> cells;
    read_members({line.place, {line.fields.at(0)}}, elements_, cells);
    add_faces(line, cells, sides);
  }
  if (!surfaces_.insert(inp_key(name)).second) fail(deck_.input, card, "a second surface '" + name + "'");
  mesh_.sides.push_back(std::move(sides));
}

/// S1 is the side between the first two nodes; without a face all sides on the boundary count.
void InpSets::add_faces(const DeckRecord& line, const std::vector<int>& cells, SideSet& sides) const {
  if (line.fields.size() < 2) {
    sides.cells.insert(sides.cells.end(), cells.begin(), cells.end());
    return;
  }
  const std::string face = inp_key(line.fields[1]);
  for (const int e : cells) {
    const SetElement& cell = mesh_.elements[e];
    const int corners = is_cell(cell) ? corners_of(cell) : 0;
    const int side = face.size() == 2 && face[0] == 'S' ? face[1] - '1' : -1;
    if (corners == 0)
      deck_.fail(
          line, "the element " + std::to_string(cell.tag) + " is of a kind that is left out; expected CPS, CPE or CAX");
    if (side < 0 || side >= corners) {
      deck_.fail(line, "the element " + std::to_string(cell.tag) + " has no face '" + face + "'; expected S1 to S" +
                           std::to_string(corners));
    }
    sides.ends.push_back({cell.nodes[side], cell.nodes[(side + 1) % corners]});
  }
}

void InpSets::read_section(const InpCard& card) {
  const std::string name = parameter(card, "ELSET").value_or("");
  if (name.empty()) fail(deck_.input, card, "expected ELSET=");
  const int set = int(&known_set(elements_, card.place, name) - mesh_.element_sets.data());
  if (std::ranges::find(mesh_.bodies, set) == mesh_.bodies.end()) mesh_.bodies.push_back(set);
}

void InpSets::finish() {
  for (std::vector<int>* sets : {&listed_, &made_}) {
    keep_each_once(*sets);
    std::erase_if(*sets, [&](int set) {
      return std::ranges::none_of(mesh_.element_sets[set].members, [&](int e) { return is_cell(mesh_.elements[e]); });
    });
    if (!sets->empty()) mesh_.candidates.push_back(std::move(*sets));
  }
}

}  // namespace mortise
