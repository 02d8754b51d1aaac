#include "results/probes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "base/errors.hpp"
#include "fem/patch_recovery.hpp"
#include "problem/scene_names.hpp"

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

// Of values at the nodes of the cell.
template <typename Values>
auto interpolated(const Mesh& mesh, const CellPlace& place, Values at_node) {
  const Cell& cell = mesh.cells[place.cell];
  const CellShape shape = cell_shape(cell.kind, place.xi);
  auto value = (shape.N[0] * at_node(cell.nodes[0])).eval();
  for (int a = 1; a < node_count(cell.kind); ++a) value += shape.N[a] * at_node(cell.nodes[a]);
  return value;
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
                        .x = x,
                        .s = probe.line ? (x - probe.at[0]).norm() : std::nan(""),
                        .angle = probe.angle * std::numbers::pi / 180,
                        .in = place_of(mesh, finder, probe, bodies, x)});
  }
  return places;
}

std::vector<ProbeValue> probe_values(const Mesh& mesh, const BodyPoints& points, const std::vector<ElasticLaw>& laws,
                                     const VecX& u, const StressField& averages,
                                     const std::vector<ProbePlace>& places) {
  std::vector<ProbeValue> values;
  if (places.empty()) return values;
  const StressPatches patches = recover_patches(mesh, points, sample_stresses(mesh, laws, u));
  for (const ProbePlace& place : places) {
    const int body = mesh.cells[place.in.cell].body;
    const Vec4 stress = whole_stress(laws, body, recovered_stress(mesh, points, patches, place.in), place.x);
    const Vec4 average = interpolated(mesh, place.in, [&](int node) -> Vec4 {
      return averages.points.row(point_of(points, body, node)).transpose();
    });
    values.push_back({.place = place,
                      .u = interpolated(mesh, place.in, [&](int node) -> Vec2 { return u.segment<2>(2 * node); }),
                      .stress = in_turned_axes(stress, place.angle),
                      .von_mises = von_mises(stress),
                      .spread = in_turned_axes(stress - average, place.angle).cwiseAbs().maxCoeff(),
                      .error = {}});
  }
  return values;
}

std::vector<ProbedPlaces> probed_places(const std::vector<ProbeValue>& values) {
  std::vector<ProbedPlaces> probes;
  int last = -1;
  for (const ProbeValue& value : values) {
    const ProbePlace& place = value.place;
    if (place.probe != last) probes.push_back({{}, {}, {}, place.angle});
    last = place.probe;
    probes.back().in.push_back(place.in);
    probes.back().x.push_back(place.x);
    probes.back().spread.push_back(value.spread);
  }
  return probes;
}

}  // namespace mortise
