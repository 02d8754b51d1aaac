// When the meshes and solves for an asked accuracy end.
#pragma once

#include <string>
#include <vector>

#include "contact/least_gap.hpp"
#include "results/results.hpp"

namespace mortise {

/// Whether any pair is, by more than round-off; of what did not converge nobody knows.
bool is_pressed(const Results& results);

/// Whether p = 0 is the answer, from the meshes of one case in their order.
class OpenGaps {
 public:
  /// Whether nothing is pressed, between the points of this mesh too: a round body may have come through the other
  /// where no edge is as short as the contact. A pair that touches all the same moves a body that nothing holds back,
  /// and one whose gap is not held is as near as that body happens to lie: both only if such bodies have room
  /// (missed_contact).
  bool are_the_answer(const Results& results);

 private:
  std::vector<LeastGap> before_;  // of all pairs on the last mesh, if nothing was pressed on it
};

/// Throws InputError where p has no largest value.
void require_peak(const Scene& scene, const Results& results);

/// Whether the estimate has risen twice in succession, on meshes that were finer: those that it rose from told p, to
/// 30 % (else the next may say anything).
bool estimate_rises(const std::vector<AccuracyReport::Solve>& solves);

/// What ends the loop short of what was asked; empty: it goes on, or has reached that. `tells_no_more`: the last
/// meshes told no sizes of a next one. `at_limit`: the mesh has been held to unknowns_max.
std::string why_to_stop(const Results& results, const AccuracyReport& report, const AccuracySpec& asked,
                        bool tells_no_more, bool at_limit);

}  // namespace mortise
