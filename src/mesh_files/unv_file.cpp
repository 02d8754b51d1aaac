#include "mesh_files/unv_file.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <sstream>

#include "mesh_files/element_types.hpp"
#include "mesh_files/inp_cards.hpp"

namespace mortise {
namespace {

/// gmsh's number of the kind of element that a finite-element descriptor names, 0 if it is left out. Corners and
/// middles of second order take turns.
int kind_of(std::int64_t descriptor) {
  if (descriptor == 11 || descriptor == 21 || descriptor == 22) return 1;
  if (descriptor == 23 || descriptor == 24) return 8;
  if (descriptor < 41 || descriptor > 95) return 0;
  static constexpr int by_last_digit[10] = {0, 2, 9, 0, 3, 16, 0, 0, 0, 0};
  return by_last_digit[descriptor % 10];  // of plane stress, plane strain, plates, membranes, rings, shells
}

bool is_beam(std::int64_t descriptor) { return descriptor == 11 || (descriptor >= 21 && descriptor <= 24); }

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
  explicit UnvReader(const std::string& file) : input_(file) { mesh_.file = file; }

  SetMesh read() {
    std::map<int, std::vector<std::vector<InpLine>>> datasets;
    std::string_view text;
    while (input_.next_line(text)) {
      if (text != "-1") input_.fail("expected -1, where a dataset begins; is this a universal file?");
      if (!input_.next_line(text)) break;
      int number = 0;
      std::from_chars(text.data(), text.data() + text.size(), number);
      std::vector<InpLine>& lines = datasets[number].emplace_back();
      bool ends = false;
      while (!ends && input_.next_line(text)) {
        ends = text == "-1";
        const bool wanted = number == 2411 || number == 781 || number == 2412 || entity_length(number) > 0;
        if (!ends && wanted) lines.push_back(line_of(text));
      }
      if (!ends) input_.fail("the dataset " + std::to_string(number) + " does not end; is the file cut off?");
    }
    for (const int number : {781, 2411})
      for (const auto& lines : datasets[number]) read_nodes(lines);
    NodeRows nodes = rows_of(node_tags_, "node"), elements({});
    for (const auto& lines : datasets[2412]) read_elements(lines, nodes);
    elements = rows_of(element_tags_, "element");
    for (const auto& [number, all] : datasets)
      for (const auto& lines : all) read_groups(lines, entity_length(number), nodes, elements);
    add_properties();
    return std::move(mesh_);
  }

 private:
  InpLine line_of(std::string_view text) const {
    InpLine line{input_.record(), {}, false};
    std::istringstream words{std::string(text)};
    for (std::string word; words >> word;) line.fields.push_back(word);
    return line;
  }

  /// The line that must be there; `at` moves on.
  const InpLine& next(const std::vector<InpLine>& lines, std::size_t& at, std::size_t fields) const {
    if (at == lines.size()) input_.fail_at(lines.back().record, "the dataset ends within a record");
    if (lines[at].fields.size() < fields)
      input_.fail_at(lines[at].record, "expected " + std::to_string(fields) + " numbers or more");
    return lines[at++];
  }

  void read_nodes(const std::vector<InpLine>& lines) {
    for (std::size_t i = 0; i < lines.size();) {
      const InpLine& head = next(lines, i, 1);
      node_tags_.push_back(inp_integer(input_, head, head.fields[0], "a node's number"));
      const InpLine& x = next(lines, i, 3);
      std::array<double, 3> place{};
      for (int k = 0; k < 3; ++k) place[k] = inp_real(input_, x, x.fields[k], "a coordinate");
      mesh_.nodes.push_back(place);
    }
  }

