#include "problem/probe_places.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "base/errors.hpp"
#include "problem/scene_names.hpp"
#include "scene/scene.hpp"

namespace mortise {
namespace {

// Bodies whose cells come this near to a place, of a cell's size, share it.
constexpr double shared = 1e-3;

CellPlace place_of(const Mesh& mesh, const CellFinder& finder, const ProbeSpec& probe, const std::vector<int>& bodies,
                   const Vec2& x) {
  std::ostringstream where;
  where << probe.key << ": (" << x.x() << ", " << x.y() << ") lies ";
  std::vector<CellPlace> found = finder.around(x);
  if (!probe.body.empty())
    std::erase_if(found,
                  [&](const CellPlace& p) { return !std::ranges::binary_search(bodies, mesh.cells[p.cell].body); });
  if (found.empty())
    throw SceneError(where.str() + "in " + (probe.body.empty() ? "no body" : "no part of '" + probe.body + "'") +
                     "; expected a place in one");
  const auto body = [&](int k) { return mesh.cells[found[k].cell].body; };
  if (found.size() > 1 && found[1].distance <= shared * cell_size(mesh, found[1].cell))
    throw SceneError(where.str() + "in bodies '" + mesh.bodies[std::min(body(0), body(1))] + "' and '" +
                     mesh.bodies[std::max(body(0), body(1))] + "'; expected body = one of them");
  return found[0];
}

}  // namespace

std::vector<ProbePlace> locate_probes(const Scene& scene, const Mesh& mesh) {
  std::vector<ProbePlace> places;
  if (scene.probes.empty()) return places;
  const CellFinder finder(mesh);
  const SceneNames names(mesh);
  for (int k = 0; k < int(scene.probes.size()); ++k) {
    const ProbeSpec& probe = scene.probes[k];
    std::vector<int> bodies;
    if (!probe.body.empty()) bodies = names.bodies(probe.key + ".body", probe.body);
    for (const Vec2& x : probe.at)
      places.push_back({.probe = k,
                        .key = probe.key,
                        .x = x,
                        .s = probe.line ? (x - probe.at[0]).norm() : std::nan(""),
                        .angle = probe.angle * std::numbers::pi / 180,
                        .in = place_of(mesh, finder, probe, bodies, x)});
  }
  return places;
}

}  // namespace mortise
