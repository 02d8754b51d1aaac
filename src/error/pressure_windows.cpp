#include "error/pressure_windows.hpp"

#include <algorithm>
#include <cmath>

#include "fem/edges.hpp"

namespace mortise {
namespace {

constexpr int windows_a_piece = 3, most_windows = 9;
constexpr double half_width = window_width / 2;  // of the distance between two centres

}  // namespace

void add_pressure_at(const ContactPair& pair, int edge, double xi, double weight, VecX& weights) {
  const auto& on = pair.coupling.on_edge[edge];
  const int nodes = on[2] >= 0 ? 3 : 2;
  const EdgeShape shape = edge_shape(nodes, xi);
  for (int i = 0; i < nodes; ++i)
    if (const int row = pair.coupling.row[on[i]]; row >= 0) weights(row) += weight * shape.N[i];
}

std::vector<PressureWindow> pressure_windows(const ContactPair& pair, const PressureLine& line) {
  const Eigen::Index edges = line.p.size() - 1;
  // Loaded length up to each vertex: windows are laid out along it.
  VecX t = VecX::Zero(edges + 1);
  int pieces = 0;
  for (Eigen::Index e = 0; e < edges; ++e) {
    const bool loaded = line.loaded[e] && line.loaded[e + 1];
    t(e + 1) = t(e) + (loaded ? line.s(e + 1) - line.s(e) : 0);
    if (loaded && (e == 0 || !line.loaded[e - 1])) ++pieces;
  }
  const double length = t(edges);
  if (!(length > 0)) return {};
  const int count = std::min(windows_a_piece * std::max(pieces, 1), most_windows);
  const double distance = length / count;

  std::vector<PressureWindow> windows;
  for (int k = 0; k < count; ++k) {
    const double centre = (k + 0.5) * distance;
    Eigen::Index e = 0;
    while (e + 1 < edges && t(e + 1) < centre) ++e;
    const double s = line.s(e) + (centre - t(e)), part = (s - line.s(e)) / (line.s(e + 1) - line.s(e));
    windows.push_back({.s = s,
                       .place = {(1 - part) * line.position[e] + part * line.position[e + 1], distance / 2},
                       .weights = VecX::Zero(pair.coupling.B.rows())});
  }
  VecX mass = VecX::Zero(count);
  for (const ContactPoint& point : pair.points) {
    if (!(t(point.edge + 1) > t(point.edge))) continue;
    const double at = t(point.edge) + (t(point.edge + 1) - t(point.edge)) * (1 + point.xi) / 2;
    for (int k = 0; k < count; ++k) {
      const double z = (at - (k + 0.5) * distance) / (half_width * distance);
      if (std::abs(z) >= 1) continue;
      const double weight = std::pow(1 - z * z, 3) * point.dA;
      mass(k) += weight;
      add_pressure_at(pair, point.edge, point.xi, weight, windows[k].weights);
    }
  }
  for (int k = count - 1; k >= 0; --k) {
    if (!(mass(k) > 0)) {
      windows.erase(windows.begin() + k);  // narrower than the mesh, or where nothing is faced
      continue;
    }
    windows[k].weights /= mass(k);
  }
  return windows;
}

}  // namespace mortise
