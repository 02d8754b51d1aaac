#include "given_fields.hpp"

#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>

namespace mortise::chart {
namespace {

constexpr double near = 1e-9;  // of the scenes' length: nodes nearer than this are one

// Rows x, y and two values of the bodies or pairs of a file, by x.
class Table {
 public:
  explicit Table(const std::string& path) : path_(path) {
    std::ifstream file(path);
    int number = 0;
    for (Vec4 row; file >> number >> row(0) >> row(1) >> row(2) >> row(3);) rows_[number].emplace(row(0), row);
  }

  Vec2 at(int number, const Vec2& x) const {
    const auto& rows = rows_.at(number);
    for (auto it = rows.lower_bound(x.x() - near); it != rows.end() && it->first <= x.x() + near; ++it)
      if (std::abs(it->second(1) - x.y()) <= near) return it->second.tail<2>();
    throw std::runtime_error(path_ + ": no row at " + std::to_string(x.x()) + ", " + std::to_string(x.y()));
  }

 private:
  std::string path_;
  std::map<int, std::multimap<double, Vec4>> rows_;
};

}  // namespace

void take_fields(Results& r, const std::string& files) {
  const ContactPair& pair = r.problem.pairs.front();
  const Table bodies(files + "_bodies.txt"), contact(files + "_contact.txt");
  const auto place = [&](int node) { return Vec2(r.problem.mesh.nodes.row(node)); };
  for (const Cell& cell : r.problem.mesh.cells)
    for (int a = 0; a < node_count(cell.kind); ++a) {
      const int node = cell.nodes[a];
      r.solution.u.segment<2>(2 * node) = bodies.at(cell.body, place(node));
    }
  for (std::size_t i = 0; i < pair.coupling.node.size(); ++i)
    r.recovery.contacts.front().pressure(Eigen::Index(i)) = contact.at(0, place(pair.coupling.node[i])).x();
}

}  // namespace mortise::chart
