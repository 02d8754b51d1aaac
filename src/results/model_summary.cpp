#include "results/model_summary.hpp"

#include <map>
#include <numbers>
#include <sstream>

#include "base/printable.hpp"

namespace mortise {
namespace {

using Json = nlohmann::ordered_json;

std::string pair_of(const Vec2& v) {
  std::ostringstream text;
  text << "(" << v.x() << ", " << v.y() << ")";
  return text.str();
}

// Round-off of forces that are in balance is shown as 0.
double shown(double value, double size) { return std::abs(value) > 1e-12 * size ? value : 0; }

std::string force_of(const Resultant& sum) {
  return pair_of({shown(sum.force.x(), sum.size), shown(sum.force.y(), sum.size)});
}

// Of rings the force alone: round the ring moments are in balance.
std::string in_sum(const Resultant& sum, const Model& model) {
  std::ostringstream text;
  text << force_of(sum);
  if (!model.axisymmetric()) text << ", moment " << shown(sum.moment, sum.arms) << " about (0, 0)";
  return text.str();
}

Json json_of(const Vec2& v) { return {v.x(), v.y()}; }

void print_moduli(const Material& m, std::ostream& out) {
  if (const auto& o = m.moduli)
    out << "E " << o->e1 << ", " << o->e2 << ", " << o->e3 << ", nu " << o->nu12 << ", " << o->nu13 << ", " << o->nu23
        << ", G " << o->g12 << ", at " << o->angle * 180 / std::numbers::pi << " degrees";
  else if (m.stiffness)
    out << "a stiffness matrix";
  else
    out << "E " << m.young << ", nu " << m.poisson;
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
    for (const auto& row : m.stiffness->rowwise()) json["stiffness"].push_back({row(0), row(1), row(2), row(3)});
  } else {
    json = {{"young", m.young}, {"poisson", m.poisson}};
  }
  json["thermal_expansion"] = m.thermal_expansion;
  return json;
}

void print_materials(const Scene& scene, std::ostream& out) {
  std::map<std::string, std::vector<std::string>> bodies;
  for (const BodySpec& body : scene.bodies) bodies[body.material].push_back(body.name);
  const char* separator = "; ";
  for (const auto& [name, m] : scene.materials) {
    out << separator << name << " (";
    print_moduli(m, out);
    if (m.thermal_expansion != 0) out << ", alpha " << m.thermal_expansion;
    if (scene.gravity) out << ", density " << m.density;
    out << "): " << listed(bodies[name]);
  }
}

// A long expression without its end: summary.json has all of it.
std::string words(const Field& f) {
  constexpr std::size_t longest = 50;
  const std::string all = f.words();
  return all.size() <= longest ? all : all.substr(0, longest - 4) + " ...";
}

std::string words(const VectorField& v) {
  if (v.is_constant()) return pair_of({v.x.constant(), v.y.constant()});
  return "(" + words(v.x) + ", " + words(v.y) + ")";
}

Json json_of(const VectorField& v) { return {json_of(v.x), json_of(v.y)}; }

std::string words(const RigidSpec& rigid) {
  std::ostringstream text;
  text << " rigid";
  if (rigid.x) text << ", u_x = " << *rigid.x;
  if (rigid.y) text << ", u_y = " << *rigid.y;
  if (rigid.rotation) text << ", rotation " << *rigid.rotation;
  if (!rigid.force.isZero(0)) text << ", force " << pair_of(rigid.force);
  if (rigid.moment != 0) text << ", moment " << rigid.moment;
  if (rigid.about) text << " about " << pair_of(*rigid.about);
  return text.str();
}

// What an entry prescribes, wherever.
std::string words(const BoundarySpec& spec) {
  std::string text;
  if (spec.displacement_x) text += " u_x = " + words(*spec.displacement_x);
  if (spec.displacement_y) text += (spec.displacement_x ? ", u_y = " : " u_y = ") + words(*spec.displacement_y);
  if (spec.displacement_normal) text += " u_n = " + words(*spec.displacement_normal);
  if (spec.displacement_along) text += " u = " + words(*spec.displacement_along) + " along " + pair_of(*spec.direction);
  if (spec.rigid) text += words(*spec.rigid);
  if (spec.spring) text += " springs " + pair_of(*spec.spring);
  if (spec.pressure) text += " pressure " + words(*spec.pressure);
  if (spec.traction) text += " traction " + words(*spec.traction);
  if (spec.force) text += " force " + pair_of(*spec.force);
  if (spec.normal_foundation) text += " foundation " + words(*spec.normal_foundation) + " along the normal";
  if (spec.foundation) text += " foundation " + words(*spec.foundation);
  return text;
}

// `forces`: the sum of a load, or the reactions.
void print_boundary(const BoundarySpec& spec, const std::string& forces, std::ostream& out) {
  out << (spec.is_load() ? "  load      " : "  support   ") << listed(spec.on) << ":" << words(spec) << forces << "\n";
}

// Of the curves that the entry names, one by one if they are few.
std::string reaction_words(const Scene& scene, const Discretisation& d, const Reactions& reactions, std::size_t entry) {
  const std::size_t named = scene.boundaries[entry].on.size();
  std::vector<std::string> forces;
  for (const Reaction& r : reactions.curves)
    if (r.entry == int(entry)) forces.push_back(force_of(r.sum));
  for (std::size_t k = 0; k < d.multipoint.rigid_curves.size(); ++k)
    if (d.multipoint.rigid_curves[k].entry == int(entry)) {
      const Eigen::Vector3d& motion = reactions.rigid_motions[k];
      std::ostringstream text;
      text << "; moves by " << pair_of(motion.head<2>());
      if (!scene.model.axisymmetric()) text << ", turns by " << motion(2);
      return text.str() + "; reaction " + in_sum(reactions.entries[entry], scene.model);
    }
  if (forces.size() == 1 || forces.size() != named || named > told_in_full)
    return "; reaction " + in_sum(reactions.entries[entry], scene.model);
  return "; reactions " + listed(forces);
}

// Entries that prescribe the same as one, in the order of the first, with the sum of their forces.
std::vector<std::pair<BoundarySpec, Resultant>> alike_as_one(const Scene& scene, const std::vector<Resultant>& sums) {
  std::vector<std::pair<BoundarySpec, Resultant>> entries;
  std::map<std::string, std::size_t> number;
  for (std::size_t i = 0; i < scene.boundaries.size(); ++i) {
    const BoundarySpec& spec = scene.boundaries[i];
    const auto [found, is_new] = number.try_emplace(words(spec), entries.size());
    if (is_new) {
      entries.emplace_back(spec, sums[i]);
      continue;
    }
    auto& [one, sum] = entries[found->second];
    one.on.insert(one.on.end(), spec.on.begin(), spec.on.end());
    sum += sums[i];
  }
  return entries;
}

// Each entry by `print`, of many the first ones.
template <typename Entries, typename Print>
void print_some(const Entries& entries, const std::string& what, std::ostream& out, Print print) {
  const std::size_t told = entries.size() > told_in_full ? told_of_many : entries.size();
  for (std::size_t i = 0; i < told; ++i) print(i);
  if (told < entries.size())
    out << "  load      " << entries.size() - told << " more " << what << ": summary.json has all\n";
}

Json with_sum(Json entry, const Resultant& load) {
  entry["sum"] = json_of(load.force);
  entry["moment"] = load.moment;
  entry["centre"] = json_of(load.centre());
  return entry;
}

Json reaction_json(const Reaction& r) {
  return {{"on", r.on},
          {"reaction", json_of(r.sum.force)},
          {"moment", r.sum.moment},
          {"centre", json_of(r.centre)},
          {"moment_about_centre", r.sum.moment_about(r.centre)}};
}

Json json_of(const RigidSpec& rigid) {
  Json json{{"force", json_of(rigid.force)}, {"moment", rigid.moment}};
  if (rigid.x) json["x"] = *rigid.x;
  if (rigid.y) json["y"] = *rigid.y;
  if (rigid.rotation) json["rotation"] = *rigid.rotation;
  return json;
}

Json boundary_json(const BoundarySpec& spec) {
  Json entry{{"on", spec.on}};
  if (spec.displacement_x) entry["displacement"]["x"] = json_of(*spec.displacement_x);
  if (spec.displacement_y) entry["displacement"]["y"] = json_of(*spec.displacement_y);
  if (spec.displacement_normal) entry["displacement"]["normal"] = json_of(*spec.displacement_normal);
  if (spec.displacement_along)
    entry["displacement"] = {{"direction", json_of(*spec.direction)}, {"value", json_of(*spec.displacement_along)}};
  if (spec.spring) entry["spring"] = json_of(*spec.spring);
  if (spec.rigid) entry["rigid"] = json_of(*spec.rigid);
  if (spec.pressure) entry["pressure"] = json_of(*spec.pressure);
  if (spec.traction) entry["traction"] = json_of(*spec.traction);
  if (spec.force) entry["force"] = json_of(*spec.force);
  if (spec.normal_foundation) entry["foundation"] = json_of(*spec.normal_foundation);
  if (spec.foundation) entry["foundation"] = json_of(*spec.foundation);
  return entry;
}

// With the reaction of the entry, and of each curve.
Json support_json(const Scene& scene, const Discretisation& d, const Reactions& reactions, std::size_t i) {
  Json entry = boundary_json(scene.boundaries[i]);
  entry["reaction"] = json_of(reactions.entries[i].force);
  entry["moment"] = reactions.entries[i].moment;
  for (std::size_t k = 0; k < d.multipoint.rigid_curves.size(); ++k)
    if (d.multipoint.rigid_curves[k].entry == int(i)) {
      entry["rigid"]["about"] = json_of(d.multipoint.rigid_curves[k].curve.about);
      entry["rigid"]["displacement"] = json_of(Vec2(reactions.rigid_motions[k].head<2>()));
      entry["rigid"]["turned"] = reactions.rigid_motions[k](2);
    }
  entry["curves"] = Json::array();
  for (const Reaction& r : reactions.curves)
    if (r.entry == int(i)) entry["curves"].push_back(reaction_json(r));
  return entry;
}

}  // namespace

