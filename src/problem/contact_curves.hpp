// The curves of the [[contact]] entries, named or found.
#pragma once

#include "mesh/curve.hpp"
#include "model/contact_spec.hpp"

namespace mortise {

struct Scene;

/// The two curves of a [[contact]] entry, in its order.
struct ContactCurves {
  ContactSpec spec;
  std::array<Curve, 2> curves;
  std::array<double, 2> edge_size{};  ///< mean, length
  bool on_free_mesh = false;          ///< on one of those that [accuracy] makes
};

/// Those in contact, and those that are tied. Throws InputError for unknown curves, curves that are no chains, and
/// curves with common nodes.
std::vector<ContactCurves> contact_curves(const Scene& scene, const Mesh& mesh);
std::vector<ContactCurves> tied_curves(const Scene& scene, const Mesh& mesh);

/// Of each [[contact]] entry of patterns without a distance the boundaries of both sides, rising.
using PatternSides = std::array<std::vector<int>, 2>;
std::vector<PatternSides> patterns_without_distance(const Scene& scene, const Mesh& mesh);

}  // namespace mortise
