#include "mesh_files/inp_file.hpp"

#include <cstring>
#include <optional>

#include "mesh_files/element_types.hpp"
#include "mesh_files/inp_sets.hpp"

namespace mortise {
namespace {

/// gmsh's number of a kind of element: 0 of those that are left out, nothing of those that are not supported.
std::optional<int> type_of(const std::string& name) {
  for (const char* plane : {"CPS", "CPE", "CAX", "R3D", "M3D", "STRI", "S"})  // whatever their formulation
    if (name.starts_with(plane))
      if (const int type = deck_cell_type(name[std::strlen(plane)] - '0'); type != 0) return type;
  for (const char* straight : {"T2D2", "T3D2", "B21", "B31"})
    if (name.starts_with(straight)) return line_type(2);
  for (const char* curved : {"T2D3", "T3D3", "B22", "B32", "B33"})  // meshio calls any line of three nodes B33H
    if (name.starts_with(curved)) return line_type(3);
  for (const char* other : {"SPRING", "DASHPOT", "MASS", "ROTARYI", "GAP", "CONN", "DCOUP", "D", "R2D", "RAX", "SAX"})
    if (name.starts_with(other)) return 0;
  return std::nullopt;
}

class InpReader {
 public:
  explicit InpReader(const std::string& file) : deck_(file), cards_(read_inp_cards(deck_.input)) {}

  SetMesh read() {
    for (const InpCard& card : cards_) check(card);
    std::vector<OwnRows> own(cards_.size());
    for (std::size_t c = 0; c < cards_.size(); ++c) {
      if (cards_[c].name != "NODE") continue;
      own[c].first = int(deck_.mesh.nodes.size());
      read_nodes(cards_[c]);
      own[c].end = int(deck_.mesh.nodes.size());
    }
    deck_.number_nodes();
    for (std::size_t c = 0; c < cards_.size(); ++c) {
      if (cards_[c].name != "ELEMENT") continue;
      own[c].first = int(deck_.mesh.elements.size());
      read_elements(cards_[c]);
      own[c].end = int(deck_.mesh.elements.size());
    }
    deck_.number_elements();
    for (const auto& [name, count] : couplings_) deck_.leave_out(count, "card", "cards", name);
    InpSets sets(deck_);
    for (std::size_t c = 0; c < cards_.size(); ++c) sets.read(cards_[c], own[c]);
    sets.finish();
    return std::move(deck_.mesh);
  }

 private:
  /// What would make another mesh than the one that is read here.
  void check(const InpCard& card) {
    for (const char* maker : {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SUBMODEL"})
      if (card.name == maker) fail(deck_.input, card, "is not supported; expected all nodes and elements to be listed");
    if (card.name == "INCLUDE") {
      fail(deck_.input, card,
           "included files are not read; expected their text here, or mesh.file = the one with the mesh");
    }
    if (card.name == "SYSTEM" && !card.lines.empty())
      fail(deck_.input, card, "is not supported; expected nodes in x, y and z");
    for (const char* coupling : {"EQUATION", "MPC", "TIE", "RIGIDBODY", "COUPLING", "KINEMATICCOUPLING",
                                 "DISTRIBUTINGCOUPLING", "CYCLICSYMMETRYMODEL", "EMBEDDEDELEMENT"})
      if (card.name == coupling) ++couplings_["*" + card.name];
    if (card.name == "PART" && ++parts_ > 1)
      fail(deck_.input, card, "a second part; expected one, or a deck without parts");
    if (card.name != "INSTANCE") return;
    if (++instances_ > 1) fail(deck_.input, card, "a second instance; expected one, or a deck without parts");
    if (!card.lines.empty()) fail(deck_.input, card, "a part that is moved; expected its nodes where they are to be");
  }

  void read_nodes(const InpCard& card) {
    if (inp_key(parameter(card, "SYSTEM").value_or("R")) != "R" || card.parameters.contains("INPUT")) {
      fail(deck_.input, card, "SYSTEM and INPUT are not supported; expected x, y and z");
    }
    for (const DeckRecord& line : card.lines) {
      std::array<double, 3>& x = deck_.add_node(line);
      for (std::size_t i = 0; i < 3; ++i)
        if (const std::string field = line.field(i + 1); !field.empty()) x[i] = deck_.real(line, field, "a coordinate");
    }
  }

  void read_elements(const InpCard& card) {
    const std::string name = inp_key(parameter(card, "TYPE").value_or(""));
    const std::optional<int> type = type_of(name);
    if (!type || card.parameters.contains("INPUT")) {
      fail(deck_.input, card,
           (type ? "INPUT is not supported" : "TYPE=" + name + " is not supported") +
               "; expected CPS, CPE, CAX, or shells with 3, 4, 6 or 8 nodes, listed here");
    }
    const std::size_t first = deck_.mesh.elements.size();
    for (std::size_t i = 0; i < card.lines.size(); ++i) {
      SetElement& element = deck_.add_element(card.lines[i], *type);
      if (*type != 0) {
        read_element(card, i, element);
      } else {
        while (card.lines[i].goes_on && i + 1 < card.lines.size()) ++i;
      }
    }
    if (const std::size_t count = deck_.mesh.elements.size() - first; *type == 0 && count > 0)
      deck_.leave_out(int(count), "element of the kind", "elements of the kind", name);
  }

  /// From line `i` on, which is moved to the element's last.
  void read_element(const InpCard& card, std::size_t& i, SetElement& element) const {
    const std::size_t first = i, count = element_type(element.type)->node_count;
    for (std::size_t k = 1;; k = 0) {
      const DeckRecord& line = card.lines[i];
      for (; k < line.fields.size(); ++k) element.nodes.push_back(deck_.node(line, line.fields[k]));
      if (element.nodes.size() >= count || i + 1 == card.lines.size()) break;
      ++i;
    }
    if (element.nodes.size() != count) {
      deck_.fail(card.lines[first], "the element " + std::to_string(element.tag) + " has " +
                                        std::to_string(element.nodes.size()) + " nodes; expected " +
                                        std::to_string(count));
    }
  }

  Deck deck_;
  std::vector<InpCard> cards_;
  int parts_ = 0, instances_ = 0;
  std::map<std::string, int> couplings_;
};

}  // namespace

SetMesh read_inp(const std::string& file) { return InpReader(file).read(); }

}  // namespace mortise