std::string boundary_words(const BoundarySpec& spec) { return words(spec).substr(1); }

Json json_of(const Field& f) { return f.is_constant() ? Json(f.constant()) : Json(f.words()); }

std::string model_lines(const Scene& scene, const Mesh& mesh, const Discretisation& d, const Reactions* reactions) {
  std::ostringstream out;
  out << "  model     plane " << to_string(scene.model.plane);
  if (scene.model.thickness != 1) out << ", thickness " << scene.model.thickness;
  print_materials(scene, out);
  out << "\n";
  if (scene.boundaries.size() > told_in_full) {
    std::vector<Resultant> sums = d.boundary_sums;
    for (std::size_t i = 0; reactions && i < sums.size(); ++i) sums[i] += reactions->entries[i];
    const auto entries = alike_as_one(scene, sums);
    print_some(entries, "supports and loads on boundaries", out, [&](std::size_t i) {
      const auto& [spec, sum] = entries[i];
      print_boundary(spec,
                     spec.is_load() ? ", in sum " + in_sum(sum, scene.model)
                     : reactions    ? "; reaction " + in_sum(sum, scene.model)
                                    : "",
                     out);
    });
  } else {
    for (std::size_t i = 0; i < scene.boundaries.size(); ++i) {
      const BoundarySpec& spec = scene.boundaries[i];
      print_boundary(spec,
                     spec.is_load() ? ", in sum " + in_sum(d.boundary_sums[i], scene.model)
                     : reactions    ? reaction_words(scene, d, *reactions, i)
                                    : "",
                     out);
    }
  }
  for (std::size_t k = 0; k < mesh.ties.size() && k < told_in_full; ++k) {
    const Tie& tie = mesh.ties[k];
    out << "  tied      " << tie.curves[0] << " follows " << tie.curves[1] << " at " << tie.nodes.size() << " nodes";
    if (reactions) out << "; force " << force_of(reactions->ties[k]) << " on " << tie.curves[0];
    out << "\n";
  }
  print_some(scene.fields, "fields", out, [&](std::size_t i) {
    const FieldSpec& field = scene.fields[i];
    out << "  field     " << field.function->name << ": " << printable(field.values);
    if (field.component) out << "[" << *field.component << "]";
    out << " of " << printable(field.file) << "\n";
  });
  if (scene.gravity)
    out << "  load      gravity " << pair_of(*scene.gravity) << ", in sum " << in_sum(d.weight, scene.model) << "\n";
  print_some(scene.body_forces, "forces per volume", out, [&](std::size_t i) {
    out << "  load      body " << scene.body_forces[i].body << ": force per volume "
        << words(scene.body_forces[i].force) << ", in sum " << in_sum(d.body_sums[i], scene.model) << "\n";
  });
  print_some(scene.initial_strains, "initial strains", out, [&](std::size_t i) {
    const InitialStrainSpec& s = scene.initial_strains[i];
    out << "  load      body " << s.body << ": ";
    if (s.temperature_change)
      out << "temperature change " << s.temperature_change->words() << "\n";
    else
      out << "initial strain xx " << words(s.strain[0]) << ", yy " << words(s.strain[1]) << ", zz "
          << words(s.strain[2]) << ", xy " << words(s.strain[3]) << "\n";
  });
  return out.str();
}

