// Everything a run knows at its end.
#pragma once

#include <limits>

#include "error/error_estimate.hpp"
#include "results/audit_memory.hpp"
#include "results/recovery.hpp"

namespace mortise {

/// In the order of severity.
MORTISE_WORDS(Status, solved, accuracy_not_reached, check_failed, not_converged)

/// One figure that must stay below its limit.
struct Check {
  std::string name;
  double value;
  double limit;
  std::string where = {};  ///< of one that fails: the place that a user would look at, and what is there
  bool ok() const { return value <= limit; }  // NaN fails
};

/// A figure that the scene expects.
struct ExpectedFigure {
  Expectation of;
  std::string name;     ///< of the figure, for messages
  double found;         ///< NaN of a pressure along a pair, and where there is none
  double off;           ///< from the value, a part of it; NaN where it is not known
  std::string trouble;  ///< what is found and where, or why nothing is
};

/// How well the displacements control the multipliers (diagnose).
struct InfSupReport {
  double beta;    ///< inf-sup constant, dimensionless
  Vec2 position;  ///< where the worst pressure is largest
};

/// Seconds of the stages, summary.json "seconds".
struct Seconds {
  double mesh = 0, assemble = 0, couple = 0, factorise = 0, solve = 0, recover = 0, estimate = 0, write = 0;
  double total() const { return mesh + assemble + couple + factorise + solve + recover + estimate + write; }
  Seconds& operator+=(const Seconds& other);
};

/// How an asked accuracy of the pressure was found.
struct AccuracyReport {
  struct Solve {
    int unknowns;
    double estimated;     ///< of what was asked for
    double seconds;       ///< mesh to estimate
    bool narrow = false;  ///< contact was narrower than the edges there (error/narrow_contact.hpp)
  };
  Goal of = Goal::pressure;  ///< AccuracySpec
  double asked, excluded;
  std::vector<Solve> solves;  ///< one after another
  std::string reason;         ///< why it ended where the accuracy was not reached
  int later = 0;              ///< solves after that of the answer, none of which is as good
  int answer() const { return int(solves.size()) - later; }  ///< number of its solve, from 1
  /// What the estimate of a solve, its number from 1, is held to be: a first one, which nothing confirms, must be three
  /// times as good, and tells nothing of contact that it does not show.
  static double confirmed(const Solve& solve, int number) {
    if (number > 1) return solve.estimated;
    return solve.narrow ? std::numeric_limits<double>::infinity() : 3 * solve.estimated;
  }
  bool reached() const { return !solves.empty() && confirmed(solves[answer() - 1], answer()) <= asked; }
};

struct Results {
  Problem problem;  ///< held motions (validate.hpp) count as prescribed
  std::shared_ptr<EstimateMemory> memory = std::make_shared<EstimateMemory>();  ///< of estimates on its mesh
  std::shared_ptr<AuditMemory> audited = std::make_shared<AuditMemory>();       ///< of audits likewise
  std::vector<ContactNodes> nodes;                                              ///< of the pairs, likewise
  Solution solution;
  std::vector<std::vector<RigidMotion>> unheld;  ///< that nothing holds and no load drives: held, or zero
  Recovery recovery;
  std::optional<ErrorEstimate> estimate;   ///< unless the run was asked for none
  std::optional<AccuracyReport> accuracy;  ///< where one was asked for
  std::optional<InfSupReport> inf_sup;     ///< where the run was asked to diagnose
  std::vector<ExpectedFigure> expected;    ///< by the scene
  std::vector<Check> checks;
  double contact_moved = 0;           ///< the part of p in L2 that displacements are too large for
  std::vector<std::string> warnings;  ///< what a user should know; nothing that fails
  Status status = Status::solved;
  Seconds seconds;
  bool mesh_cached = false;  ///< whether the mesh was not made now, but kept from an earlier run
};

/// A pressure that matters to no body, stress: 1e-3 of the largest stress in any. It does not change where bodies are
/// moved as a whole.
double negligible_pressure(const Results& results);

/// Displacement unknowns that are not prescribed.
int free_unknowns(const Results& results);

}  // namespace mortise
