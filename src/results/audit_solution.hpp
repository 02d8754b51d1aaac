// What a solution shows that the scene probably does not mean.
#pragma once

#include "results/results.hpp"

namespace mortise {

/// One line for each pair whose contact reaches the end of a curve although the boundary goes on smoothly; and for each
/// two bodies that pass through one another where no pair stands between them. Nothing where the run did not converge.
std::vector<std::string> audit_solution(const Results& results);

}  // namespace mortise
