#include "mesh_files/inp_file.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <optional>

#include "mesh_files/element_types.hpp"
#include "mesh_files/inp_sets.hpp"

namespace mortise {
namespace {

/// gmsh's number of a kind of element: 0 of those that are left out, nothing of those that are not supported.
std::optional<int> type_of(const std::string& name) {
  for (const char* plane : {"CPS", "CPE", "CAX", "R3D", "M3D", "STRI", "S"}) {  // whatever their formulation
    static const std::map<char, int> of_nodes{{'3', 2}, {'4', 3}, {'6', 9}, {'8', 16}};
    if (!name.starts_with(plane)) continue;
    if (const auto found = of_nodes.find(name[std::strlen(plane)]); found != of_nodes.end()) return found->second;
  }
  for (const char* straight : {"T2D2", "T3D2", "B21", "B31"})
    if (name.starts_with(straight)) return 1;
  for (const char* curved : {"T2D3", "T3D3", "B22", "B32", "B33"})  // meshio calls any line of three nodes B33H
    if (name.starts_with(curved)) return 8;
  for (const char* other : {"SPRING", "DASHPOT", "MASS", "ROTARYI", "GAP", "CONN", "DCOUP", "D", "R2D", "RAX", "SAX"})
    if (name.starts_with(other)) return 0;
  return std::nullopt;
}

class InpReader {
 public:
  explicit InpReader(const std::string& file) : input_(file), cards_(read_inp_cards(input_)) { mesh_.file = file; }

  SetMesh read() {
    for (const InpCard& card : cards_) check(card);
    std::vector<OwnRows> own(cards_.size());
    for (std::size_t c = 0; c < cards_.size(); ++c) {
      if (cards_[c].name != "NODE") continue;
      own[c].first = int(mesh_.nodes.size());
      read_nodes(cards_[c]);
      own[c].end = int(mesh_.nodes.size());
    }
    number(node_tags_, node_records_, "node", node_rows_);
    for (std::size_t c = 0; c < cards_.size(); ++c) {
      if (cards_[c].name != "ELEMENT") continue;
      own[c].first = int(mesh_.elements.size());
      read_elements(cards_[c]);
      own[c].end = int(mesh_.elements.size());
    }
    number(element_tags_, element_records_, "element", element_rows_);
    InpSets sets(input_, *node_rows_, *element_rows_, mesh_);
    for (std::size_t c = 0; c < cards_.size(); ++c) sets.read(cards_[c], own[c]);
    sets.finish();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const InpCard& card, const std::string& trouble) const {
    input_.fail_at(card.record, "*" + card.name + ": " + trouble);
  }

  /// What would make another mesh than the one that is read here.
  void check(const InpCard& card) {
    for (const char* maker : {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SUBMODEL"})
      if (card.name == maker) fail(card, "is not supported; expected all nodes and elements to be listed");
    if (card.name == "INCLUDE") {
      fail(card, "included files are not read; expected their text here, or mesh.file = the one with the mesh");
    }
    if (card.name == "PART" && ++parts_ > 1) fail(card, "a second part; expected one, or a deck without parts");
    if (card.name != "INSTANCE") return;
    if (++instances_ > 1) fail(card, "a second instance; expected one, or a deck without parts");
    if (!card.lines.empty()) fail(card, "a part that is moved; expected its nodes where they are to be");
  }

  void read_nodes(const InpCard& card) {
    if (inp_key(parameter(card, "SYSTEM").value_or("R")) != "R" || card.parameters.contains("INPUT")) {
      fail(card, "SYSTEM and INPUT are not supported; expected x, y and z");
    }
    for (const InpLine& line : card.lines) {
      node_tags_.push_back(inp_integer(input_, line, line.fields[0], "a node's number"));
      node_records_.push_back(line.record);
      std::array<double, 3> x{};
      for (std::size_t i = 1; i < std::min<std::size_t>(line.fields.size(), 4); ++i)
        if (!line.fields[i].empty()) x[i - 1] = inp_real(input_, line, line.fields[i], "a coordinate");
      mesh_.nodes.push_back(x);
    }
  }

  void read_elements(const InpCard& card) {
    const std::string name = inp_key(parameter(card, "TYPE").value_or(""));
    const std::optional<int> type = type_of(name);
    if (!type || card.parameters.contains("INPUT")) {
      fail(card, (type ? "INPUT is not supported" : "TYPE=" + name + " is not supported") +
                     "; expected CPS, CPE, CAX, or shells with 3, 4, 6 or 8 nodes, listed here");
    }
    const std::size_t first = mesh_.elements.size();
    for (std::size_t i = 0; i < card.lines.size(); ++i) {
      element_tags_.push_back(inp_integer(input_, card.lines[i], card.lines[i].fields.at(0), "an element's number"));
      element_records_.push_back(card.lines[i].record);
      mesh_.elements.push_back({element_tags_.back(), *type, {}});
      if (*type != 0) {
        read_element(card, i);
      } else {
        while (card.lines[i].goes_on && i + 1 < card.lines.size()) ++i;
      }
    }
    if (const std::size_t count = mesh_.elements.size() - first; *type == 0 && count > 0) {
      mesh_.notes.push_back("left out: " + std::to_string(count) + " elements of the kind " + name);
    }
  }

  /// From line `i` on, which is moved to the element's last.
  void read_element(const InpCard& card, std::size_t& i) {
    SetElement& element = mesh_.elements.back();
    const std::size_t count = element_type(element.type)->node_count;
    for (std::size_t k = 1;; k = 0) {
      const InpLine& line = card.lines[i];
      for (; k < line.fields.size(); ++k) element.nodes.push_back(node(line, line.fields[k]));
      if (element.nodes.size() >= count || i + 1 == card.lines.size()) break;
      ++i;
    }
    if (element.nodes.size() != count) {
      input_.fail_at(element_records_.back(), "the element " + std::to_string(element.tag) + " has " +
                                                  std::to_string(element.nodes.size()) + " nodes; expected " +
                                                  std::to_string(count));
    }
  }

  int node(const InpLine& line, const std::string& field) const {
    const std::int64_t tag = inp_integer(input_, line, field, "a node's number");
    const int row = node_rows_->find(tag);
    if (row < 0) input_.fail_at(line.record, "there is no node " + std::to_string(tag));
    return row;
  }

  void number(const std::vector<std::int64_t>& tags, const std::vector<std::size_t>& records, const char* what,
              std::optional<NodeRows>& rows) const {
    if (const std::int64_t repeated = first_repeated(tags); repeated >= 0) {
      input_.fail_at(records[repeated],
                     std::string("the ") + what + " " + std::to_string(tags[repeated]) + " is listed twice");
    }
    rows.emplace(tags);
  }

  MshInput input_;
  std::vector<InpCard> cards_;
  SetMesh mesh_;
  std::vector<std::int64_t> node_tags_, element_tags_;
  std::vector<std::size_t> node_records_, element_records_;
  std::optional<NodeRows> node_rows_, element_rows_;
  int parts_ = 0, instances_ = 0;
};

}  // namespace

SetMesh read_inp(const std::string& file) { return InpReader(file).read(); }

}  // namespace mortise
