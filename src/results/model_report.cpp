#include <cmath>
#include <numbers>
#include <sstream>

#include "base/overloaded.hpp"
#include "base/printable.hpp"
#include "results/report.hpp"

namespace mortise {
namespace {

Json json_of(const Field& f) { return f.is_constant() ? Json(f.constant()) : Json(f.words()); }
Json json_of(const VectorField& v) { return {json_of(v.x), json_of(v.y)}; }

std::string pair_of(const Vec2& v) { return worded("(", v.x(), ", ", v.y(), ")"); }

// A long expression without its end, which is in the entry itself.
std::string words(const Field& f) {
  constexpr std::size_t longest = 50;
  const std::string all = f.words();
  return all.size() <= longest ? all : all.substr(0, longest - 4) + " ...";
}

std::string words(const VectorField& v) {
  if (v.is_constant()) return pair_of({v.x.constant(), v.y.constant()});
  return "(" + words(v.x) + ", " + words(v.y) + ")";
}

std::string words(const Displacement& u) {
  std::string text;
  if (u.x) text += "u_x = " + words(*u.x);
  if (u.y) text += (u.x ? ", u_y = " : "u_y = ") + words(*u.y);
  return text;
}

std::string words(const RigidSpec& rigid) {
  std::ostringstream text;
  text << "rigid";
  if (rigid.x) text << ", u_x = " << *rigid.x;
  if (rigid.y) text << ", u_y = " << *rigid.y;
  if (rigid.rotation) text << ", rotation " << *rigid.rotation;
  if (!rigid.force.isZero(0)) text << ", force " << pair_of(rigid.force);
  if (rigid.moment != 0) text << ", moment " << rigid.moment;
  if (rigid.about) text << " about " << pair_of(*rigid.about);
  return text.str();
}

// "young" and "poisson" as in the scene file, or the stiffness.
Json json_of(const Material& m) {
  Json json;
  if (const auto& o = m.moduli) {
    json = {{"young", {o->e1, o->e2, o->e3}},
            {"poisson", {o->nu12, o->nu13, o->nu23}},
            {"shear", o->g12},
            {"angle", o->angle * 180 / std::numbers::pi}};
  } else if (m.stiffness) {
    for (const auto& row : m.stiffness->rowwise()) json["stiffness"].push_back(row);
  } else {
    json = {{"young", m.young}, {"poisson", m.poisson}};
  }
  json["thermal_expansion"] = m.thermal_expansion;
  return json;
}

Json json_of(const RigidSpec& rigid) {
  Json json{{"force", rigid.force}, {"moment", rigid.moment}};
  if (rigid.x) json["x"] = *rigid.x;
  if (rigid.y) json["y"] = *rigid.y;
  if (rigid.rotation) json["rotation"] = *rigid.rotation;
  return json;
}

Json json_of(const Displacement& u) {
  Json json;
  if (u.x) json["x"] = json_of(*u.x);
  if (u.y) json["y"] = json_of(*u.y);
  return json;
}

// What an entry prescribes: its key and value, and in words.
struct Told {
  const char* key;
  Json value;
  std::string words;
};

Told told(const BoundaryCondition& what) {
  return std::visit(
      Overloaded{[](const Displacement& u) -> Told {
                   return {"displacement", json_of(u), words(u)};
                 },
                 [](const NormalDisplacement& u) -> Told {
                   return {"displacement", {{"normal", json_of(u.value)}}, "u_n = " + words(u.value)};
                 },
                 [](const DirectedDisplacement& u) -> Told {
                   return {"displacement",
                           {{"direction", u.direction}, {"value", json_of(u.value)}},
                           "u = " + words(u.value) + " along " + pair_of(u.direction)};
                 },
                 [](const RigidSpec& rigid) -> Told {
                   return {"rigid", json_of(rigid), words(rigid)};
                 },
                 [](const Pressure& p) -> Told {
                   return {"pressure", json_of(p.value), "pressure " + words(p.value)};
                 },
                 [](const SurfaceTraction& t) -> Told {
                   return {"traction", json_of(t.value), "traction " + words(t.value)};
                 },
                 [](const TotalForce& f) -> Told {
                   return {"force", f.value, "force " + pair_of(f.value)};
                 },
                 [](const NormalFoundation& k) -> Told {
                   return {"foundation", json_of(k.modulus), "foundation " + words(k.modulus) + " along the normal"};
                 },
                 [](const AxesFoundation& k) -> Told {
                   return {"foundation", json_of(k.moduli), "foundation " + words(k.moduli)};
                 },
                 [](const PointSpring& k) -> Told {
                   return {"spring", k.stiffness, "springs " + pair_of(k.stiffness)};
                 }},
      what);
}

Json boundary_json(const BoundarySpec& spec) {
  const Told told_of = told(spec.what);
  return {{"on", spec.on}, {told_of.key, told_of.value}, {"words", told_of.words}};
}

// Round-off of forces that are in balance is 0.
double above_round_off(double value, double size) { return std::abs(value) > 1e-12 * size ? value : 0; }

// `force`: the key of it.
void add_sum(Json& entry, const char* force, const Resultant& sum) {
  entry[force] = {above_round_off(sum.force.x(), sum.size), above_round_off(sum.force.y(), sum.size)};
  entry["moment"] = above_round_off(sum.moment, sum.arms);
}

Json load_json(Json entry, const Resultant& load) {
  add_sum(entry, "sum", load);
  entry["centre"] = load.centre();
  return entry;
}

Json reaction_json(const Reaction& r) {
  Json json{{"on", r.on}};
  add_sum(json, "reaction", r.sum);
  json["centre"] = r.centre;
  json["moment_about_centre"] = r.sum.moment_about(r.centre);
  return json;
}

Json stiffness_json(const JointStiffness& stiffness) {
  Json json{{"about", stiffness.about}, {"matrix", nullptr}};
  if (!stiffness.matrix) return json;
  json["matrix"] = Json::array();
  for (const auto& row : stiffness.matrix->rowwise()) json["matrix"].push_back(row);
  return json;
}

// With the reaction of the entry, and of each curve.
Json support_json(const Problem& p, const Reactions* reactions, std::size_t i) {
  Json entry = boundary_json(p.entries.boundaries[i].spec);
  if (!reactions) return entry;
  add_sum(entry, "reaction", reactions->entries[i]);
  const auto& rigid = p.discretisation.multipoint.rigid_curves;
  for (std::size_t k = 0; k < rigid.size(); ++k)
    if (rigid[k].entry == int(i)) {
      entry["rigid"]["about"] = rigid[k].curve.about;
      entry["rigid"]["displacement"] = Vec2(reactions->rigid_motions[k].head<2>());
      entry["rigid"]["turned"] = reactions->rigid_motions[k](2);
    }
  for (const JointStiffness& s : reactions->stiffnesses)
    if (s.entry == int(i)) entry["stiffness"] = stiffness_json(s);
  entry["curves"] = Json::array();
  for (const Reaction& r : reactions->curves)
    if (r.entry == int(i)) entry["curves"].push_back(reaction_json(r));
  return entry;
}

Json strain_json(const InitialStrainSpec& s) {
  if (s.temperature_change)
    return {{"body", s.body},
            {"temperature_change", json_of(*s.temperature_change)},
            {"words", "temperature change " + words(*s.temperature_change)}};
  Json strain;
  std::string text = "initial strain";
  const char* components[] = {"xx", "yy", "zz", "xy"};
  for (int i = 0; i < 4; ++i) {
    strain[components[i]] = json_of(s.strain[i]);
    text += std::string(i == 0 ? " " : ", ") + components[i] + " " + words(s.strain[i]);
  }
  return {{"body", s.body}, {"strain", strain}, {"words", text}};
}

Json loads_json(const Problem& p) {
  const Entries& entries = p.entries;
  const Discretisation& d = p.discretisation;
  Json loads = Json::array();
  for (std::size_t i = 0; i < entries.boundaries.size(); ++i)
    if (const BoundarySpec& spec = entries.boundaries[i].spec; is_load(spec.what))
      loads.push_back(load_json(boundary_json(spec), d.boundary_sums[i]));
  if (const auto& g = entries.gravity)
    loads.push_back(load_json({{"gravity", *g}, {"words", "gravity " + pair_of(*g)}}, d.weight));
  for (std::size_t i = 0; i < entries.body_forces.size(); ++i) {
    const BodyForceSpec& spec = entries.body_forces[i];
    loads.push_back(load_json(
        {{"body", spec.body}, {"force", json_of(spec.force)}, {"words", "force per volume " + words(spec.force)}},
        d.body_sums[i]));
  }
  for (const InitialStrainSpec& s : entries.initial_strains) loads.push_back(strain_json(s));
  return loads;
}

Json tie_json(const Problem& p, const Reactions* reactions, int k) {
  const Tie& tie = p.mesh.ties[k];
  Json json{{"follows", tie.curves[0]}, {"leads", tie.curves[1]}, {"nodes", tie.nodes.size()}};
  if (const double turn = std::atan2(tie.turn(1, 0), tie.turn(0, 0)); turn != 0)
    json["turned"] = 180 / std::numbers::pi * turn;
  if (tie.pretension && tie.pretension->force) json["pretension"] = *tie.pretension->force;
  if (tie.pretension && tie.pretension->overlap) json["overlap"] = *tie.pretension->overlap;
  if (!reactions) return json;
  add_sum(json, "force", reactions->ties[k]);
  if (!tie.pretension) return json;
  json["overlap"] = reactions->overlaps.at(k);
  json["tension"] = reactions->ties[k].force.dot(tie.pretension->normal);
  return json;
}

}  // namespace

Json model_report(const Problem& p, const Reactions* reactions) {
  const Entries& entries = p.entries;
  Json materials = Json::object(), bodies = Json::object(), supports = Json::array();
  for (const auto& [name, m] : entries.materials) {
    materials[name] = json_of(m);
    if (entries.gravity) materials[name]["density"] = m.density;
  }
  for (const BodySpec& body : entries.bodies) bodies[body.name] = body.material;
  for (std::size_t i = 0; i < entries.boundaries.size(); ++i)
    if (!is_load(entries.boundaries[i].spec.what)) supports.push_back(support_json(p, reactions, i));
  Json model{{"plane", to_string(entries.model.plane)},
             {"materials", materials},
             {"bodies", bodies},
             {"supports", supports},
             {"loads", loads_json(p)}};
  for (int k = 0; k < int(p.mesh.ties.size()); ++k) model["ties"].push_back(tie_json(p, reactions, k));
  for (const FieldSpec& field : p.fields) {
    Json& entry = model["fields"][field.function->name] = {{"file", field.file}, {"values", field.values}};
    if (field.component) entry["component"] = *field.component;
  }
  if (!entries.model.axisymmetric()) model["thickness"] = entries.model.thickness;
  return model;
}

}  // namespace mortise
