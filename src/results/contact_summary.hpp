// What the terminal's summary says of the contact pairs.
#pragma once

#include "results/results.hpp"

namespace mortise {

/// The multiplier space that is really used: quadratic needs 3-node edges.
std::string space_word(const Results& results);

/// Four lines a pair; of more than told_in_full pairs (base/printable.hpp) what they are together, and which of them
/// has the lowest and the highest p, the largest force and p furthest from the bodies' stress.
std::string contact_lines(const Results& results);

/// How contact was found; empty where nothing was to be found.
std::string contact_words(const Results& results);

}  // namespace mortise
