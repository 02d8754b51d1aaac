#include "mesh_files/unv_file.hpp"

#include <charconv>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "base/each_once.hpp"
#include "mesh_files/deck.hpp"
#include "mesh_files/element_types.hpp"

namespace mortise {
namespace {

bool is_beam(std::int64_t descriptor) { return descriptor == 11 || (descriptor >= 21 && descriptor <= 24); }

/// gmsh's number of the kind of element that a finite-element descriptor names, 0 if it is left out. Corners and
/// middles of second order take turns. `count`: of its nodes, which Salome's edges of second order have three of.
int kind_of(std::int64_t descriptor, std::int64_t count) {
  if (is_beam(descriptor)) return line_type(descriptor >= 23 || (descriptor == 22 && count == 3) ? 3 : 2);
  if (descriptor < 41 || descriptor > 95) return 0;
  static constexpr int nodes_by_last_digit[10] = {0, 3, 6, 0, 4, 8, 0, 0, 0, 0};
  return deck_cell_type(
      nodes_by_last_digit[descriptor % 10]);  // of plane stress, plane strain, plates, membranes, rings, shells
}

/// Integers of an entity in a dataset of groups; 0 of others.
std::size_t entity_length(int dataset) {
  for (const int wide : {2435, 2452, 2467, 2477})
    if (dataset == wide) return 4;
  for (const int narrow : {752, 2417, 2429, 2430, 2432})
    if (dataset == narrow) return 2;
  return 0;
}

class UnvReader {
 public:
  explicit UnvReader(const std::string& file) : deck_(file) {}

  SetMesh read() {
    read_datasets();
    for (const auto& lines : datasets_[2420]) read_systems(lines);
    for (const int number : {781, 2411})
      for (const auto& lines : datasets_[number]) read_nodes(lines);
    deck_.number_nodes();
    for (const auto& lines : datasets_[2412]) read_elements(lines);
    deck_.number_elements();
    for (const auto& [number, all] : datasets_)
      for (const auto& lines : all) read_groups(lines, entity_length(number));
    for (const auto& [kind, count] : left_out_)
      deck_.leave_out(count, "element of the kind", "elements of the kind", kind);
    add_property_sets(properties_, deck_.mesh);
    return std::move(deck_.mesh);
  }

 private:
  /// The lines of those that are wanted.
  void read_datasets() {
    MshInput& input = deck_.input;
    std::string_view text;
    while (input.next_line(text)) {
      if (text != "-1") input.fail("expected -1, where a dataset begins; is this a universal file?");
      if (!input.next_line(text)) break;
      int number = 0;
      std::from_chars(text.data(), text.data() + text.size(), number);
      const bool wanted =
          number == 2411 || number == 781 || number == 2412 || number == 2420 || entity_length(number) > 0;
      std::vector<DeckRecord>& lines = datasets_[number].emplace_back();
      bool ends = false;
      while (!ends && input.next_line(text)) {
        ends = text == "-1";
        if (!ends && wanted) lines.push_back({input.record(), words_of(text)});
      }
      if (!ends) input.fail("the dataset " + std::to_string(number) + " does not end; is the file cut off?");
    }
  }

  static std::vector<std::string> words_of(std::string_view text) {
    std::istringstream words{std::string(text)};
    return {std::istream_iterator<std::string>(words), {}};
  }

  /// The line that must be there; `at` moves on.
  const DeckRecord& next(const std::vector<DeckRecord>& lines, std::size_t& at, std::size_t fields) const {
    if (at == lines.size()) deck_.fail(lines.back(), "the dataset ends within a record");
    if (lines[at].fields.size() < fields)
      deck_.fail(lines[at], "expected " + std::to_string(fields) + " numbers or more");
    return lines[at++];
  }

  /// Coordinate systems: each has a label, a kind (0: Cartesian) and a colour, a name that may be blank, and four rows,
  /// its axes and its origin.
  void read_systems(const std::vector<DeckRecord>& lines) {
    std::string label;
    int row = 0;
    bool moves = false;
    for (const DeckRecord& line : lines) {
      if (line.fields.size() != 3) continue;
      if (line.fields[0].find('.') == std::string::npos) {
        label = line.fields[0];
        row = 0;
        moves = line.fields[1] != "0";
        continue;
      }
      for (int k = 0; k < 3; ++k) moves = moves || deck_.real(line, line.fields[k], "a coordinate") != (row == k);
      if (++row == 4 && moves) moving_systems_.insert(label);
    }
  }

