#include "results/model_summary.hpp"

#include <map>
#include <sstream>
#include <tuple>

#include "base/printable.hpp"

namespace mortise {
namespace {

using Json = nlohmann::ordered_json;

// Round-off of loads that are in balance is shown as 0.
std::string pair_of(const Vec2& v) {
  const double least = 1e-12 * v.cwiseAbs().maxCoeff();
  std::ostringstream text;
  text << "(" << (std::abs(v.x()) > least ? v.x() : 0) << ", " << (std::abs(v.y()) > least ? v.y() : 0) << ")";
  return text.str();
}

Json json_of(const Vec2& v) { return {v.x(), v.y()}; }

void print_materials(const Scene& scene, std::ostream& out) {
  std::map<std::string, std::vector<std::string>> bodies;
  for (const BodySpec& body : scene.bodies) bodies[body.material].push_back(body.name);
  const char* separator = "; ";
  for (const auto& [name, m] : scene.materials) {
    out << separator << name << " (E " << m.young << ", nu " << m.poisson;
    if (m.thermal_expansion != 0) out << ", alpha " << m.thermal_expansion;
    out << "): " << listed(bodies[name]);
  }
}

void print_boundary(const BoundarySpec& spec, const Vec2& force, std::ostream& out) {
  out << (spec.pressure || spec.traction ? "  load      " : "  support   ") << listed(spec.on) << ":";
  if (spec.displacement_x) out << " u_x = " << *spec.displacement_x;
  if (spec.displacement_y) out << (spec.displacement_x ? "," : "") << " u_y = " << *spec.displacement_y;
  if (spec.pressure) out << " pressure " << *spec.pressure;
  if (spec.traction) out << " traction " << pair_of(*spec.traction);
  if (spec.pressure || spec.traction) out << ", in sum " << pair_of(force);
  out << "\n";
}

// Entries that prescribe the same as one, in the order of the first, with the sum of their forces.
std::vector<std::pair<BoundarySpec, Vec2>> alike_as_one(const Scene& scene, const Discretisation& d) {
  const auto what = [](const BoundarySpec& s) {
    const Vec2 t = s.traction.value_or(Vec2::Zero());
    return std::tuple(s.displacement_x, s.displacement_y, s.pressure, s.traction.has_value(), t.x(), t.y());
  };
  std::vector<std::pair<BoundarySpec, Vec2>> entries;
  std::map<decltype(what(BoundarySpec())), std::size_t> number;
  for (std::size_t i = 0; i < scene.boundaries.size(); ++i) {
    const BoundarySpec& spec = scene.boundaries[i];
    const auto [found, is_new] = number.try_emplace(what(spec), entries.size());
    if (is_new) {
      entries.emplace_back(spec, d.boundary_sums[i]);
      continue;
    }
    auto& [one, sum] = entries[found->second];
    one.on.insert(one.on.end(), spec.on.begin(), spec.on.end());
    sum += d.boundary_sums[i];
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

Json boundary_json(const BoundarySpec& spec, const Vec2& force) {
  Json entry{{"on", spec.on}};
  if (spec.displacement_x) entry["displacement"]["x"] = *spec.displacement_x;
  if (spec.displacement_y) entry["displacement"]["y"] = *spec.displacement_y;
  if (spec.pressure) entry["pressure"] = *spec.pressure;
  if (spec.traction) entry["traction"] = json_of(*spec.traction);
  if (spec.pressure || spec.traction) entry["sum"] = json_of(force);
  return entry;
}

}  // namespace

std::string model_lines(const Scene& scene, const Discretisation& d) {
  std::ostringstream out;
  out << "  model     plane " << to_string(scene.model.plane);
  print_materials(scene, out);
  out << "\n";
  if (scene.boundaries.size() > told_in_full) {
    const auto entries = alike_as_one(scene, d);
    print_some(entries, "supports and loads on boundaries", out,
               [&](std::size_t i) { print_boundary(entries[i].first, entries[i].second, out); });
  } else {
    for (std::size_t i = 0; i < scene.boundaries.size(); ++i)
      print_boundary(scene.boundaries[i], d.boundary_sums[i], out);
  }
  print_some(scene.body_forces, "forces per volume", out, [&](std::size_t i) {
    out << "  load      body " << scene.body_forces[i].body << ": force per volume "
        << pair_of(scene.body_forces[i].force) << ", in sum " << pair_of(d.body_sums[i]) << "\n";
  });
  print_some(scene.initial_strains, "initial strains", out, [&](std::size_t i) {
    const InitialStrainSpec& s = scene.initial_strains[i];
    out << "  load      body " << s.body << ": ";
    if (s.temperature_change)
      out << "temperature change " << *s.temperature_change << "\n";
    else
      out << "initial strain xx " << s.strain(0) << ", yy " << s.strain(1) << ", zz " << s.strain(2) << ", xy "
          << s.strain(3) << "\n";
  });
  return out.str();
}

Json model_json(const Scene& scene, const Discretisation& d) {
  Json materials = Json::object(), bodies = Json::object(), supports = Json::array(), loads = Json::array();
  for (const auto& [name, m] : scene.materials)
    materials[name] = {{"young", m.young}, {"poisson", m.poisson}, {"thermal_expansion", m.thermal_expansion}};
  for (const BodySpec& body : scene.bodies) bodies[body.name] = body.material;
  for (std::size_t i = 0; i < scene.boundaries.size(); ++i) {
    const BoundarySpec& spec = scene.boundaries[i];
    (spec.pressure || spec.traction ? loads : supports).push_back(boundary_json(spec, d.boundary_sums[i]));
  }
  for (std::size_t i = 0; i < scene.body_forces.size(); ++i) {
    const BodyForceSpec& spec = scene.body_forces[i];
    loads.push_back({{"body", spec.body}, {"force", json_of(spec.force)}, {"sum", json_of(d.body_sums[i])}});
  }
  for (const InitialStrainSpec& s : scene.initial_strains) {
    Json entry{{"body", s.body}};
    if (s.temperature_change)
      entry["temperature_change"] = *s.temperature_change;
    else
      entry["strain"] = {{"xx", s.strain(0)}, {"yy", s.strain(1)}, {"zz", s.strain(2)}, {"xy", s.strain(3)}};
    loads.push_back(entry);
  }
  return {{"plane", to_string(scene.model.plane)},
          {"materials", materials},
          {"bodies", bodies},
          {"supports", supports},
          {"loads", loads}};
}

}  // namespace mortise
