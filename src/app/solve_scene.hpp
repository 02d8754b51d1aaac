// One scene from data to results.
#pragma once

#include <functional>

#include "app/contact_results.hpp"
#include "app/discretisation.hpp"
#include "app/stress_comparison.hpp"
#include "ddm/interface.hpp"
#include "fem/stress.hpp"
#include "solve/saddle_point.hpp"

namespace mortise {

/// In the order of severity.
enum class Status { solved, check_failed, not_converged };
std::string to_string(Status status);

/// One figure that must stay below its limit.
struct Check {
  std::string name;
  double value;
  double limit;
  bool ok() const { return value <= limit; }  // NaN fails
};

/// Seconds of the stages, summary.json "seconds".
struct Seconds {
  double mesh = 0, assemble = 0, couple = 0, factorise = 0, solve = 0, recover = 0, write = 0;
  double total() const { return mesh + assemble + couple + factorise + solve + recover + write; }
};

/// Where contact was closed, for a later run on the same mesh to start from.
struct ActiveSet {
  Points nodes;              ///< of the mesh
  std::vector<int> node;     ///< of each row: where its first multiplier sits
  std::vector<char> active;  ///< of each row
};

/// How domain decomposition found the interface.
struct InterfaceRun {
  std::vector<std::string> dirichlet;  ///< bodies that took the displacement
  Acceleration acceleration;
  double beta;        ///< 0 where none was used
  Spectrum spectrum;  ///< of the interface, where it was needed
  double factor;      ///< by which a step reduced the residuals in the end
  std::vector<RelaxationStep> history;
};

/// How well the displacements control the multipliers (diagnose).
struct InfSupReport {
  double beta;    ///< inf-sup constant, dimensionless
  Vec2 position;  ///< where the worst pressure is largest
};

/// How the iterative solver found the solution.
struct LinearRun {
  int steps;
  double factor;                   ///< by which a step multiplied the residual in the end
  double tau_border;               ///< tau must be below; 0 where any will do (accelerated)
  std::vector<Residuals> history;  ///< before each step, and at the end
};

/// Everything a run knows at its end.
struct Results {
  Status status = Status::solved;
  Mesh mesh;
  BodyPoints points;
  Discretisation discretisation;
  std::vector<ContactPair> pairs;
  VecX u;  ///< 2 x nodes, length
  StressField stress;
  std::vector<ContactResults> contacts;                          ///< one a pair
  std::vector<std::optional<StressComparison>> against_sigma_n;  ///< one a pair; nothing where not compared
  double energy = 0;                                             ///< strain energy per thickness
  int unknowns = 0;                                              ///< free displacement unknowns
  int multipliers = 0;                                           ///< rows of the coupling
  std::vector<char> active;                                      ///< of each row: closed (always so in bilateral pairs)
  std::vector<ActiveSetStep> steps;                              ///< one a solve of the contact problem
  int coarse_steps = 0;                                          ///< and on joined rows
  std::optional<InterfaceRun> interface;                         ///< where method.kind is ddm
  std::optional<InfSupReport> inf_sup;                           ///< where the run was asked to diagnose
  std::optional<LinearRun> linear;                               ///< where method.solver is mssor
  Seconds seconds;
  std::vector<Check> checks;
  std::vector<std::string> notes;  ///< what a user should know; nothing that fails
};

/// Called as each stage begins, with its name.
using Progress = std::function<void(const std::string& stage)>;

/// Reads or makes the mesh and solves. Throws InputError for bad input, and where nothing holds a body.
/// `start`: the active set to start from; all rows closed where there is none, or it belongs to another mesh.
Results solve_scene(const Scene& scene, const Progress& progress = {}, const ActiveSet* start = nullptr);

/// Changes the equations of the bodies before they are solved: loads and prescribed displacements that no scene file
/// can say, such as functions of the place.
using Adjust = std::function<void(const Mesh& mesh, Discretisation& discretisation)>;

/// The same on a mesh that is already there. `adjust` is called when the scene has been discretised.
Results solve_scene(const Scene& scene, Mesh mesh, const Progress& progress = {}, const ActiveSet* start = nullptr,
                    const Adjust& adjust = {});

ActiveSet active_set(const Results& results);

/// A scene that was meshed and validated, but not solved.
struct CheckedScene {
  Mesh mesh;
  Discretisation discretisation;
  std::vector<ContactPair> pairs;
  std::vector<std::string> warnings;  ///< of the audit
};

/// Everything solve_scene would refuse before it factorises, refused. Throws InputError as it does.
CheckedScene check_scene(const Scene& scene);

}  // namespace mortise
