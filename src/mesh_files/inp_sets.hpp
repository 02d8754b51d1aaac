// The sets of a deck, card by card, for inp_file.cpp.
#pragma once

#include <set>

#include "mesh_files/inp_cards.hpp"

namespace mortise {

/// The nodes or elements that a *NODE or *ELEMENT card lists: rows from `first` to before `end`.
struct OwnRows {
  int first = 0, end = 0;
};

/// Names of a deck are the same in upper and lower case; the way in which they are first written is kept.
class InpSets {
 public:
  /// Of a deck whose nodes and elements are numbered.
  explicit InpSets(Deck& deck);
  /// *NODE and *ELEMENT (their own sets), *NSET, *ELSET, *SURFACE, *SOLID SECTION; passes over others.
  /// Throws InputError with file and line.
  void read(const InpCard& card, const OwnRows& own);
  /// Puts the sets into the mesh.
  void finish();

 private:
  struct Sets {
    const char* what;
    const TagRows& rows;
    std::vector<NamedSet>& sets;
    std::map<std::string, int> by_key = {};
  };

  NamedSet& set_called(Sets& sets, const std::string& name);
  const NamedSet& known_set(const Sets& sets, std::size_t place, const std::string& name) const;
  void read_set(const InpCard& card, const OwnRows& own, Sets& sets, const std::string& name);
  void read_range(const DeckRecord& line, const Sets& sets, std::vector<int>& members) const;
  void read_members(const DeckRecord& line, const Sets& sets, std::vector<int>& members) const;
  void read_surface(const InpCard& card);
  void add_faces(const DeckRecord& line, const std::vector<int>& cells, SideSet& sides) const;
  void read_section(const InpCard& card);

  const Deck& deck_;
  SetMesh& mesh_;
  Sets nodes_, elements_;
  std::vector<int> listed_, made_;  // element sets of *ELSET and of *ELEMENT, in their order
  std::set<std::string> surfaces_;
};

}  // namespace mortise
