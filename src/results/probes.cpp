#include "results/probes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "fem/patch_recovery.hpp"

namespace mortise {
namespace {

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

std::vector<ProbeValue> probe_values(const Problem& problem, const VecX& u, const StressField& averages) {
  const auto& [mesh, points, laws] = std::tie(problem.mesh, problem.points, problem.discretisation.laws);
  std::vector<ProbeValue> values;
  if (problem.probes.empty()) return values;
  const StressPatches patches = recover_patches(mesh, points, sample_stresses(mesh, laws, u));
  for (const ProbePlace& place : problem.probes) {
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
