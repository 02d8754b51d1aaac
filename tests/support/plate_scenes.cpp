#include "support/plate_scenes.hpp"

namespace mortise::test {
namespace {

BoundarySpec held(std::vector<std::string> on, std::optional<double> x, std::optional<double> y) {
  BoundarySpec b;
  b.key = "boundary";
  b.on = std::move(on);
  b.what = Displacement{x, y};
  return b;
}

BoundarySpec pressed(std::vector<std::string> on) {
  BoundarySpec b;
  b.key = "boundary";
  b.on = std::move(on);
  b.what = Pressure{10e6};
  return b;
}

}  // namespace

Scene steel_scene(const std::vector<std::string>& bodies) {
  Scene s;
  s.path = "test scene";
  s.materials["steel"] = {210e9, 0.3, 0};
  for (const std::string& body : bodies) s.bodies.push_back({body, "steel"});
  return s;
}

Scene bored_scene() {
  Scene s = steel_scene({"ring"});
  s.boundaries = {held({"ring_east"}, {}, 0), held({"ring_west"}, 0, {}), pressed({"ring_south"})};
  return s;
}

Scene bare_scene() {
  Scene s = steel_scene({"upper", "lower"});
  ContactSpec contact;
  contact.key = "contact.0";
  contact.between = {"upper_contact", "lower_contact"};
  contact.condition = Condition::bilateral;
  contact.initial_gap = InitialGap::closed;
  s.contacts = {contact};
  return s;
}

Scene uniaxial_scene() {
  Scene s = bare_scene();
  s.boundaries = {held({"upper_left", "lower_left"}, 0, {}), held({"bottom"}, {}, 0), pressed({"top"})};
  return s;
}

Scene hydrostatic_scene() {
  Scene s = uniaxial_scene();
  s.boundaries.push_back(pressed({"upper_right", "lower_right"}));
  return s;
}

Scene clamped_scene() {
  Scene s = bare_scene();
  s.boundaries = {held({"upper_left", "upper_right", "lower_left", "lower_right"}, 0, {}), held({"bottom"}, 0, 0),
                  pressed({"top"})};
  return s;
}

}  // namespace mortise::test
