// The estimated errors in words.
#pragma once

#include "error/force_errors.hpp"
#include "results/results.hpp"

namespace mortise {

/// Estimated errors above these parts are reported with their place: of the stresses in the energy norm, and of p.
inline constexpr double energy_error_limit = 0.2, pressure_error_limit = 0.1;

/// Warnings where the estimate is above a limit.
std::vector<std::string> error_warnings(const Results& results);

/// Whether the stress is known to have no limit at a place of a body: a corner of it (contact/singular_points.hpp), or,
/// where the errors are estimated, a point of a contact line.
bool grows_without_limit(const Results& results, const Extreme& stress);

/// The bars of p into the nodes of a pair.
void set_bars(const PressureEstimate& estimate, ContactResults& contact);

/// The bars of forces, moments and lengths in contact into the pairs.
void set_force_bars(Results& results);

/// Its questions, so that estimate_error finds its duals with the others; then the bars by these.
ForcesAsked ask_forces(const Results& results);
void set_force_bars(const ForcesAsked& asked, const FoundDuals& duals, Results& results);

/// p* (error/pressure_form.hpp) into the pairs where it is credible.
void set_fitted_pressures(Results& results);

/// The largest source of the estimated error of p, in words with its place: "the border of contact near (0.01, 0)".
std::string largest_error(const Results& results);
std::string largest_error(const Results& results, const std::vector<std::size_t>& pairs);  ///< of these alone

/// The pairs whose p matters to any body (negligible_pressure), in their order.
std::vector<std::size_t> pairs_that_matter(const Results& results);

}  // namespace mortise
