// Loads that a mesh does not carry, as its edges are too long where contact ends.
#pragma once

#include "base/errors.hpp"
#include "mesh/layered_sizes.hpp"
#include "problem/problem.hpp"

namespace mortise {

/// Of a problem whose load no pressures on its rows carry: the edges on which pressures would, no shorter than the load
/// needs within a factor of two. A row presses within its edges, so that the load is to lie between places within
/// edges, not between their ends. Empty where ends would not carry it either, or where pairs cannot open.
std::vector<SizeLayers> edges_that_carry(const Problem& problem);

/// Refused on this mesh alone: on one with such edges there is a solution.
class EdgesTooLong : public InputError {
 public:
  EdgesTooLong(const std::string& what, std::vector<SizeLayers> edges) : InputError(what), wanted(std::move(edges)) {}
  std::vector<SizeLayers> wanted;
};

}  // namespace mortise
