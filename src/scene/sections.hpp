// The sections of a scene file: of each its rows of the table of keys, and a function that reads it by them and checks
// what rows cannot say, such as keys that exclude each other.
// Readers take the document (after overrides) and write their part of `scene`; all throw InputError.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "scene/keys.hpp"
#include "scene/scene.hpp"

namespace mortise::scene_file {

/// [mesh]: the file, which must exist, and the parameters of a .geo.
Keys mesh_keys(Scene& scene);
void read_mesh_section(const Node& root, Scene& scene);

/// [model]. Read by read_scene.
Keys model_keys(Scene& scene);

/// One entry of [[copies]], but for the places.
struct CopiesEntry {
  std::vector<std::string> bodies;
  std::string name;  ///< a pattern
  Vec2 centre = Vec2::Zero();
};

/// [[copies]]: where each copy of a body stands, one by one.
Keys copies_keys(CopiesEntry& copies);
void read_copies(const Node& root, Scene& scene);

/// [constants]: numbers that expressions may name. Before whatever may be one.
void read_constants(const Node& root, Scene& scene);

/// [fields]: names that expressions may use, and the files that their values are in. Before whatever may be one.
Keys field_keys(FieldSpec& field);
void read_fields(const Node& root, Scene& scene);

/// The names in [constants] and [fields] of documents that belong together, and the words that any text in the rest of
/// them has: a scene after overrides, and each of its cases. A name is used where it is a word.
struct GivenNames {
  std::map<std::string, Node> constants, fields;
  std::set<std::string> words;

  void take(const Node& root);
  /// Refuses a name that nothing uses: a slip of the pen, that would change nothing. `overridden`: the command line may
  /// have put something else in the place of what used a name of the file.
  void require_used(bool overridden) const;
};

/// A table [materials.NAME]; of an isotropic material what is needed.
Keys material_keys(Material& material);
Keys isotropic_keys(Material& material);
Material read_material(const Node& node);

/// [materials.NAME] and [bodies]: every body has a material, every material a body.
void read_bodies(const Node& root, Scene& scene);

/// [[boundary]]: on each curve at most one load, and each displacement component once. After read_bodies.
Keys boundary_keys(BoundarySpec& boundary);
extern const std::vector<std::string> boundary_conditions;
void read_boundaries(const Node& root, Scene& scene);

/// [[body_force]] and [[initial_strain]]: each body once in either. After read_bodies.
Keys body_force_keys(BodyForceSpec& spec, const FieldUse& use);
Keys initial_strain_keys(InitialStrainSpec& spec);
void read_body_forces(const Node& root, Scene& scene);
void read_initial_strains(const Node& root, Scene& scene);

/// [[contact]]: pairs of two curves, each curve in one pair only.
Keys contact_keys(ContactSpec& contact, const FieldUse& use);
void read_contacts(const Node& root, Scene& scene);

/// [[probe]]: points, or equal steps along a line.
Keys probe_keys(ProbeSpec& probe);
void read_probes(const Node& root, Scene& scene);

/// [[expect]]: what figures or pressures should be.
Keys expectation_keys(Expectation& expectation, const FieldUse& use);
void read_expectations(const Node& root, Scene& scene);

/// [method]. After read_bodies.
Kind<Solver> solver_word();
Keys method_keys(Method& method);  ///< the iteration's rows are those of method.solver
void read_method(const Node& root, Scene& scene);

/// [accuracy]. After read_mesh_section, read_copies and read_contacts.
Keys accuracy_keys(AccuracySpec& accuracy, int last_pair);
void read_accuracy(const Node& root, Scene& scene);

/// One entry of [[case]], but for what it changes: every other key is one of the scene's.
struct CaseEntry {
  std::string name, file;
};

/// [cases], and [[case]]: each the scene as `read_scene` reads it from a document with the case's changes.
Keys cases_keys(Scene& scene);
Keys case_keys(CaseEntry& entry);
void read_cases(const Node& root, const std::function<Scene(const Node&)>& read_scene, Scene& scene);

}  // namespace mortise::scene_file
