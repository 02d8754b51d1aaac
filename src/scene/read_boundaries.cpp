// [[boundary]]
#include <algorithm>
#include <cmath>

#include "scene/fail.hpp"
#include "scene/fields.hpp"
#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

/// The largest Young's modulus, and where it is written.
struct Stiffest {
  double young = 0;
  const Node* node = nullptr;
};

Stiffest stiffest(const Node& root, const Scene& scene) {
  Stiffest found;
  for (const Node& material : find(root, "materials")->items)
    if (const double young = scene.materials.at(material.name).young; young > found.young) {
      const Node* node = find(material, "young");
      found = {young, node != nullptr ? node : find(material, "stiffness")};
    }
  return found;
}

/// Small strains cannot hold under a load larger than every Young's modulus: rather 1e6 is missing somewhere. The same
/// of an expression is told where its value is.
FieldUse load_use(const Stiffest& most) {
  return {.key = {},
          .on_curve = true,
          .largest = most.young,
          .limit = "a load below every Young's modulus (the largest is " + describe(*most.node) + ", " +
                   locate(*most.node) + "); probably a unit mismatch"};
}

void check_load(const Node& load, double size, const Stiffest& most) {
  if (size <= most.young) return;
  fail(blame(*most.node, load).place, load.path,
       "expected a load below every Young's modulus (the largest is " + describe(*most.node) + ", " +
           locate(*most.node) + "), found " + describe(load) + "; probably a unit mismatch");
}

void read_displacement(const Node& node, BoundarySpec& boundary) {
  expect_keys(node, {"x", "y"});
  if (node.items.empty()) fail(node, "is empty; expected x, y or both");
  const FieldUse use{.key = {}, .on_curve = true};
  if (const Node* x = find(node, "x")) boundary.displacement_x = field(*x, use);
  if (const Node* y = find(node, "y")) boundary.displacement_y = field(*y, use);
}

void read_what(const Node& what, const Stiffest& most, BoundarySpec& boundary) {
  if (what.name == "displacement") {
    read_displacement(what, boundary);
  } else if (what.name == "pressure") {
    boundary.pressure = field(what, load_use(most));
    if (boundary.pressure->is_constant()) check_load(what, std::abs(boundary.pressure->constant()), most);
  } else if (what.name == "traction") {
    boundary.traction = field_pair(what, load_use(most));
    for (const Field& t : {boundary.traction->x, boundary.traction->y})
      if (t.is_constant()) check_load(what, std::abs(t.constant()), most);
  } else if (what.name == "force") {
    boundary.force = number_pair(what);
  } else if (what.kind == Node::Kind::list) {
    boundary.foundation = field_pair(what, {.key = {}, .on_curve = true});
  } else {
    boundary.normal_foundation = field(what, {.key = {}, .on_curve = true});
  }
}

/// Each curve once in an entry, with at most one load and each displacement component once in all entries.
void check_once(const Node& entry, const Node& what, const std::vector<const Node*>& curves, Once& once) {
  Once in_this_entry;
  for (const Node* curve : curves) {
    const std::string subject = "curve '" + curve->text + "' ";
    in_this_entry.take(subject + "is named", *curve, entry);
    if (what.kind != Node::Kind::table) {
      once.take(subject + (what.name == "foundation" ? "has a foundation" : "carries a load"), blame(what, *curve),
                entry);
      continue;
    }
    for (const Node& component : what.items) {
      once.take(subject + "is given displacement." + component.name, blame(component, *curve), entry);
    }
  }
}

}  // namespace

void read_boundaries(const Node& root, Scene& scene) {
  Once once;
  const Stiffest most = stiffest(root, scene);
  for (const Node* entry : entries(root, "boundary")) {
    expect_keys(*entry, {"on", "displacement", "pressure", "traction", "force", "foundation"});
    BoundarySpec boundary;
    boundary.key = locate(*entry);
    const std::vector<const Node*> curves = names(require(*entry, "on", "the names of physical curves"));
    for (const Node* curve : curves) boundary.on.push_back(curve->text);
    const Node& what = exactly_one(*entry, {"displacement", "pressure", "traction", "force", "foundation"});
    read_what(what, most, boundary);
    check_once(*entry, what, curves, once);
    scene.boundaries.push_back(boundary);
  }
}

}  // namespace mortise::scene_file
