// A scene in its mesh: every name resolved, every equation there. Nothing that comes after reads the scene.
#pragma once

#include "mesh/body_points.hpp"
#include "model/expectation.hpp"
#include "model/method.hpp"
#include "model/probe_spec.hpp"
#include "problem/contact_curves.hpp"
#include "problem/contact_pair.hpp"
#include "problem/data_misfit.hpp"
#include "problem/discretisation.hpp"
#include "problem/probe_places.hpp"
#include "problem/starting_rows.hpp"
#include "problem/validate.hpp"

namespace mortise {

struct Scene;

struct Problem {
  std::string title, scene;          ///< the scene's title, and the path of its file
  std::vector<std::string> changes;  ///< of the scene: KEY=VALUE of each `--set`
  std::string load_case;             ///< its case's name, empty of a scene without
  Method method;
  std::optional<double> accuracy;  ///< that is asked for, where the mesh is one of those that [accuracy] makes
  std::vector<FieldSpec> fields;   ///< functions of place from files
  Mesh mesh;                       ///< with its ties
  BodyPoints points;
  Entries entries;
  Discretisation discretisation;  ///< with the rows of all pairs
  DataMisfits misfits;            ///< of the functions of place
  std::vector<ContactPair> pairs;
  std::vector<PatternSides> patterns;  ///< that may have more pairs (results/audit_solution.hpp)
  VecX fluid;                   ///< m: pressure of the fluid in wet rows, stress, 0 in dry ones; empty: no pair has any
  SparseRows fluid_loads;       ///< m x n: forces on both faces of unit pressure in each row, where a pair has any
  std::vector<char> dirichlet;  ///< of domain decomposition: whether a body takes the displacement
  Floating floating;            ///< what only contact holds
  Floating held;                ///< what nothing holds and no load drives, held
  std::vector<int> idle;        ///< unknowns at which it is held, or what contact lets go as it opens: no supports
  std::vector<ProbePlace> probes;
  std::vector<Expectation> expectations;
  std::vector<std::string> warnings;  ///< of the mesh and the audit, and of motions held
  double assemble_seconds = 0, couple_seconds = 0;
};

/// Called as each stage begins, with its name.
using Progress = std::function<void(const std::string& stage)>;

/// All that `check` says and `solve` needs; `start`: where contact is closed at first. Throws SceneError for what
/// cannot be meant or has no solution, before anything is factorised.
Problem prepare(const Scene& scene, Mesh mesh, const Progress& progress = {}, const ActiveSet* start = nullptr);

}  // namespace mortise
