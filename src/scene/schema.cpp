#include "scene/schema.hpp"

#include <limits>

#include "scene/sections.hpp"

namespace mortise::scene_file {
namespace {

Section table(const std::string& name, const Keys& keys) {
  return {name, object_of(keys), markdown_rows(keys, name + ".")};
}

/// [[NAME]]: entries, each with these keys, of which exactly one of some groups is there.
Section entries_of(const std::string& name, const std::string& words, const Keys& keys,
                   const std::vector<std::vector<std::string>>& groups = {}) {
  return {name,
          {{"description", words}, {"type", "array"}, {"items", object_of(keys, groups)}},
          "| `[[" + name + "]]` | " + words + " | none |\n" + markdown_rows(keys, name + ".")};
}

Json any_name(const Json& schema) { return {{"type", "object"}, {"additionalProperties", schema}}; }

/// A table of tables with these keys under names of the user's.
Section named(const std::string& name, const Keys& keys, const std::vector<std::vector<std::string>>& groups = {}) {
  return {name, any_name(object_of(keys, groups)), markdown_rows(keys, name + ".NAME.")};
}

Section fields_section(FieldSpec& field) {
  Section fields = named("fields", field_keys(field));
  fields.schema["propertyNames"] = {{"pattern", "^[A-Za-z_][A-Za-z0-9_]*$"}};
  fields.rows =
      "| `[fields]` | values at points of a file, as functions of place that expressions may name by these names "
      "([below](#values-from-a-file)) | none |\n" +
      fields.rows;
  return fields;
}

Section constants_section() {
  Section constants{
      "constants", any_name({{"type", "number"}}),
      "| `[constants]` | numbers that expressions may name: `[constants] c = 1e-3` and `\"c * x^2\"` | none "
      "|\n"};
  constants.schema["propertyNames"] = {{"pattern", "^[A-Za-z_][A-Za-z0-9_]*$"}};
  return constants;
}

// An entry's other keys are the scene's.
Section case_section(CaseEntry& entry) {
  Section cases = entries_of(
      "case",
      "load cases, each a row of cases.csv, on one mesh and one factor where only loads differ ([below](#cases))",
      case_keys(entry));
  cases.schema["items"]["additionalProperties"] = true;
  cases.rows +=
      "| `case.KEY` | any key of the scene, as in `--set`: what is another value in this case, such as "
      "`boundary.2.pressure = 2e6`; of a table the keys that it has | the scene's own |\n";
  return cases;
}

std::vector<std::vector<std::string>> each_alone(const std::vector<std::string>& names) {
  std::vector<std::vector<std::string>> groups;
  for (const std::string& name : names) groups.push_back({name});
  return groups;
}

// On one line if it fits, as a page has it.
std::string written(const Json& json, std::size_t indent) {
  const std::string line = json.dump();
  if (!json.is_structured() || indent + line.size() <= 118) return line;
  const std::string begin = "\n" + std::string(indent + 2, ' ');
  std::string text;
  for (const auto& [name, value] : json.items()) {
    const std::string label = json.is_object() ? Json(name).dump() + ": " : "";
    text += (text.empty() ? "" : ",") + begin + label + written(value, indent + 2);
  }
  const std::string end = "\n" + std::string(indent, ' ');
  return json.is_object() ? "{" + text + end + "}" : "[" + text + end + "]";
}

// The rows bind to what is made here, and are pages before it goes.
std::vector<Section> all_sections() {
  Scene scene;
  CopiesEntry copies;
  FieldSpec field;
  Material material;
  BoundarySpec boundary;
  BodyForceSpec body_force;
  InitialStrainSpec initial_strain;
  ContactSpec contact;
  ProbeSpec probe;
  Expectation expectation;
  AccuracySpec accuracy;
  CaseEntry case_entry;
  return {
      {"title", a_text().schema, "| `title` | text | empty |\n"},
      table("mesh", mesh_keys(scene)),
      entries_of("copies",
                 "copies of bodies of the mesh file, which stand in their place ([below](#many-bodies-alike))",
                 copies_keys(copies), each_alone({"grid", "places", "ring"})),
      constants_section(),
      fields_section(field),
      table("model", model_keys(scene)),
      named("materials", material_keys(material), {{"young", "poisson"}, {"stiffness"}}),
      {"bodies", any_name(a_name().schema),
       "| `[bodies]` | table: physical surface, or a pattern of them = material. What contact alone holds is a surface "
       "of its own, not a piece of one | required |\n"},
      entries_of("boundary", "supports and loads", boundary_keys(boundary), each_alone(boundary_conditions)),
      entries_of("body_force", "forces per volume", body_force_keys(body_force, {})),
      entries_of("initial_strain", "strains without stress", initial_strain_keys(initial_strain),
                 each_alone({"temperature_change", "strain"})),
      entries_of("contact", "pairs of curves in contact", contact_keys(contact, {})),
      entries_of("probe", "places at which displacement and stress are written to probes.csv ([below](#probescsv))",
                 probe_keys(probe), {{"at"}, {"from", "to", "points"}}),
      entries_of("expect", "what results should be: exit status 2 if one is not", expectation_keys(expectation, {}),
                 {{"figure", "value"}, {"pressure"}}),
      table("method", method_keys(scene.method)),
      table("accuracy", accuracy_keys(accuracy, std::numeric_limits<int>::max())),
      case_section(case_entry),
      table("cases", cases_keys(scene)),
  };
}

}  // namespace

const std::vector<Section>& sections() {
  static const std::vector<Section> all = all_sections();
  return all;
}

std::string scene_schema() {
  Json schema{
      {"$schema", "http://json-schema.org/draft-07/schema#"},
      {"title", "A scene of mortise"},
      {"description",
       "Two-dimensional frictionless contact. Units are the scene's, used throughout. Made from the keys by which "
       "the program reads; docs/files.md says the same as a table."},
      {"type", "object"},
      {"additionalProperties", false},
      {"required", {"mesh", "materials", "bodies"}}};
  for (const Section& section : sections()) schema["properties"][section.name] = section.schema;
  return written(schema, 0) + "\n";
}

std::string key_table() {
  std::string table;
  for (const Section& section : sections()) table += section.rows;
  return table;
}

}  // namespace mortise::scene_file
