#include "app/drawn_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "base/vectors.hpp"
#include "error/wanted_sizes.hpp"
#include "model/patterns.hpp"

namespace mortise {
namespace {

constexpr double turn = 15 * std::numbers::pi / 180;  // of an arc, an edge

double length_of(const DrawnCurve& curve) {
  double sum = 0;
  for (std::size_t i = 1; i < curve.places.size(); ++i) sum += (curve.places[i] - curve.places[i - 1]).norm();
  return sum;
}

// The curves that a scene's contact pairs name.
class NamedInContact {
 public:
  explicit NamedInContact(const Scene& scene) {
    for (const ContactSpec& contact : scene.contacts)
      for (const std::string& side : contact.between)
        if (is_pattern(side))
          patterns_.push_back(side);
        else
          names_.insert(side);
  }

  bool have(const std::string& name) const {
    return names_.contains(name) ||
           std::ranges::any_of(patterns_, [&](const std::string& pattern) { return matches(pattern, name); });
  }

 private:
  std::set<std::string> names_;
  std::vector<std::string> patterns_;
};

}  // namespace

LayeredSizes drawn_sizes(const std::vector<DrawnCurve>& curves, const Scene& scene, int edges) {
  std::map<std::string, double> lengths;
  for (const DrawnCurve& curve : curves)
    for (const std::string& name : curve.names) lengths[name] += length_of(curve);
  const NamedInContact in_contact(scene);
  std::vector<SizeLayers> places;
  for (const DrawnCurve& curve : curves) {
    double largest = std::numeric_limits<double>::infinity();
    for (const std::string& name : curve.names)
      if (in_contact.have(name)) largest = std::min(largest, lengths[name] / edges);
    for (std::size_t i = 1; i + 1 < curve.places.size(); ++i) {
      const Vec2 before = curve.places[i] - curve.places[i - 1], after = curve.places[i + 1] - curve.places[i];
      const double angle = angle_between(before, after), step = (before.norm() + after.norm()) / 2;
      const double size = std::min(largest, angle > 1e-9 ? turn * step / angle : largest);
      if (std::isfinite(size)) places.push_back({curve.places[i], size, size_growth});
    }
  }
  return LayeredSizes(std::move(places));
}

}  // namespace mortise
