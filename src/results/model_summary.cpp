#include "results/model_summary.hpp"

#include <sstream>

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

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

void print_materials(const Scene& scene, std::ostream& out) {
  const char* separator = "; ";
  for (const auto& [name, m] : scene.materials) {
    out << separator << name << " (E " << m.young << ", nu " << m.poisson;
    if (m.thermal_expansion != 0) out << ", alpha " << m.thermal_expansion;
    out << "): ";
    const char* comma = "";
    for (const BodySpec& body : scene.bodies)
      if (body.material == name) {
        out << comma << body.name;
        comma = ", ";
      }
  }
}

void print_boundary(const BoundarySpec& spec, const Vec2& force, std::ostream& out) {
  out << (spec.pressure || spec.traction ? "  load      " : "  support   ") << joined(spec.on) << ":";
  if (spec.displacement_x) out << " u_x = " << *spec.displacement_x;
  if (spec.displacement_y) out << (spec.displacement_x ? "," : "") << " u_y = " << *spec.displacement_y;
  if (spec.pressure) out << " pressure " << *spec.pressure;
  if (spec.traction) out << " traction " << pair_of(*spec.traction);
  if (spec.pressure || spec.traction) out << ", in sum " << pair_of(force);
  out << "\n";
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
  out << "  model     plane " << to_string(scene.plane);
  print_materials(scene, out);
  out << "\n";
  for (std::size_t i = 0; i < scene.boundaries.size(); ++i)
    print_boundary(scene.boundaries[i], d.boundary_sums[i], out);
  for (std::size_t i = 0; i < scene.body_forces.size(); ++i)
    out << "  load      body " << scene.body_forces[i].body << ": force per volume "
        << pair_of(scene.body_forces[i].force) << ", in sum " << pair_of(d.body_sums[i]) << "\n";
  for (const InitialStrainSpec& s : scene.initial_strains) {
    out << "  load      body " << s.body << ": ";
    if (s.temperature_change)
      out << "temperature change " << *s.temperature_change << "\n";
    else
      out << "initial strain xx " << s.strain(0) << ", yy " << s.strain(1) << ", zz " << s.strain(2) << ", xy "
          << s.strain(3) << "\n";
  }
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
  return {{"plane", to_string(scene.plane)},
          {"materials", materials},
          {"bodies", bodies},
          {"supports", supports},
          {"loads", loads}};
}

}  // namespace mortise
