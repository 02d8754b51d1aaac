#include <map>
#include <sstream>

#include "base/printable.hpp"
#include "results/report_text.hpp"

namespace mortise {
namespace {

std::string pair_of(const Json& v) { return worded("(", v[0].get<double>(), ", ", v[1].get<double>(), ")"); }

std::string listed_numbers(const Json& numbers) {
  std::ostringstream text;
  for (std::size_t i = 0; i < numbers.size(); ++i) text << (i == 0 ? "" : ", ") << numbers[i].get<double>();
  return text.str();
}

std::string material_words(const Json& m, bool gravity) {
  std::ostringstream out;
  if (m.contains("stiffness"))
    out << "a stiffness matrix";
  else if (m.contains("shear"))
    out << "E " << listed_numbers(m["young"]) << ", nu " << listed_numbers(m["poisson"]) << ", G "
        << m["shear"].get<double>() << ", at " << m["angle"].get<double>() << " degrees";
  else
    out << "E " << m["young"].get<double>() << ", nu " << m["poisson"].get<double>();
  if (const double alpha = m["thermal_expansion"]; alpha != 0) out << ", alpha " << alpha;
  if (gravity) out << ", density " << m["density"].get<double>();
  return out.str();
}

void print_materials(const Json& model, std::ostream& out) {
  std::map<std::string, std::vector<std::string>> bodies;
  for (const auto& [body, material] : model["bodies"].items()) bodies[material].push_back(body);
  for (const auto& [name, m] : model["materials"].items())
    out << "; " << name << " (" << material_words(m, m.contains("density")) << "): " << listed(bodies[name]);
}

// `force`: the key of it. Of rings the force alone: round the ring moments are in balance.
std::string in_sum(const Json& entry, const char* force, bool rings) {
  std::ostringstream text;
  text << pair_of(entry[force]);
  if (!rings) text << ", moment " << entry["moment"].get<double>() << " about (0, 0)";
  return text.str();
}

// Of the curves that the entry names, one by one if they are few.
std::string reaction_words(const Json& support, bool rings) {
  if (!support.contains("reaction")) return "";
  std::ostringstream text;
  if (const auto rigid = support.find("rigid"); rigid != support.end()) {
    text << "; moves by " << pair_of((*rigid)["displacement"]);
    if (!rings) text << ", turns by " << (*rigid)["turned"].get<double>();
  }
  const Json curves = support.value("curves", Json::array());
  if (support.contains("rigid") || curves.size() == 1 || curves.size() != support["on"].size() ||
      curves.size() > told_in_full)
    return text.str() + "; reaction " + in_sum(support, "reaction", rings);
  std::vector<std::string> forces;
  for (const Json& curve : curves) forces.push_back(pair_of(curve["reaction"]));
  return "; reactions " + listed(forces);
}

// Entries that prescribe the same as one, in the order of the first, with the sum of their forces.
Json alike_as_one(const Json& entries, const char* force) {
  Json merged = Json::array();
  std::map<std::string, std::size_t> number;
  for (const Json& entry : entries) {
    const auto [found, is_new] = number.try_emplace(entry["words"], merged.size());
    if (is_new) {
      merged.push_back(entry);
      merged.back().erase("curves");
      continue;
    }
    Json& one = merged[found->second];
    for (const Json& name : entry["on"]) one["on"].push_back(name);
    if (!entry.contains(force)) continue;
    for (std::size_t i = 0; i < 2; ++i) one[force][i] = one[force][i].get<double>() + entry[force][i].get<double>();
    one["moment"] = one["moment"].get<double>() + entry["moment"].get<double>();
  }
  return merged;
}

std::string support_line(const Json& support, bool rings) {
  return "  support   " + listed(support["on"]) + ": " + support["words"].get<std::string>() +
         reaction_words(support, rings) + "\n";
}

std::string load_line(const Json& load, bool rings) {
  const std::string on = load.contains("on")     ? listed(load["on"]) + ": "
                         : load.contains("body") ? "body " + load["body"].get<std::string>() + ": "
                                                 : "";
  return "  load      " + on + load["words"].get<std::string>() +
         (load.contains("sum") ? ", in sum " + in_sum(load, "sum", rings) : "") + "\n";
}

// Each by `line`, of many the first ones.
template <typename Line>
void print_some(const Json& entries, const std::string& what, std::ostream& out, Line line) {
  const std::size_t told = entries.size() > told_in_full ? told_of_many : entries.size();
  for (std::size_t i = 0; i < told; ++i) out << line(entries[i]);
  if (told < entries.size())
    out << "            " << entries.size() - told << " more " << what << ": summary.json has all\n";
}

std::string tie_line(const Json& tie) {
  std::ostringstream out;
  const std::string follows = tie["follows"];
  out << "  tied      " << follows << " follows " << tie["leads"].get<std::string>();
  if (tie.contains("turned")) out << ", turned by " << tie["turned"].get<double>() << " degrees,";
  out << " at " << tie["nodes"] << " nodes";
  if (tie.contains("force")) out << "; force " << pair_of(tie["force"]) << " on " << follows;
  if (tie.contains("tension"))
    out << "; overlap " << tie["overlap"].get<double>() << ", tension " << tie["tension"].get<double>();
  out << "\n";
  return out.str();
}

std::string field_line(const std::string& name, const Json& field) {
  std::string text = "  field     " + name + ": " + printable(field["values"]);
  if (field.contains("component")) text += "[" + field["component"].dump() + "]";
  return text + " of " + printable(field["file"]) + "\n";
}

}  // namespace

std::string model_text(const Json& model) {
  std::ostringstream out;
  const bool rings = !model.contains("thickness");
  out << "  model     plane " << model["plane"].get<std::string>();
  if (const double thickness = model.value("thickness", 1.0); thickness != 1) out << ", thickness " << thickness;
  print_materials(model, out);
  out << "\n";
  Json on_boundaries = Json::array(), others = Json::array();
  for (const Json& load : model["loads"]) (load.contains("on") ? on_boundaries : others).push_back(load);
  Json supports = model["supports"];
  if (supports.size() + on_boundaries.size() > told_in_full) {
    supports = alike_as_one(supports, "reaction");
    on_boundaries = alike_as_one(on_boundaries, "sum");
  }
  const auto as_load = [&](const Json& load) { return load_line(load, rings); };
  print_some(supports, "supports", out, [&](const Json& support) { return support_line(support, rings); });
  print_some(model.value("ties", Json::array()), "ties", out, tie_line);
  print_some(on_boundaries, "loads on boundaries", out, as_load);
  print_some(others, "loads on bodies", out, as_load);
  Json fields = Json::array();
  if (model.contains("fields"))
    for (const auto& [name, field] : model["fields"].items()) fields.push_back({name, field});
  print_some(fields, "fields", out, [](const Json& named) { return field_line(named[0], named[1]); });
  return out.str();
}

}  // namespace mortise
