// What a scene models, in words and as JSON: plane, materials, supports, loads.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "problem/discretisation.hpp"

namespace mortise {

/// Lines for the terminal, a support or load each, with the sums of the loads' forces (per thickness).
std::string model_lines(const Scene& scene, const Discretisation& discretisation);

/// The number, or the expression as it is written.
nlohmann::ordered_json json_of(const Field& field);

/// summary.json "model": docs/files.md.
nlohmann::ordered_json model_json(const Scene& scene, const Discretisation& discretisation);

}  // namespace mortise
