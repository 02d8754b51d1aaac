// How a scene is solved, and how well.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "model/choices.hpp"

namespace mortise {

/// [method]. The options of a solver count only where it is chosen.
struct Method {
  Integration integration = Integration::segments;
  Normals normals = Normals::curve;
  Multipliers multipliers = Multipliers::linear;  ///< on 2-node edges quadratic means linear
  std::optional<Solver> solver;                   ///< none: direct, or feti where it is faster (app/solve_system.hpp)
  MssorOptions mssor;
  FetiOptions feti;
  DdmOptions ddm;
  std::vector<std::string> dirichlet;  ///< of ddm: bodies that take the displacement; default: the softer ones

  bool operator==(const Method&) const = default;
};

/// [accuracy]: what the pressure is to be right to, on a mesh that is found for it.
struct AccuracySpec {
  Goal of = Goal::pressure;
  int pair = 0;                ///< of mean and force: the [[contact]] entry, ties not counted
  Vec2 window = Vec2::Zero();  ///< of mean: from, to, arc length s as in contact.csv
  Vec2 at = Vec2::Zero();      ///< of displacement and stress: the place,
  std::string body;            ///< and the body that has it; empty: the only one
  double value = 0;            ///< asked, relative, > 0 and < 1
  double exclude = 0.1;        ///< of the loaded length, on either side of a singular point: left out of the norm
  int unknowns_max = 1000000;
  int solves_max = 8;
  int first_edges = 20;    ///< of the first mesh along each contact curve
  bool recombine = false;  ///< quadrilaterals instead of triangles

  bool operator==(const AccuracySpec&) const = default;
};

}  // namespace mortise
