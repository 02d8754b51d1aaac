#include "freefem_fields.hpp"

#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>

namespace mortise::chart {
namespace {

constexpr double near = 1e-9;  // of the scenes' length: nodes nearer than this are one

// Rows x, y and two values of a file, by x.
class Table {
 public:
  explicit Table(const std::string& path) : path_(path) {
    std::ifstream file(path);
    for (Vec4 row; file >> row(0) >> row(1) >> row(2) >> row(3);) rows_.emplace(row(0), row);
  }

  Vec2 at(const Vec2& x) const {
    for (auto it = rows_.lower_bound(x.x() - near); it != rows_.end() && it->first <= x.x() + near; ++it)
      if (std::abs(it->second(1) - x.y()) <= near) return it->second.tail<2>();
    throw std::runtime_error(path_ + ": no row at " + std::to_string(x.x()) + ", " + std::to_string(x.y()));
  }

 private:
  std::string path_;
  std::multimap<double, Vec4> rows_;
};

}  // namespace

void take_freefem(Results& r, const std::string& folder) {
  const ContactPair& pair = r.pairs.front();
  const Table multiplier(folder + "/freefem_multiplier.txt"), opposite(folder + "/freefem_opposite.txt"),
      contact(folder + "/freefem_contact.txt");
  const auto place = [&](int node) { return Vec2(r.mesh.nodes.row(node)); };
  for (const Cell& cell : r.mesh.cells)
    for (int a = 0; a < node_count(cell.kind); ++a) {
      const int node = cell.nodes[a];
      r.solution.u.segment<2>(2 * node) = (cell.body == pair.multiplier.body ? multiplier : opposite).at(place(node));
    }
  for (std::size_t i = 0; i < pair.coupling.node.size(); ++i)
    r.contacts.front().pressure(Eigen::Index(i)) = contact.at(place(pair.coupling.node[i])).x();
}

}  // namespace mortise::chart
