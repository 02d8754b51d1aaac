// The charted problems: a scene, its mesh, and what is known of the answer.
#pragma once

#include <optional>

#include "app/solve_scene.hpp"
#include "support/field_errors.hpp"

namespace mortise::chart {

/// Exact or reference contact pressure at a place of the contact line; stress, compression positive.
using Pressure = std::function<double(const Vec2& x)>;

struct Problem {
  Scene scene;
  Mesh mesh;
  std::optional<test::Field> exact;  ///< nothing where only a reference is known
  Pressure pressure;                 ///< empty where nothing is known
};

/// `name`: "manufactured" (manufactured.toml: the exact field of tests/support), "rings" (Lame), "parabola_1".
/// `settings`: the scene's keys, and of the two plates `chart.grading`, with which graded_plates makes the mesh.
/// `reference`: a CSV of x,p along the contact line of parabola_1; may be empty.
/// Throws InputError for bad settings, std::runtime_error for an unknown name.
Problem make_problem(const std::string& name, std::vector<Override> settings, const std::string& reference);

}  // namespace mortise::chart
