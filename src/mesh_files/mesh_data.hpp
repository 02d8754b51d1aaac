// A mesh as files hold it, before it is put into bodies and boundaries: from gmsh's process and from our .msh reader
// alike.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace mortise {

/// Elements of one kind on one point, curve or surface.
struct ElementBlock {
  int dimension;                          ///< 0, 1 or 2
  int entity;                             ///< tag of the point, curve or surface
  int type;                               ///< gmsh's number of the kind, in element_type
  std::vector<int> groups;                ///< tags of the physical groups, > 0, each once
  std::vector<int> nodes;                 ///< rows of MeshData::nodes, as many an element as its kind has
  std::vector<EdgeSamples> samples = {};  ///< of each element of a named curve whose geometry is known
  std::string undrawn = {};               ///< as Boundary's
};

/// A physical point, curve or surface, with elements or without.
struct PhysicalGroup {
  int dimension;
  int tag;
  std::string name;  ///< may be empty
};

/// Blocks and groups of dimension 0, 1 and 2 only, in any order.
struct MeshData {
  std::string file;  ///< for messages
  std::vector<std::array<double, 3>> nodes;
  std::vector<PhysicalGroup> groups;
  std::vector<ElementBlock> blocks;
  std::vector<std::string> notes = {};  ///< as Mesh's
  bool named_by_tag = false;            ///< as Mesh's
};

/// Moves the nodes and the drawn curves.
void move(const Vec2& by, MeshData& data);

/// Rows of nodes or elements by their tags.
class TagRows {
 public:
  TagRows() = default;
  /// The tag of row i is tags[i].
  explicit TagRows(const std::vector<std::int64_t>& tags);
  /// The row, or -1 if none has that tag.
  int find(std::int64_t tag) const;

 private:
  std::vector<int> dense_;                            // by tag; of tags that leave few gaps
  std::vector<std::pair<std::int64_t, int>> by_tag_;  // sorted; of others
};

}  // namespace mortise
