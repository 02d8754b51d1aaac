// A scene as plain data: what the user's .toml says, checked for sense but not yet against a mesh.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/body_copy.hpp"
#include "model/body_specs.hpp"
#include "model/boundary_spec.hpp"
#include "model/contact_spec.hpp"
#include "model/expectation.hpp"
#include "model/geo_limits.hpp"
#include "model/method.hpp"
#include "model/model.hpp"
#include "model/probe_spec.hpp"

namespace mortise {

struct LoadCase;

/// What of cases is written besides their table: nothing, what runs along the contact lines, or all.
MORTISE_WORDS(CaseFiles, table, contact, all)

/// Units are the user's own, used throughout (SI if E is in Pa and lengths in m).
struct Scene {
  std::string path;                  ///< the .toml, for messages
  std::vector<std::string> changes;  ///< KEY=VALUE of each `--set`, for the report
  std::string load_case;             ///< the name of the [[case]] that it is; empty: the scene itself
  std::string title;
  std::string mesh_file;  ///< absolute or relative to the working directory
  std::map<std::string, double> mesh_parameters;
  GeoLimits geo_limits;
  std::vector<BodyCopy> copies;             ///< of bodies of the mesh file, in their place
  std::map<std::string, double> constants;  ///< that expressions name
  std::vector<FieldSpec> fields;
  Model model;
  std::optional<Vec2> gravity;  ///< acceleration: the force per volume is density times it
  std::map<std::string, Material> materials;
  std::vector<BodySpec> bodies;
  std::vector<BoundarySpec> boundaries;
  std::vector<BodyForceSpec> body_forces;
  std::vector<InitialStrainSpec> initial_strains;
  std::vector<ContactSpec> contacts;
  std::vector<ContactSpec> ties;  ///< the [[contact]] entries of Condition::tied
  std::vector<ProbeSpec> probes;
  std::vector<Expectation> expectations;
  Method method;
  std::optional<AccuracySpec> accuracy;  ///< none: the mesh is the file's
  std::vector<LoadCase> cases;           ///< none: the scene itself is solved
  CaseFiles case_files = CaseFiles::table;
};

/// One case of [[case]]: the scene with some of its values changed, and its loads times `scale`.
struct LoadCase {
  std::string name;  ///< of letters, digits and _ - + . that may name a folder
  double scale = 1;
  std::vector<std::pair<std::string, std::string>> changed;  ///< dotted keys and what they are here, in words
  Scene scene;                                               ///< that it is, without cases
};

/// One `--set KEY=VALUE`, e.g. {"contact.0.multipliers_on", "lower_contact"}.
struct Override {
  std::string key;
  std::string value;
};

/// "KEY=VALUE" split at the first '='. Throws InputError if there is none or the key is empty.
Override parse_override(const std::string& text);

/// Reads and checks a scene file, with `--set` overrides applied before the checks.
/// Throws InputError naming the file, the line or override, the value and what was expected.
Scene read_scene(const std::string& path, const std::vector<Override>& overrides = {});

}  // namespace mortise
