// The loads of fem/assembly.hpp with quadrature as fine as the functions that they are made of. Code: fem/assembly.cpp.
#pragma once

#include "fem/line_cuts.hpp"
#include "fem/material.hpp"
#include "mesh/mesh.hpp"
#include "model/resultant.hpp"

namespace mortise {

/// The rule for functions of place on a cell (fem/cell_cuts.hpp); no points: its own, there are none.
using CellRules = std::function<CellRule(const Cell&)>;

/// load += int B^T C : eps0, for the bodies whose law has an initial strain. Returns int 1/2 eps0 : C : eps0, the
/// energy of these held at zero strain.
double add_initial_strain(const Mesh& mesh, const std::vector<ElasticLaw>& laws, const CellRules& rules, VecX& load);

/// As the functions of these names in assembly.hpp; empty `rules` and `cuts`: the same as they.
Resultant add_body_forces(const Mesh& mesh, const Model& model,
                          const std::vector<std::function<Vec2(const Vec2& position)>>& forces, const CellRules& rules,
                          VecX& load);
Resultant add_traction(const Mesh& mesh, const Model& model, const CutSides& on,
                       const std::function<Vec2(const Vec2& position, const Vec2& normal)>& traction, VecX& load);

}  // namespace mortise
