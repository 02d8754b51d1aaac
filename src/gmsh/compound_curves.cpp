#include "gmsh/compound_curves.hpp"

#include <algorithm>
#include <limits>

#include "base/errors.hpp"
#include "base/printable.hpp"

namespace mortise {
namespace {

Vec2 place_of_row(const MeshData& data, int row) { return {data.nodes[row][0], data.nodes[row][1]}; }

std::string names_of(const MeshData& data, const std::vector<int>& groups) {
  std::string names;
  for (const PhysicalGroup& group : data.groups)
    if (group.dimension == 1 && std::ranges::count(groups, group.tag) > 0)
      names += (names.empty() ? "'" : ", '") + (group.name.empty() ? std::to_string(group.tag) : group.name) + "'";
  return names.empty() ? "none" : names;
}

std::vector<char> nodes_of_cells(const MeshData& data) {
  std::vector<char> used(data.nodes.size(), 0);
  for (const ElementBlock& block : data.blocks)
    if (block.dimension == 2)
      for (const int row : block.nodes) used[row] = 1;
  return used;
}

// That of the compounds which passes a place.
const ElementBlock& nearest(const MeshData& data, const std::vector<const ElementBlock*>& compounds, const Vec2& x) {
  const ElementBlock* found = compounds.front();
  double least = std::numeric_limits<double>::infinity();
  for (const ElementBlock* block : compounds)
    for (const int row : block->nodes)
      if (const double distance = (place_of_row(data, row) - x).norm(); distance < least) {
        least = distance;
        found = block;
      }
  return *found;
}

}  // namespace

void leave_compounds(const CompoundCurves& curves, MeshData& data) {
  if (curves.compounds.empty()) return;
  const std::vector<char> used = nodes_of_cells(data);
  const auto is_left = [&](const ElementBlock& block, const std::vector<int>& tags) {
    return block.dimension == 1 && std::ranges::count(tags, block.entity) > 0 &&
           std::ranges::any_of(block.nodes, [&](int row) { return !used[row]; });
  };
  std::erase_if(data.blocks, [&](const ElementBlock& block) { return is_left(block, curves.compounds); });
  std::vector<const ElementBlock*> compounds;
  for (const ElementBlock& block : data.blocks)
    if (block.dimension == 1 && std::ranges::count(curves.compounds, block.entity) > 0) compounds.push_back(&block);
  for (const ElementBlock& block : data.blocks) {
    if (compounds.empty() || !is_left(block, curves.members)) continue;
    const Vec2 middle = place_of_row(data, block.nodes[block.nodes.size() / 2]);
    const std::vector<int>& groups = nearest(data, compounds, middle).groups;
    if (groups != block.groups)
      throw InputError(data.file + ": Compound Curve with the curve " + std::to_string(block.entity) + " " +
                       near_point(middle) + ": gmsh has one mesh of all its curves, in physical curve " +
                       names_of(data, groups) + ", this curve is in " + names_of(data, block.groups) +
                       "; expected curves with the same names, or none that are compound");
  }
  std::erase_if(data.blocks, [&](const ElementBlock& block) { return is_left(block, curves.members); });
}

}  // namespace mortise
