#include "mesh/box_index.hpp"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/segment.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <iterator>

namespace mortise {
namespace {

namespace geometry = boost::geometry;
using Point = geometry::model::d2::point_xy<double>;
using Rectangle = geometry::model::box<Point>;
using Entry = std::pair<Rectangle, int>;

Point point(const Vec2& x) { return {x.x(), x.y()}; }

Rectangle rectangle(const Box& box) { return {point(box.min()), point(box.max())}; }

std::vector<Entry> entries(const std::vector<Box>& boxes) {
  std::vector<Entry> list;
  list.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) list.emplace_back(rectangle(boxes[i]), int(i));
  return list;
}

}  // namespace

struct BoxIndex::Tree {
  geometry::index::rtree<Entry, geometry::index::linear<8>> boxes;

  template <typename Shape>
  std::vector<int> meeting(const Shape& shape) const {
    std::vector<int> numbers;
    for (auto it = boxes.qbegin(geometry::index::intersects(shape)); it != boxes.qend(); ++it)
      numbers.push_back(it->second);
    std::sort(numbers.begin(), numbers.end());
    return numbers;
  }
};

BoxIndex::BoxIndex(const std::vector<Box>& boxes)
    : tree_(std::make_unique<Tree>(Tree{decltype(Tree::boxes)(entries(boxes))})) {}
BoxIndex::~BoxIndex() = default;
BoxIndex::BoxIndex(BoxIndex&&) noexcept = default;
BoxIndex& BoxIndex::operator=(BoxIndex&&) noexcept = default;

std::vector<int> BoxIndex::meeting(const Box& box) const { return tree_->meeting(rectangle(box)); }

std::vector<int> BoxIndex::meeting(const Vec2& from, const Vec2& to) const {
  return tree_->meeting(geometry::model::segment<Point>(point(from), point(to)));
}

std::vector<int> BoxIndex::nearest(const Vec2& x, int count) const {
  std::vector<Entry> found;
  tree_->boxes.query(geometry::index::nearest(point(x), unsigned(count)), std::back_inserter(found));
  std::vector<std::pair<double, int>> by_distance;
  for (const Entry& entry : found)
    by_distance.emplace_back(geometry::comparable_distance(point(x), entry.first), entry.second);
  std::ranges::sort(by_distance);
  std::vector<int> numbers;
  for (const auto& [distance, number] : by_distance) numbers.push_back(number);
  return numbers;
}

}  // namespace mortise
