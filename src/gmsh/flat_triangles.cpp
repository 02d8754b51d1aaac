#include "gmsh/flat_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/vectors.hpp"
#include "mesh_files/element_types.hpp"

namespace mortise {
namespace {

// Twice a triangle's area over its longest side squared: of the triangles that gmsh means to make it is above 1e-2,
// of its flat ones below 1e-10.
constexpr double flat = 1e-6;

// The triangles of a surface, corners first, then the middles of the sides after each corner if it has some.
class Triangles {
 public:
  Triangles(MeshData& data, ElementBlock& block)
      : nodes_(data.nodes), block_(block), count_(element_type(block.type)->node_count) {}

  void swap_flat() {
    std::vector<int> left;
    for (int t = 0; t < int(block_.nodes.size()) / count_; ++t)
      if (is_flat(t)) left.push_back(t);
    if (left.empty()) return;
    for (int t = 0; t < int(block_.nodes.size()) / count_; ++t) keep_sides(t);
    for (std::size_t before = left.size() + 1; left.size() < before;) {
      before = left.size();
      std::erase_if(left, [&](int t) { return !is_flat(t) || swap(t); });
    }
  }

 private:
  using Side = std::pair<int, int>;

  int& corner(int t, int i) { return block_.nodes[std::size_t(t) * count_ + i % 3]; }
  int& middle(int t, int i) { return block_.nodes[std::size_t(t) * count_ + 3 + i % 3]; }
  bool has_middles() const { return count_ == 6; }
  Vec2 at(int node) const { return Vec2(nodes_[node][0], nodes_[node][1]); }

  double length(int t, int i) { return (at(corner(t, i + 1)) - at(corner(t, i))).norm(); }
  int longest(int t) {
    int side = 0;
    for (int i = 1; i < 3; ++i)
      if (length(t, i) > length(t, side)) side = i;
    return side;
  }
  bool is_flat(int t) {
    const double area = cross(Vec2(at(corner(t, 1)) - at(corner(t, 0))), Vec2(at(corner(t, 2)) - at(corner(t, 0))));
    const double side = length(t, longest(t));
    return std::abs(area) < flat * side * side;
  }

  Side side(int t, int i) { return std::minmax(corner(t, i), corner(t, i + 1)); }
  void keep_sides(int t) {
    for (int i = 0; i < 3; ++i) by_side_[side(t, i)].push_back(t);
  }
  void forget_sides(int t) {
    for (int i = 0; i < 3; ++i) std::erase(by_side_[side(t, i)], t);
  }

  // Whether triangle t, flat, has one beyond its longest side that is not.
  bool swap(int t) {
    const int i = longest(t);
    const std::vector<int>& sharing = by_side_.at(side(t, i));
    const auto other = std::ranges::find_if(sharing, [&](int s) { return s != t && !is_flat(s); });
    if (other == sharing.end()) return false;
    const int beyond = *other;
    int j = 0;
    while (side(beyond, j) != side(t, i)) ++j;
    forget_sides(t);
    forget_sides(beyond);
    // Beyond runs from a to c to d; b, the middle corner, lies on a c.
    const int a = corner(beyond, j), c = corner(beyond, j + 1), d = corner(beyond, j + 2), b = corner(t, i + 2);
    const bool same_way = corner(t, i) == a;  // t may be listed either way round
    if (has_middles()) {
      const int ab = middle(t, same_way ? i + 2 : i + 1), bc = middle(t, same_way ? i + 1 : i + 2);
      const int bd = middle(t, i), cd = middle(beyond, j + 1), da = middle(beyond, j + 2);
      for (int k = 0; k < 3; ++k) nodes_[bd][k] = (nodes_[b][k] + nodes_[d][k]) / 2;
      set(t, {a, b, d}, {ab, bd, da});
      set(beyond, {b, c, d}, {bc, cd, bd});
    } else {
      set(t, {a, b, d}, {});
      set(beyond, {b, c, d}, {});
    }
    keep_sides(t);
    keep_sides(beyond);
    return true;
  }
  void set(int t, const std::array<int, 3>& corners, const std::array<int, 3>& middles) {
    for (int i = 0; i < 3; ++i) {
      corner(t, i) = corners[i];
      if (has_middles()) middle(t, i) = middles[i];
    }
  }

  std::vector<std::array<double, 3>>& nodes_;
  ElementBlock& block_;
  int count_;
  std::map<Side, std::vector<int>> by_side_;
};

}  // namespace

void swap_flat_triangles(MeshData& data) {
  for (ElementBlock& block : data.blocks)
    if (cell_kind(block.type) && corner_count(*cell_kind(block.type)) == 3) Triangles(data, block).swap_flat();
}

}  // namespace mortise
