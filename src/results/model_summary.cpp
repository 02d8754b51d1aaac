#include "results/model_summary.hpp"

#include <map>
#include <numbers>
#include <sstream>

#include "base/overloaded.hpp"
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

void print_materials(const Entries& entries, std::ostream& out) {
  std::map<std::string, std::vector<std::string>> bodies;
  for (const BodySpec& body : entries.bodies) bodies[body.material].push_back(body.name);
  const char* separator = "; ";
  for (const auto& [name, m] : entries.materials) {
    out << separator << name << " (";
    print_moduli(m, out);
    if (m.thermal_expansion != 0) out << ", alpha " << m.thermal_expansion;
    if (entries.gravity) out << ", density " << m.density;
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
  text << "rigid";
  if (rigid.x) text << ", u_x = " << *rigid.x;
  if (rigid.y) text << ", u_y = " << *rigid.y;
  if (rigid.rotation) text << ", rotation " << *rigid.rotation;
  if (!rigid.force.isZero(0)) text << ", force " << pair_of(rigid.force);
  if (rigid.moment != 0) text << ", moment " << rigid.moment;
  if (rigid.about) text << " about " << pair_of(*rigid.about);
  return text.str();
}

std::string words(const Displacement& u) {
  std::string text;
  if (u.x) text += "u_x = " + words(*u.x);
  if (u.y) text += (u.x ? ", u_y = " : "u_y = ") + words(*u.y);
  return text;
}

// `forces`: the sum of a load, or the reactions.
void print_boundary(const BoundarySpec& spec, const std::string& forces, std::ostream& out) {
  out << (is_load(spec.what) ? "  load      " : "  support   ") << listed(spec.on) << ": " << words_of(spec.what)
      << forces << "\n";
}

// Of the curves that the entry names, one by one if they are few.
std::string reaction_words(const Problem& p, const Reactions& reactions, std::size_t entry) {
  const Discretisation& d = p.discretisation;
  const std::size_t named = p.entries.boundaries[entry].spec.on.size();
  std::vector<std::string> forces;
  for (const Reaction& r : reactions.curves)
    if (r.entry == int(entry)) forces.push_back(force_of(r.sum));
  for (std::size_t k = 0; k < d.multipoint.rigid_curves.size(); ++k)
    if (d.multipoint.rigid_curves[k].entry == int(entry)) {
      const Eigen::Vector3d& motion = reactions.rigid_motions[k];
      std::ostringstream text;
      text << "; moves by " << pair_of(motion.head<2>());
      if (!p.entries.model.axisymmetric()) text << ", turns by " << motion(2);
      return text.str() + "; reaction " + in_sum(reactions.entries[entry], p.entries.model);
    }
  if (forces.size() == 1 || forces.size() != named || named > told_in_full)
    return "; reaction " + in_sum(reactions.entries[entry], p.entries.model);
  return "; reactions " + listed(forces);
}

// Entries that prescribe the same as one, in the order of the first, with the sum of their forces.
std::vector<std::pair<BoundarySpec, Resultant>> alike_as_one(const std::vector<BoundaryEntry>& all,
                                                             const std::vector<Resultant>& sums) {
  std::vector<std::pair<BoundarySpec, Resultant>> entries;
  std::map<std::string, std::size_t> number;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const BoundarySpec& spec = all[i].spec;
    const auto [found, is_new] = number.try_emplace(words_of(spec.what), entries.size());
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
  std::visit(Overloaded{[&](const Displacement& u) {
                          if (u.x) entry["displacement"]["x"] = json_of(*u.x);
                          if (u.y) entry["displacement"]["y"] = json_of(*u.y);
                        },
                        [&](const NormalDisplacement& u) { entry["displacement"]["normal"] = json_of(u.value); },
                        [&](const DirectedDisplacement& u) {
                          entry["displacement"] = {{"direction", json_of(u.direction)}, {"value", json_of(u.value)}};
                        },
                        [&](const RigidSpec& rigid) { entry["rigid"] = json_of(rigid); },
                        [&](const Pressure& p) { entry["pressure"] = json_of(p.value); },
                        [&](const SurfaceTraction& t) { entry["traction"] = json_of(t.value); },
                        [&](const TotalForce& force) { entry["force"] = json_of(force.value); },
                        [&](const NormalFoundation& k) { entry["foundation"] = json_of(k.modulus); },
                        [&](const AxesFoundation& k) { entry["foundation"] = json_of(k.moduli); },
                        [&](const PointSpring& k) { entry["spring"] = json_of(k.stiffness); }},
             spec.what);
  return entry;
}

// With the reaction of the entry, and of each curve.
Json support_json(const Problem& p, const Reactions& reactions, std::size_t i) {
  const Discretisation& d = p.discretisation;
  Json entry = boundary_json(p.entries.boundaries[i].spec);
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

std::string words_of(const BoundaryCondition& what) {
  return std::visit(
      Overloaded{
          [](const Displacement& u) { return words(u); },
          [](const NormalDisplacement& u) { return "u_n = " + words(u.value); },
          [](const DirectedDisplacement& u) { return "u = " + words(u.value) + " along " + pair_of(u.direction); },
          [](const RigidSpec& rigid) { return words(rigid); },
          [](const Pressure& p) { return "pressure " + words(p.value); },
          [](const SurfaceTraction& t) { return "traction " + words(t.value); },
          [](const TotalForce& force) { return "force " + pair_of(force.value); },
          [](const NormalFoundation& k) { return "foundation " + words(k.modulus) + " along the normal"; },
          [](const AxesFoundation& k) { return "foundation " + words(k.moduli); },
          [](const PointSpring& k) { return "springs " + pair_of(k.stiffness); }},
      what);
}

Json json_of(const Field& f) { return f.is_constant() ? Json(f.constant()) : Json(f.words()); }

std::string model_lines(const Problem& p, const Reactions* reactions) {
  const Entries& entries = p.entries;
  const Discretisation& d = p.discretisation;
  std::ostringstream out;
  out << "  model     plane " << to_string(entries.model.plane);
  if (entries.model.thickness != 1) out << ", thickness " << entries.model.thickness;
  print_materials(entries, out);
  out << "\n";
  if (entries.boundaries.size() > told_in_full) {
    std::vector<Resultant> sums = d.boundary_sums;
    for (std::size_t i = 0; reactions && i < sums.size(); ++i) sums[i] += reactions->entries[i];
    const auto merged = alike_as_one(entries.boundaries, sums);
    print_some(merged, "supports and loads on boundaries", out, [&](std::size_t i) {
      const auto& [spec, sum] = merged[i];
      print_boundary(spec,
                     is_load(spec.what) ? ", in sum " + in_sum(sum, entries.model)
                     : reactions        ? "; reaction " + in_sum(sum, entries.model)
                                        : "",
                     out);
    });
  } else {
    for (std::size_t i = 0; i < entries.boundaries.size(); ++i) {
      const BoundarySpec& spec = entries.boundaries[i].spec;
      print_boundary(spec,
                     is_load(spec.what) ? ", in sum " + in_sum(d.boundary_sums[i], entries.model)
                     : reactions        ? reaction_words(p, *reactions, i)
                                        : "",
                     out);
    }
  }
  for (std::size_t k = 0; k < p.mesh.ties.size() && k < told_in_full; ++k) {
    const Tie& tie = p.mesh.ties[k];
    out << "  tied      " << tie.curves[0] << " follows " << tie.curves[1] << " at " << tie.nodes.size() << " nodes";
    if (reactions) out << "; force " << force_of(reactions->ties[k]) << " on " << tie.curves[0];
    out << "\n";
  }
  print_some(p.fields, "fields", out, [&](std::size_t i) {
    const FieldSpec& field = p.fields[i];
    out << "  field     " << field.function->name << ": " << printable(field.values);
    if (field.component) out << "[" << *field.component << "]";
    out << " of " << printable(field.file) << "\n";
  });
  if (entries.gravity)
    out << "  load      gravity " << pair_of(*entries.gravity) << ", in sum " << in_sum(d.weight, entries.model)
        << "\n";
  print_some(entries.body_forces, "forces per volume", out, [&](std::size_t i) {
    out << "  load      body " << entries.body_forces[i].body << ": force per volume "
        << words(entries.body_forces[i].force) << ", in sum " << in_sum(d.body_sums[i], entries.model) << "\n";
  });
  print_some(entries.initial_strains, "initial strains", out, [&](std::size_t i) {
    const InitialStrainSpec& s = entries.initial_strains[i];
    out << "  load      body " << s.body << ": ";
    if (s.temperature_change)
      out << "temperature change " << s.temperature_change->words() << "\n";
    else
      out << "initial strain xx " << words(s.strain[0]) << ", yy " << words(s.strain[1]) << ", zz "
          << words(s.strain[2]) << ", xy " << words(s.strain[3]) << "\n";
  });
  return out.str();
}

Json model_json(const Problem& p, const Reactions& reactions) {
  const Entries& entries = p.entries;
  const Discretisation& d = p.discretisation;
  Json materials = Json::object(), bodies = Json::object(), supports = Json::array(), loads = Json::array();
  for (const auto& [name, m] : entries.materials) materials[name] = json_of(m);
  if (entries.gravity)
    for (const auto& [name, m] : entries.materials) materials[name]["density"] = m.density;
  for (const BodySpec& body : entries.bodies) bodies[body.name] = body.material;
  for (std::size_t i = 0; i < entries.boundaries.size(); ++i) {
    const BoundarySpec& spec = entries.boundaries[i].spec;
    if (is_load(spec.what))
      loads.push_back(with_sum(boundary_json(spec), d.boundary_sums[i]));
    else
      supports.push_back(support_json(p, reactions, i));
  }
  if (entries.gravity) loads.push_back(with_sum({{"gravity", json_of(*entries.gravity)}}, d.weight));
  for (std::size_t i = 0; i < entries.body_forces.size(); ++i) {
    const BodyForceSpec& spec = entries.body_forces[i];
    loads.push_back(with_sum({{"body", spec.body}, {"force", json_of(spec.force)}}, d.body_sums[i]));
  }
  for (const InitialStrainSpec& s : entries.initial_strains) {
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
  Json model{{"plane", to_string(entries.model.plane)},
             {"materials", materials},
             {"bodies", bodies},
             {"supports", supports},
             {"loads", loads}};
  for (std::size_t k = 0; k < p.mesh.ties.size(); ++k) {
    const Tie& tie = p.mesh.ties[k];
    model["ties"].push_back({{"follows", tie.curves[0]},
                             {"leads", tie.curves[1]},
                             {"nodes", tie.nodes.size()},
                             {"force", json_of(reactions.ties[k].force)},
                             {"moment", reactions.ties[k].moment}});
  }
  for (const FieldSpec& field : p.fields) {
    Json& entry = model["fields"][field.function->name] = {{"file", field.file}, {"values", field.values}};
    if (field.component) entry["component"] = *field.component;
  }
  if (!entries.model.axisymmetric()) model["thickness"] = entries.model.thickness;
  return model;
}

}  // namespace mortise
