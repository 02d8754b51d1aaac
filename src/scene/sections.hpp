// The sections of a scene file, each read and checked by a function of its own.
// All take the document (after overrides) and write their part of `scene`; all throw InputError.
#pragma once

#include "scene/document.hpp"
#include "scene/scene.hpp"

namespace mortise::scene_file {

/// [mesh]: the file, which must exist, and the parameters of a .geo.
void read_mesh_section(const Node& root, Scene& scene);

/// [[copies]]: where each copy of a body stands, one by one.
void read_copies(const Node& root, Scene& scene);

/// [fields]: names that expressions may use, and the files that their values are in. Before whatever may be one.
void read_fields(const Node& root, Scene& scene);

/// A table [materials.NAME].
Material read_material(const Node& node);

/// [materials.NAME] and [bodies]: every body has a material, every material a body.
void read_bodies(const Node& root, Scene& scene);

/// [[boundary]]: on each curve at most one load, and each displacement component once. After read_bodies.
void read_boundaries(const Node& root, Scene& scene);

/// [[body_force]] and [[initial_strain]]: each body once in either. After read_bodies.
void read_body_forces(const Node& root, Scene& scene);
void read_initial_strains(const Node& root, Scene& scene);

/// [[contact]]: pairs of two curves, each curve in one pair only.
void read_contacts(const Node& root, Scene& scene);

/// [[probe]]: points, or equal steps along a line.
void read_probes(const Node& root, Scene& scene);

/// [method]. After read_bodies.
void read_method(const Node& root, Scene& scene);

/// [accuracy]. After read_mesh_section, read_copies and read_contacts.
void read_accuracy(const Node& root, Scene& scene);

}  // namespace mortise::scene_file
