// All that a scene file may say, as pages: scene.schema.json and the table of docs/files.md, from the rows by which
// the sections are read.
#pragma once

#include <string>
#include <vector>

#include "scene/keys.hpp"

namespace mortise::scene_file {

/// A key at the top of a scene.
struct Section {
  std::string name;
  Json schema;
  std::string rows;  ///< of the table of docs/files.md
};

/// In the order of the page.
const std::vector<Section>& sections();

/// scene.schema.json: JSON Schema, draft 7.
std::string scene_schema();

/// The table of docs/files.md, without its head.
std::string key_table();

}  // namespace mortise::scene_file
