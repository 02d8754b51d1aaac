// summary.json and the terminal's summary: the same facts, once for programs and once for people.
#pragma once

#include <nlohmann/json.hpp>

#include "app/solve_scene.hpp"

namespace mortise {

/// The keys of summary.json (docs/files.md). Figures that are not finite become null.
nlohmann::ordered_json summary_json(const Scene& scene, const Results& results);

}  // namespace mortise
