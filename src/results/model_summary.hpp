// What a scene models, in words and as JSON: plane, materials, supports, loads.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "results/reactions.hpp"

namespace mortise {

/// Lines for the terminal, a support or load each, with the sums of the loads and, where they are known, the reactions
/// (times depth, model/model.hpp).
std::string model_lines(const Problem& problem, const Reactions* reactions = nullptr);

/// What an entry prescribes, wherever: "u_x = 0, u_y = 0".
std::string words_of(const BoundaryCondition& what);

/// The number, or the expression as it is written.
nlohmann::ordered_json json_of(const Field& field);

/// summary.json "model": docs/files.md.
nlohmann::ordered_json model_json(const Problem& problem, const Reactions& reactions);

}  // namespace mortise
