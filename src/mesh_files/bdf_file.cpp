#include "mesh_files/bdf_file.hpp"

#include <algorithm>
#include <cctype>
#include <map>

#include "base/csv_fields.hpp"
#include "mesh_files/deck.hpp"
#include "mesh_files/element_types.hpp"

namespace mortise {
namespace {

bool begins_with_any(const std::string& name, std::initializer_list<const char*> beginnings) {
  return std::ranges::any_of(beginnings, [&](const char* beginning) { return name.starts_with(beginning); });
}

/// gmsh's number of the kind of element that an entry is, 0 of other entries.
int entry_type(const std::string& name) {
  static const std::map<std::string, int> nodes{
      {"CTRIA3", 3}, {"CTRIAR", 3}, {"CPLSTN3", 3}, {"CPLSTS3", 3}, {"CTRIA6", 6}, {"CPLSTN6", 6}, {"CPLSTS6", 6},
      {"CQUAD4", 4}, {"CQUADR", 4}, {"CPLSTN4", 4}, {"CPLSTS4", 4}, {"CQUAD8", 8}, {"CPLSTN8", 8}, {"CPLSTS8", 8}};
  if (name == "CBAR" || name == "CBEAM" || name == "CROD") return line_type(2);
  const auto found = nodes.find(name);
  return found == nodes.end() ? 0 : deck_cell_type(found->second);
}

bool is_solid(const std::string& name) {
  return begins_with_any(name, {"CHEXA", "CTETRA", "CPENTA", "CPYRAM", "CTRIAX", "CQUADX", "CQUAD", "CSHEAR"});
}

bool is_left_out(const std::string& name) {
  return begins_with_any(
      name, {"CELAS", "CBUSH", "CDAMP", "CMASS", "CONM", "CGAP", "CVISC", "CONROD", "CFAST", "RBE", "RBAR"});
}

/// The first one is the name, or the mark of a line that goes on; the mark at the end is left out.
std::vector<std::string> fields_of(const std::string& line) {
  if (line.find(',') != std::string::npos) {
    std::vector<std::string> fields = fields_between_commas(line);
    if (fields.size() > 9) fields.resize(9);
    return fields;
  }
  const std::string head = line.substr(0, 8);
  const bool wide = head.find('*') != std::string::npos;
  std::vector<std::string> fields{bare_field(head)};
  const std::size_t width = wide ? 16 : 8;
  for (std::size_t from = 8; from < std::min<std::size_t>(line.size(), 72); from += width)
    fields.push_back(bare_field(line.substr(from, width)));
  return fields;
}

/// Tabs go to the next multiple of eight.
std::string without_tabs(std::string_view line) {
  std::string text;
  for (const char c : line) {
    if (c != '\t')
      text += c;
    else
      text.append(8 - text.size() % 8, ' ');
  }
  return text;
}

/// Those before BEGIN BULK are no bulk data, and are known here by nothing.
std::vector<DeckRecord> read_entries(MshInput& input) {
  std::vector<DeckRecord> entries;
  std::string_view line;
  while (input.next_whole_line(line)) {
    const std::string text = without_tabs(line.substr(0, line.find_first_of("$\r")));
    if (text.find_first_not_of(' ') == std::string::npos) continue;
    const std::vector<std::string> fields = fields_of(text);
    std::string name = fields[0];
    if (name.empty() || name[0] == '+' || name[0] == '*') {
      if (entries.empty()) continue;
      std::vector<std::string>& all = entries.back().fields;
      all.resize((all.size() + 3) / 4 * 4);
      all.insert(all.end(), fields.begin() + 1, fields.end());
      continue;
    }
    if (name.back() == '*') name.pop_back();
    for (char& c : name) c = char(std::toupper(static_cast<unsigned char>(c)));
    if (name == "ENDDATA") break;
    entries.push_back({input.record(), {fields.begin() + 1, fields.end()}, name.substr(0, name.find(' '))});
  }
  return entries;
}

/// Whether a coordinate system is that of x, y and z.
bool is_basic(const std::string& system) { return system.empty() || system == "0"; }

void read_node(Deck& deck, const DeckRecord& entry) {
  if (const std::string system = entry.field(1); !is_basic(system))
    deck.fail(entry, "the coordinate system " + system + " is not supported; expected none, or 0");
  std::array<double, 3>& x = deck.add_node(entry);
  for (std::size_t k = 0; k < 3; ++k)
    if (const std::string field = entry.field(2 + k); !field.empty()) x[k] = deck.real(entry, field, "a coordinate");
}

/// Returns its property, -1 if it has none.
std::int64_t read_element(Deck& deck, const DeckRecord& entry) {
  SetElement& element = deck.add_element(entry, entry_type(entry.name));
  const std::string field = entry.field(1);
  const std::int64_t property = field.empty() ? -1 : deck.integer(entry, field, "a property's number");
  for (int k = 0; k < element_type(element.type)->node_count; ++k)
    element.nodes.push_back(deck.node(entry, entry.field(2 + k)));
  return property;
}

}  // namespace

SetMesh read_bdf(const std::string& file) {
  Deck deck(file);
  deck.short_exponents = true;
  std::vector<DeckRecord> nodes, elements;
  std::map<std::string, int> left_out;
  for (DeckRecord& entry : read_entries(deck.input)) {
    if (entry.name[0] == '=')
      deck.input.fail_at(entry.place, "replicated entries are not read; expected each entry written out");
    if (entry.name == "GRDSET" && !is_basic(entry.field(1)))
      deck.input.fail_at(entry.place,
                         "GRDSET: the coordinate system " + entry.field(1) + " is not supported; expected none, or 0");
    if (entry.name == "INCLUDE")
      deck.input.fail_at(entry.place, "included files are not read; expected their text here");
    if (entry.name == "GRID")
      nodes.push_back(std::move(entry));
    else if (entry_type(entry.name) != 0)
      elements.push_back(std::move(entry));
    else if (is_solid(entry.name))
      deck.input.fail_at(entry.place, entry.name + " is not supported; expected CTRIA3, CQUAD4, CTRIA6, CQUAD8, " +
                                          "CPLSTN or CPLSTS");
    else if (is_left_out(entry.name))
      ++left_out[entry.name];
  }
  for (const DeckRecord& entry : nodes) read_node(deck, entry);
  deck.number_nodes();
  std::vector<std::int64_t> properties;
  for (const DeckRecord& entry : elements) {
    properties.push_back(read_element(deck, entry));
  }
  deck.number_elements();
  for (const auto& [name, count] : left_out) deck.leave_out(count, "entry", "entries", name);
  add_property_sets(properties, deck.mesh);
  return std::move(deck.mesh);
}

}  // namespace mortise
