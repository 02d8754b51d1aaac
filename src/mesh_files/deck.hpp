// Decks of other programs: records of fields, and the mesh that is gathered from them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesh_files/msh_input.hpp"
#include "mesh_files/set_mesh.hpp"
#include "mesh_files/tags.hpp"

namespace mortise {

/// What stands on one line, or on several that are one.
struct DeckRecord {
  std::size_t place;                ///< for MshInput::fail_at
  std::vector<std::string> fields;  ///< without blanks around them
  std::string name = {};            ///< for messages, of those that have one
  bool goes_on = false;             ///< ends in a comma

  /// Empty where there are fewer.
  std::string field(std::size_t k) const { return k < fields.size() ? fields[k] : ""; }
};

/// The text between the commas of a line.
std::vector<std::string> fields_between_commas(std::string_view line);

/// Functions that take a record throw InputError with its file and line.
struct Deck {
  explicit Deck(const std::string& file);

  [[noreturn]] void fail(const DeckRecord& record, const std::string& trouble) const;
  std::int64_t integer(const DeckRecord& record, const std::string& field, const char* what) const;
  /// The e of an exponent may be a d.
  double real(const DeckRecord& record, const std::string& field, const char* what) const;

  /// All nodes, then all elements.
  std::array<double, 3>& add_node(const DeckRecord& record);  ///< field 0 is its tag; the place is the caller's
  void number_nodes();
  /// Field 0 is its tag; `type` as SetElement's.
  SetElement& add_element(const DeckRecord& record, int type);
  void number_elements();
  /// Row of the node whose tag the field is.
  int node(const DeckRecord& record, const std::string& field) const;

  /// A note of what is not read: "left out: 2 KINDS NAME", or "1 KIND NAME".
  void leave_out(int count, const std::string& kind, const std::string& kinds, const std::string& name);

  MshInput input;
  SetMesh mesh;
  bool short_exponents = false;  ///< whether the e may be left out: 1.5-3
  TagRows nodes, elements;       ///< once they are numbered

 private:
  Tags node_tags_{"node"}, element_tags_{"element"};
};

}  // namespace mortise
