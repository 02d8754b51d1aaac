// [[boundary]]
#include <cmath>

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
FieldUse load_use(const Scene& scene, const Stiffest& most) {
  FieldUse use = expression_use(scene, true);
  use.largest = most.young;
  use.limit = "a load below every Young's modulus (the largest is " + describe(*most.node) + ", " + locate(*most.node) +
              "); probably a unit mismatch";
  return use;
}

void check_load(const Node& load, double size, const Stiffest& most) {
  if (size <= most.young) return;
  fail(blame(*most.node, load).place, load.path,
       "expected a load below every Young's modulus (the largest is " + describe(*most.node) + ", " +
           locate(*most.node) + "), found " + describe(load) + "; probably a unit mismatch");
}

Keys displacement_keys(Displacement& displacement, const FieldUse& use) {
  const Json value = a_field(use).schema;
  return {
      key("x", displacement.x, a_field(use), ""),    key("y", displacement.y, a_field(use), ""),
      {"normal", value, "along the outward normal"}, {"direction", a_pair().schema, "[dx, dy]"},
      {"value", value, "along the direction"},
  };
}

Keys rigid_keys(RigidSpec& rigid) {
  return {
      key("x", rigid.x, a_number(), ""),
      key("y", rigid.y, a_number(), ""),
      key("rotation", rigid.rotation, a_number(), "radians, counter-clockwise"),
      key("force", rigid.force, a_pair(), "[Fx, Fy] at `about`"),
      key("moment", rigid.moment, a_number(), ""),
      key("about", rigid.about, a_pair(), "[x, y] (their centre)"),
  };
}

BoundaryCondition read_displacement(const Node& node, const FieldUse& use) {
  Displacement displacement;
  read(node, displacement_keys(displacement, use));
  const std::string expected = "expected x, y or both; or normal; or direction and value";
  if (node.items.empty()) fail(node, "is empty; " + expected);
  const Node *x = find(node, "x"), *y = find(node, "y"), *normal = find(node, "normal");
  const Node *direction = find(node, "direction"), *value = find(node, "value");
  if (int(x != nullptr || y != nullptr) + int(normal != nullptr) + int(direction != nullptr || value != nullptr) > 1)
    fail(node, "names several directions; " + expected);
  if (normal != nullptr) return NormalDisplacement{field(*normal, use)};
  if (direction != nullptr || value != nullptr) {
    const Vec2 along = number_pair(require(node, "direction", "[dx, dy], along which 'value' is prescribed"));
    if (!(along.stableNorm() > 0)) fail(*direction, "has no length; expected a direction, [dx, dy]");
    return DirectedDisplacement{along.stableNormalized(),
                                field(require(node, "value", "the displacement along 'direction'"), use)};
  }
  return displacement;
}

RigidSpec read_rigid(const Node& node, const Model& model) {
  RigidSpec rigid;
  read(node, rigid_keys(rigid));
  if (!model.axisymmetric()) return rigid;
  for (const char* key : {"x", "rotation", "moment", "about"})
    if (const Node* given = find(node, key))
      fail(*given, "rings that are rigid move along the axis alone; expected y or force");
  return rigid;
}

/// One number for both, or [kx, ky].
Vec2 read_spring(const Node& node) {
  const Vec2 k = node.kind == Node::Kind::list ? number_pair(node) : Vec2::Constant(number(node));
  if (!(k.minCoeff() >= 0 && k.maxCoeff() > 0)) fail_expected(node, "a stiffness > 0, or two >= 0, [kx, ky]");
  return k;
}

Pressure read_pressure(const Node& node, const Scene& scene, const Stiffest& most) {
  Pressure pressure{field(node, load_use(scene, most))};
  if (pressure.value.is_constant()) check_load(node, std::abs(pressure.value.constant()), most);
  return pressure;
}

SurfaceTraction read_traction(const Node& node, const Scene& scene, const Stiffest& most) {
  SurfaceTraction traction{field_pair(node, load_use(scene, most))};
  for (const Field* t : {&traction.value.x, &traction.value.y})
    if (t->is_constant()) check_load(node, std::abs(t->constant()), most);
  return traction;
}

