#include "contact/joint_states.hpp"

#include <algorithm>
#include <cmath>

namespace mortise {
namespace {

// Bodies around a joint as far as the next open ones.
struct Part {
  Fan fan;
  std::size_t joint;
  /// Its outer faces are one open joint's, along which all its own slide: no translation opens it, only a mode does.
  bool slides_along = false;
};

bool is_closed(const Fan& fan) { return fan.joints.size() == fan.wedges.size(); }

// Whether all joints that slide lie along the outer faces of a fan of 2 pi.
bool all_lie_along(const Fan& fan) {
  constexpr double alike = 1e-6;  // radians, of directions of drawn curves
  double angle = 0;
  for (std::size_t k = 0; k < fan.joints.size(); ++k) {
    angle += fan.wedges[k].angle;
    if (fan.joints[k] == Joint::sliding && std::abs(std::remainder(angle, straight)) > alike) return false;
  }
  return true;
}

// What is left about its joint where others open.
Part part_of(const Part& whole, const std::vector<char>& open) {
  const auto& [wedges, joints, first, last] = whole.fan;
  const std::size_t count = wedges.size();
  const auto after = [&](std::size_t wedge) { return (wedge + 1) % count; };
  const auto before = [&](std::size_t wedge) { return (wedge + count - 1) % count; };
  const auto goes_on = [&](std::size_t joint) { return joint < joints.size() && !open[joint]; };
  std::size_t at = whole.joint;
  while (goes_on(before(at))) at = before(at);
  Part part{{{wedges[at]}, {}, before(at) < joints.size() ? Face::free : first, last}, 0};
  for (; goes_on(at); at = after(at)) {
    if (at == whole.joint) part.joint = part.fan.joints.size();
    part.fan.joints.push_back(joints[at]);
    part.fan.wedges.push_back(wedges[after(at)]);
  }
  if (at < joints.size()) part.fan.last = Face::free;
  part.slides_along = is_closed(whole.fan) && part.fan.wedges.size() == count && all_lie_along(part.fan);
  return part;
}

// What the modes of a part make of `found`, in all states that they lead to.
void add_states(const Part& part, bool all_closed, TipExponents& found) {
  for (const TipMode& mode : modes(part.fan)) {
    if (!mode.has_signs) continue;
    for (const double sign : {1., -1.}) {
      if (part.slides_along && !(sign * (mode.first - mode.last) > 0)) continue;
      std::vector<char> pulled;
      for (const double p : mode.pressure) pulled.push_back(sign * p < 0);
      if (pulled[part.joint]) continue;  // it opens itself
      if (std::ranges::count(pulled, 1) > 0) {
        add_states(part_of(part, pulled), false, found);
      } else if (!all_closed) {
        if (mode.exponent.real() < found.stress.real()) found.stress = mode.exponent;
        const bool presses = mode.pressure[part.joint] > 0 || mode.pressure[part.joint] < 0;
        if (presses && mode.exponent.real() < found.pressure.real()) found.pressure = mode.exponent;
      }
    }
  }
}

}  // namespace

TipExponents exponents_of_states(const Fan& fan, std::size_t joint) {
  TipExponents found = exponents(fan, joint);
  if (std::ranges::count(fan.joints, Joint::sliding) > 1 && found.stress != 1.0) add_states({fan, joint}, true, found);
  return found;
}

}  // namespace mortise