  void read_elements(const std::vector<InpLine>& lines, const NodeRows& rows) {
    for (std::size_t i = 0; i < lines.size();) {
      const InpLine& head = next(lines, i, 6);
      const auto number = [&](int k, const char* what) { return inp_integer(input_, head, head.fields[k], what); };
      const std::int64_t descriptor = number(1, "a finite-element descriptor"), count = number(5, "a number of nodes");
      const int type = kind_of(descriptor);
      const int expected = type != 0 ? element_type(type)->node_count : int(count);
      if (expected != count)
        input_.fail_at(head.record, "expected " + std::to_string(expected) + " nodes of an element of the kind " +
                                        head.fields[1] + ", found " + head.fields[5]);
      SetElement element{number(0, "an element's number"), type, {}};
      if (is_beam(descriptor)) next(lines, i, 1);
      while (std::int64_t(element.nodes.size()) < count) {
        const InpLine& line = next(lines, i, 1);
        for (const std::string& field : line.fields) {
          const int row = rows.find(inp_integer(input_, line, field, "a node's number"));
          if (row < 0) input_.fail_at(line.record, "there is no node " + field);
          element.nodes.push_back(row);
        }
      }
      if (std::int64_t(element.nodes.size()) > count) input_.fail_at(head.record, "has more nodes than it says");
      if (type == 0) ++left_out_[head.fields[1]];
      if (type == 8 || type == 9 || type == 16) corners_first(element.nodes);
      element_tags_.push_back(element.tag);
      int property = 0;
      std::from_chars(head.fields[2].data(), head.fields[2].data() + head.fields[2].size(), property);
      properties_.push_back(property);
      mesh_.elements.push_back(std::move(element));
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
  void read_groups(const std::vector<InpLine>& lines, std::size_t length, const NodeRows& nodes,
                   const NodeRows& elements) {
    for (std::size_t i = 0; length > 0 && i < lines.size();) {
      const InpLine& head = next(lines, i, 2);
      std::size_t count = 0;
      const std::string& last = head.fields.back();
      std::from_chars(last.data(), last.data() + last.size(), count);
      const std::string name = joined(next(lines, i, 0).fields);
      NamedSet of_nodes{name, {}}, of_elements{name, {}};
      std::vector<std::string> numbers;
      for (std::size_t done = 0; done < count;) {
        const InpLine& line = next(lines, i, length);
        for (std::size_t k = 0; k + length <= line.fields.size() && done < count; k += length, ++done) {
          const bool node = line.fields[k] == "7";
          if (!node && line.fields[k] != "8") continue;
          const int row = (node ? nodes : elements).find(inp_integer(input_, line, line.fields[k + 1], "a number"));
          if (row < 0 && node) input_.fail_at(line.record, "there is no node " + line.fields[k + 1]);
          if (row >= 0) (node ? of_nodes : of_elements).members.push_back(row);
        }
      }
      NamedSet& set = of_elements.members.empty() ? of_nodes : of_elements;
      std::ranges::sort(set.members);
      set.members.erase(std::unique(set.members.begin(), set.members.end()), set.members.end());
      if (!set.members.empty())
        (of_elements.members.empty() ? mesh_.node_sets : mesh_.element_sets).push_back(std::move(set));
    }
  }

  static std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
  }

  NodeRows rows_of(const std::vector<std::int64_t>& tags, const char* what) const {
    if (const std::int64_t repeated = first_repeated(tags); repeated >= 0)
      input_.fail_at(0, std::string("the ") + what + " " + std::to_string(tags[repeated]) + " is listed twice");
    return NodeRows(tags);
  }

  void add_properties() {
    for (const auto& [kind, count] : left_out_)
      mesh_.notes.push_back("left out: " + std::to_string(count) + " elements of the kind " + kind);
    add_property_sets(properties_, mesh_);
  }

  MshInput input_;
  SetMesh mesh_;
  std::vector<std::int64_t> node_tags_, element_tags_;
  std::vector<int> properties_;  // of each element
  std::map<std::string, int> left_out_;
};

}  // namespace

SetMesh read_unv(const std::string& file) { return UnvReader(file).read(); }

}  // namespace mortise
