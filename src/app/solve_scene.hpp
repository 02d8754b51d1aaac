// One scene from data to results.
#pragma once

#include <memory>

#include "app/short_edges.hpp"
#include "results/results.hpp"
#include "scene/scene.hpp"

namespace mortise {

/// What `work` returns; what it refuses of the scene is told with the scene's path.
template <typename Work>
decltype(auto) told_with_path(const Scene& scene, Work work) {
  try {
    return work();
  } catch (const EdgesTooLong& error) {
    throw EdgesTooLong(scene.path + ": " + error.what(), error.wanted);
  } catch (const SceneError& error) {
    throw InputError(scene.path + ": " + error.what());
  }
}

/// Reads or makes the mesh, with the copies in it. `cached`: as of load_mesh. Throws InputError.
Mesh scene_mesh(const Scene& scene, bool* cached = nullptr);

/// Reads or makes the mesh and solves. Throws InputError for bad input, and where nothing holds a body.
/// `start`: the active set to start from, each row from the nearest one; all rows closed where there is none, or it
/// is of other pairs.
Results solve_scene(const Scene& scene, const Progress& progress = {}, const ActiveSet* start = nullptr);

/// The same on a mesh that is already there.
Results solve_scene(const Scene& scene, Mesh mesh, const Progress& progress = {}, const ActiveSet* start = nullptr);

class SystemSolver;

/// Solves scenes one after another. One that differs from the one before in loads alone (scene/loads.hpp) has its mesh,
/// its equations and, by the direct solver, its factor; it starts from the rows that were closed there.
class CaseSolver {
 public:
  /// `mesh`: of all scenes, where it is there already; else each has the one that it names.
  explicit CaseSolver(std::optional<Mesh> mesh = {});
  ~CaseSolver();
  CaseSolver(const CaseSolver&) = delete;
  CaseSolver& operator=(const CaseSolver&) = delete;

  /// What solve_scene returns; it stays here until the next call. Throws as solve_scene.
  Results& solve(const Scene& scene, const Progress& progress = {});
  /// The next scene starts from no known rows.
  void forget_rows() { start_.reset(); }
  /// How many of those solved had the factor of one before.
  int shared() const { return shared_; }

 private:
  bool take(const Scene& scene);
  void begin(const Scene& scene, std::optional<Mesh> known, const Progress& progress);

  std::optional<Mesh> mesh_;
  std::optional<Scene> scene_;  // that what is kept is of; none: nothing is kept
  Results results_;
  std::vector<char> fixed_;            // of the system as it was factorised
  std::vector<std::string> warnings_;  // of the problem
  std::optional<ActiveSet> start_;
  std::unique_ptr<SystemSolver> solver_;
  int shared_ = 0;
};

/// The estimated error into the results, and a warning where it is large. `found`: as of estimate_error; `last`:
/// whether they are to be shown, with bars of forces and lengths in contact and p*. Throws SceneError as estimate_error
/// does, and where spec asks for a displacement that nothing holds.
void estimate(Results& results, const AccuracySpec& spec = {}, const std::vector<FoundPoint>& found = {},
              bool last = true);

/// The inf-sup constant into the results, and a warning where it is small.
void diagnose(Results& results);

ActiveSet active_set(const Results& results);

/// Everything solve_scene would refuse before it factorises, refused. Throws InputError as it does.
Problem check_scene(const Scene& scene);

}  // namespace mortise