Json model_json(const Scene& scene, const Mesh& mesh, const Discretisation& d, const Reactions& reactions) {
  Json materials = Json::object(), bodies = Json::object(), supports = Json::array(), loads = Json::array();
  for (const auto& [name, m] : scene.materials) materials[name] = json_of(m);
  if (scene.gravity)
    for (const auto& [name, m] : scene.materials) materials[name]["density"] = m.density;
  for (const BodySpec& body : scene.bodies) bodies[body.name] = body.material;
  for (std::size_t i = 0; i < scene.boundaries.size(); ++i) {
    const BoundarySpec& spec = scene.boundaries[i];
    if (spec.is_load())
      loads.push_back(with_sum(boundary_json(spec), d.boundary_sums[i]));
    else
      supports.push_back(support_json(scene, d, reactions, i));
  }
  if (scene.gravity) loads.push_back(with_sum({{"gravity", json_of(*scene.gravity)}}, d.weight));
  for (std::size_t i = 0; i < scene.body_forces.size(); ++i) {
    const BodyForceSpec& spec = scene.body_forces[i];
    loads.push_back(with_sum({{"body", spec.body}, {"force", json_of(spec.force)}}, d.body_sums[i]));
  }
  for (const InitialStrainSpec& s : scene.initial_strains) {
    Json entry{{"body", s.body}};
    if (s.temperature_change)
      entry["temperature_change"] = json_of(*s.temperature_change);
    else
      entry["strain"] = {{"xx", json_of(s.strain[0])},
                         {"yy", json_of(s.strain[1])},
                         {"zz", json_of(s.strain[2])},
                         {"xy", json_of(s.strain[3])}};
    loads.push_back(entry);
  }
  Json model{{"plane", to_string(scene.model.plane)},
             {"materials", materials},
             {"bodies", bodies},
             {"supports", supports},
             {"loads", loads}};
  for (std::size_t k = 0; k < mesh.ties.size(); ++k) {
    const Tie& tie = mesh.ties[k];
    model["ties"].push_back({{"follows", tie.curves[0]},
                             {"leads", tie.curves[1]},
                             {"nodes", tie.nodes.size()},
                             {"force", json_of(reactions.ties[k].force)},
                             {"moment", reactions.ties[k].moment}});
  }
  for (const FieldSpec& field : scene.fields) {
    Json& entry = model["fields"][field.function->name] = {{"file", field.file}, {"values", field.values}};
    if (field.component) entry["component"] = *field.component;
  }
  if (!scene.model.axisymmetric()) model["thickness"] = scene.model.thickness;
  return model;
}

}  // namespace mortise