BoundaryCondition read_what(const Node& what, const Scene& scene, const Stiffest& most) {
  if (what.name == "displacement") return read_displacement(what, expression_use(scene, true));
  if (what.name == "rigid") return read_rigid(what, scene.model);
  if (what.name == "spring") return PointSpring{read_spring(what)};
  if (what.name == "pressure") return read_pressure(what, scene, most);
  if (what.name == "traction") return read_traction(what, scene, most);
  if (what.name == "force") return TotalForce{number_pair(what)};
  if (what.kind == Node::Kind::list) return AxesFoundation{field_pair(what, expression_use(scene, true))};
  return NormalFoundation{field(what, expression_use(scene, true))};
}

/// Each curve once in an entry, with at most one load and each displacement component once in all entries.
void check_once(const Node& entry, const Node& what, const std::vector<const Node*>& curves, Once& once) {
  Once in_this_entry;
  for (const Node* curve : curves) {
    const std::string subject = "curve '" + curve->text + "' ";
    in_this_entry.take(subject + "is named", *curve, entry);
    if (what.name != "displacement") {
      const std::string has = what.name == "foundation" || what.name == "spring" ? "has a " + what.name
                              : what.name == "rigid"                             ? "is rigid"
                                                                                 : "carries a load";
      once.take(subject + has, blame(what, *curve), entry);
      continue;
    }
    for (const Node& component : what.items) {
      once.take(subject + "is given displacement." + component.name, blame(component, *curve), entry);
    }
  }
}

}  // namespace

const std::vector<std::string> boundary_conditions{"displacement", "pressure", "traction", "force",
                                                   "foundation",   "spring",   "rigid"};

Keys boundary_keys(BoundarySpec& boundary) {
  Displacement displacement;
  RigidSpec rigid;
  static const Json moved = [&] {
    Json object = object_of(displacement_keys(displacement, {}));
    object["minProperties"] = 1;
    object["dependencies"] = {{"direction", {"value"}}, {"value", {"direction"}}};
    return object;
  }();
  static const Json value = a_field({}).schema, pair = a_pair().schema, values = two_fields({}).schema;
  return {
      required(key("on", boundary.on, some_names(),
                   "a physical curve or a list of them; of `displacement`, `force` and `spring` also physical points. "
                   "A curve counts before a point of the same name; stresses have no bound at a point that bears a "
                   "force (a warning says so)"),
               "the names of physical curves"),
      {"displacement", moved,
       "`{ x, y }`, one or both; `{ normal }`, along the outward normal: an inclined symmetry line, a guide; or `{ "
       "direction = [dx, dy], value }`; functions of place",
       "one of these seven"},
      {"pressure", value,
       "positive pushes onto the body, a function of place. An edge carries one load at most, under whichever name"},
      {"traction", values, "`[tx, ty]`, functions of place"},
      {"force", pair, "`[Fx, Fy]`, their sum: a constant traction on all the curves"},
      {"foundation", either(value, values),
       "springs to the ground, stress per length ≥ 0: `k` along the normal, or `[kx, ky]`; functions of place"},
      {"spring", either(above(0).schema, pair),
       "of a point, to the ground, force per length: `k`, or `[kx, ky]` along x and y"},
      {"rigid", object_of(rigid_keys(rigid)), "the curves keep their shape ([below](#rigid-curves))"},
      key("stiffness", boundary.stiffness, true_or_false(),
          "`true`, of `rigid` and of a displacement along x or y: summary.json tells how the support's force and "
          "moment "
          "change as it moves ([below](#stiffness-of-a-joint))"),
  };
}

void read_boundaries(const Node& root, Scene& scene) {
  Once once;
  const Stiffest most = stiffest(root, scene);
  for (const Node* entry : entries(root, "boundary")) {
    BoundarySpec boundary;
    read(*entry, boundary_keys(boundary));
    const Node& what = exactly_one(*entry, boundary_conditions);
    boundary.key = locate(*entry);
    const std::vector<const Node*> curves = names(*find(*entry, "on"));
    boundary.what = read_what(what, scene, most);
    if (boundary.stiffness && !std::holds_alternative<RigidSpec>(boundary.what) &&
        !std::holds_alternative<Displacement>(boundary.what))
      fail(*find(*entry, "stiffness"), "is that of a support; expected it with rigid, or displacement = { x, y }");
    check_once(*entry, what, curves, once);
    scene.boundaries.push_back(boundary);
  }
}

}  // namespace mortise::scene_file
