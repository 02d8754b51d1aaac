#include "support/two_plates.hpp"

#include <map>

#include "fem/elements.hpp"

namespace mortise::test {
namespace {

// One plate, from (i, j) on a grid of half elements to a node.
class Plate {
 public:
  Plate(Mesh& mesh, std::vector<Vec2>& nodes, int body, int n, CellKind kind, std::function<Vec2(double, double)> map)
      : mesh_(mesh), nodes_(nodes), body_(body), n_(n), m_(std::max(1, int(0.375 * n + 0.5))), kind_(kind), map_(map) {}

  void add_cells() {
    for (int j = 0; j < m_; ++j)
      for (int i = 0; i < n_; ++i) {
        const int x = 2 * i, y = 2 * j;
        if (corner_count(kind_) == 4) {
          add({{{x, y},
                {x + 2, y},
                {x + 2, y + 2},
                {x, y + 2},
                {x + 1, y},
                {x + 2, y + 1},
                {x + 1, y + 2},
                {x, y + 1},
                {x + 1, y + 1}}});
        } else {
          add({{{x, y}, {x + 2, y}, {x + 2, y + 2}, {x + 1, y}, {x + 2, y + 1}, {x + 1, y + 1}}});
          add({{{x, y}, {x + 2, y + 2}, {x, y + 2}, {x + 1, y + 1}, {x + 1, y + 2}, {x, y + 1}}});
        }
      }
  }
  // Edges along j = 0 or m (across = false) or i = 0 or n.
  Boundary boundary(const std::string& name, bool across, bool far) {
    Boundary b{name, {}};
    const int count = across ? m_ : n_, at = far ? 2 * (across ? n_ : m_) : 0;
    for (int k = 0; k < count; ++k) {
      const auto node = [&](int along) { return across ? number(at, along) : number(along, at); };
      b.edges.push_back(
          {is_quadratic(kind_) ? 3 : 2, {node(2 * k), node(2 * k + 2), is_quadratic(kind_) ? node(2 * k + 1) : -1}});
    }
    return b;
  }

 private:
  using Grid = std::array<std::pair<int, int>, 9>;
  void add(const Grid& grid) {
    Cell cell{kind_, body_, {}};
    for (int a = 0; a < node_count(kind_); ++a) cell.nodes[a] = number(grid[a].first, grid[a].second);
    mesh_.cells.push_back(cell);
  }
  int number(int i, int j) {
    const auto [it, added] = numbers_.emplace(std::pair(i, j), int(nodes_.size()));
    if (added) nodes_.push_back(map_(0.5 * i / n_, 0.5 * j / m_));
    return it->second;
  }
  Mesh& mesh_;
  std::vector<Vec2>& nodes_;
  int body_, n_, m_;
  CellKind kind_;
  std::function<Vec2(double, double)> map_;
  std::map<std::pair<int, int>, int> numbers_;
};

}  // namespace

Mesh mesh_of(const TwoPlates& p) {
  Mesh mesh;
  mesh.source = "two plates";
  mesh.bodies = {"upper", "lower"};
  std::vector<Vec2> nodes;
  Plate upper(mesh, nodes, 0, p.n_upper, p.kind_upper, [&](double a, double b) {
    const double x = p.width * a;
    return Vec2(x, p.height(x) + b * (p.top - p.height(x)));
  });
  Plate lower(mesh, nodes, 1, p.n_lower, p.kind_lower, [&](double a, double b) {
    const double x = p.width * a;
    return Vec2(x, p.bottom + b * (p.height(x) - p.bottom));
  });
  upper.add_cells();
  lower.add_cells();
  mesh.boundaries = {upper.boundary("top", false, true),
                     lower.boundary("bottom", false, false),
                     upper.boundary("upper_left", true, false),
                     upper.boundary("upper_right", true, true),
                     lower.boundary("lower_left", true, false),
                     lower.boundary("lower_right", true, true),
                     upper.boundary("upper_contact", false, false),
                     lower.boundary("lower_contact", false, true)};
  mesh.nodes.resize(Eigen::Index(nodes.size()), 2);
  for (std::size_t i = 0; i < nodes.size(); ++i) mesh.nodes.row(i) = nodes[i].transpose();
  return mesh;
}

}  // namespace mortise::test
