// One [[contact]] entry.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "model/choices.hpp"
#include "model/contact_law.hpp"
#include "model/field.hpp"

namespace mortise {

/// Fluid in the gap of a pair.
struct FluidSpec {
  double pressure = 0;     ///< stress
  std::vector<Vec2> from;  ///< where it gets in

  bool operator==(const FluidSpec&) const = default;
};

struct ContactSpec {
  std::string key;
  int entry = 0;  ///< which of the scene's [[contact]], tied ones counted
  /// Physical curves; or patterns (model/patterns.hpp), for all pairs of theirs that face each other.
  std::array<std::string, 2> between;
  std::optional<double> within;  ///< how far apart these may be, length; none: problem/facing_pairs.hpp
  bool found = false;            ///< a pair of a pattern's: its curves need not face each other all along
  Condition condition = Condition::unilateral;
  InitialGap initial_gap = InitialGap::curve;
  Field gap;                            ///< of InitialGap::given: the gap, length: + open, - overlap
  Field clearance;                      ///< added to the drawn or measured gap, length
  std::optional<ContactLaw> stiffness;  ///< p of what the sides overlap; none: they do not
  std::optional<FluidSpec> fluid;       ///< of a unilateral pair: it presses on what it wets (problem/fluid.hpp)
  std::optional<double> pretension;     ///< of a tie: the force that draws its faces together, times depth (model.hpp)
  std::optional<double> overlap;        ///< of a tie: how far they are drawn into each other, length
  bool locked = false;                  ///< the overlap is what pretension makes of it before all other loads
  std::string multipliers_on;  ///< one of `between`; empty: couple_pairs chooses; of a tie the curve that follows

  bool operator==(const ContactSpec&) const = default;
};

}  // namespace mortise