  void read_nodes(const std::vector<DeckRecord>& lines) {
    for (std::size_t i = 0; i < lines.size();) {
      const DeckRecord& head = next(lines, i, 1);
      if (moving_systems_.contains(head.field(1)))
        deck_.fail(head, "the coordinate system " + head.field(1) + " is not supported; expected x, y and z");
      std::array<double, 3>& place = deck_.add_node(head);
      const DeckRecord& x = next(lines, i, 3);
      for (int k = 0; k < 3; ++k) place[k] = deck_.real(x, x.fields[k], "a coordinate");
    }
  }

  void read_elements(const std::vector<DeckRecord>& lines) {
    for (std::size_t i = 0; i < lines.size();) {
      const DeckRecord& head = next(lines, i, 6);
      const std::int64_t descriptor = deck_.integer(head, head.fields[1], "a finite-element descriptor");
      const std::int64_t count = deck_.integer(head, head.fields[5], "a number of nodes");
      const int type = kind_of(descriptor, count);
      if (type != 0 && element_type(type)->node_count != count)
        deck_.fail(head, "expected " + std::to_string(element_type(type)->node_count) +
                             " nodes of an element of the kind " + head.fields[1] + ", found " + head.fields[5] +
                             (count == 9 ? "; the format has no quadrilateral of 9 nodes: expected 8, or a .msh" : ""));
      std::vector<int>& nodes = deck_.add_element(head, type).nodes;
      if (is_beam(descriptor)) next(lines, i, 1);
      while (std::int64_t(nodes.size()) < count) {
        const DeckRecord& line = next(lines, i, 1);
        for (const std::string& field : line.fields) nodes.push_back(deck_.node(line, field));
      }
      if (std::int64_t(nodes.size()) > count) deck_.fail(head, "has more nodes than it says");
      if (type == 0) ++left_out_[head.fields[1]];
      if (count > 4 || type == line_type(3)) corners_first(nodes);
      int property = 0;
      std::from_chars(head.fields[2].data(), head.fields[2].data() + head.fields[2].size(), property);
      properties_.push_back(property);
    }
  }

  static void corners_first(std::vector<int>& nodes) {
    std::vector<int> ordered;
    for (const std::size_t first : {0, 1})
      for (std::size_t i = first; i < nodes.size(); i += 2) ordered.push_back(nodes[i]);
    nodes = ordered;
  }

  /// A head, whose last number counts the entities, a name, and the entities: of each what it is (7: a node, 8: an
  /// element) and its number first. Elements that are not there are gmsh's of points, beside which the node stands;
  /// nodes beside elements are those of these.
  void read_groups(const std::vector<DeckRecord>& lines, std::size_t length) {
    for (std::size_t i = 0; length > 0 && i < lines.size();) {
      const DeckRecord& head = next(lines, i, 2);
      std::size_t count = 0;
      const std::string& last = head.fields.back();
      std::from_chars(last.data(), last.data() + last.size(), count);
      const std::string name = joined(next(lines, i, 0).fields);
      NamedSet of_nodes{name, {}}, of_elements{name, {}};
      for (std::size_t done = 0; done < count;) {
        const DeckRecord& line = next(lines, i, length);
        for (std::size_t k = 0; k + length <= line.fields.size() && done < count; k += length, ++done) {
          const bool node = line.fields[k] == "7";
          if (!node && line.fields[k] != "8") continue;
          const std::string& tag = line.fields[k + 1];
          const int row = (node ? deck_.nodes : deck_.elements).find(deck_.integer(line, tag, "a number"));
          if (row < 0 && node) deck_.fail(line, "there is no node " + tag);
          if (row >= 0) (node ? of_nodes : of_elements).members.push_back(row);
        }
      }
      NamedSet& set = of_elements.members.empty() ? of_nodes : of_elements;
      keep_each_once(set.members);
      if (!set.members.empty())
        (of_elements.members.empty() ? deck_.mesh.node_sets : deck_.mesh.element_sets).push_back(std::move(set));
    }
  }

  static std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
  }

  Deck deck_;
  std::map<int, std::vector<std::vector<DeckRecord>>> datasets_;
  std::vector<std::int64_t> properties_;  // of each element
  std::map<std::string, int> left_out_;
  std::set<std::string> moving_systems_;  // labels of those that are not x, y and z
};

}  // namespace

SetMesh read_unv(const std::string& file) { return UnvReader(file).read(); }

}  // namespace mortise
