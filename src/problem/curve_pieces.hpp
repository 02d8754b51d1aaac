// Curves that fall into pieces, as a surface interrupted by holes: each piece is a boundary of its own.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "mesh/side_table.hpp"
#include "model/contact_spec.hpp"
#include "problem/scene_names.hpp"

namespace mortise {

struct Scene;

/// Of each curve in contact that falls into pieces a boundary more for each, NAME_1, NAME_2 from left to right: pairs
/// are those of pieces that face each other.
void add_pieces(const Scene& scene, Mesh& mesh);

/// The boundaries that the sides of entries are.
class EntrySides {
 public:
  explicit EntrySides(const Mesh& mesh);

  /// Of both sides, by number; of a boundary that has pieces these, but for what is of one chain. Throws SceneError for
  /// unknown names.
  std::array<std::vector<int>, 2> of(const ContactSpec& spec) const;

 private:
  SceneNames names_;
  std::multimap<int, int> pieces_;  // of a boundary
};

/// Whether all cells beside it are. A pattern may match boundaries of several bodies, as a support's, and means others.
bool is_of_one_body(const Mesh& mesh, int boundary, const SideTable& table);

}  // namespace mortise
