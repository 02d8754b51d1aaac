#include "results/probes.hpp"

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

std::vector<std::pair<const char*, double>> probe_figures(const ProbeValue& v) {
  std::vector<std::pair<const char*, double>> figures{
      {"s", v.place.s},          {"x", v.place.x.x()},       {"y", v.place.x.y()},      {"u_x", v.u.x()},
      {"u_y", v.u.y()},          {"sigma_11", v.stress(0)},  {"sigma_22", v.stress(1)}, {"sigma_33", v.stress(2)},
      {"sigma_12", v.stress(3)}, {"von_mises", v.von_mises}, {"spread", v.spread}};
  if (!v.error) return figures;
  const auto& [u, stress] = *v.error;
  figures.insert(figures.end(), {{"u_x_error", u.x()},
                                 {"u_y_error", u.y()},
                                 {"sigma_11_error", stress(0)},
                                 {"sigma_22_error", stress(1)},
                                 {"sigma_12_error", stress(2)}});
  return figures;
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
