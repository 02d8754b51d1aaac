// Figures that follow from the displacements and multipliers.
#pragma once

#include "problem/problem.hpp"
#include "results/contact_results.hpp"
#include "results/extremes.hpp"
#include "results/probes.hpp"
#include "results/reactions.hpp"

namespace mortise {

struct Recovery {
  StressField stress;
  double energy = 0;                     ///< strain energy, times depth (model/model.hpp)
  std::vector<ContactResults> contacts;  ///< one a pair
  Extremes extremes;
  Reactions reactions;
  std::vector<ProbeValue> probes;
};

/// `nodes`: one a pair. `solution`: converged or not.
Recovery recover(const Problem& problem, const std::vector<ContactNodes>& nodes, const Solution& solution);

}  // namespace mortise
