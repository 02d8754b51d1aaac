#include "error/pressure_windows.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

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

namespace {

// Loaded length up to each vertex, along which windows are laid out, and in how many pieces it is.
struct LoadedLength {
  VecX t;
  int pieces = 0;
  double distance = 0;  ///< between two windows
  int count = 0;        ///< of them
};

LoadedLength loaded_length(const PressureLine& line) {
  const Eigen::Index edges = line.p.size() - 1;
  LoadedLength loaded{.t = VecX::Zero(edges + 1)};
  for (Eigen::Index e = 0; e < edges; ++e) {
    const bool is_loaded = line.loaded[e] && line.loaded[e + 1];
    loaded.t(e + 1) = loaded.t(e) + (is_loaded ? line.s(e + 1) - line.s(e) : 0);
    if (is_loaded && (e == 0 || !line.loaded[e - 1])) ++loaded.pieces;
  }
  loaded.count = std::min(windows_a_piece * std::max(loaded.pieces, 1), most_windows);
  loaded.distance = loaded.t(edges) / loaded.count;
  return loaded;
}

// About a place of the loaded length; nothing where it is narrower than the mesh, or where nothing is faced.
std::optional<PressureWindow> window_at(const ContactPair& pair, const PressureLine& line, const LoadedLength& loaded,
                                        double centre) {
  const VecX& t = loaded.t;
  Eigen::Index e = 0;
  while (e + 2 < t.size() && t(e + 1) < centre) ++e;
  const double s = line.s(e) + (centre - t(e)), part = (s - line.s(e)) / (line.s(e + 1) - line.s(e));
  PressureWindow window{.s = s,
                        .place = {(1 - part) * line.position[e] + part * line.position[e + 1], loaded.distance / 2},
                        .weights = VecX::Zero(pair.coupling.B.rows())};
  double mass = 0;
  for (const ContactPoint& point : pair.points) {
    if (!(t(point.edge + 1) > t(point.edge))) continue;
    const double at = t(point.edge) + (t(point.edge + 1) - t(point.edge)) * (1 + point.xi) / 2;
    const double z = (at - centre) / (half_width * loaded.distance);
    if (std::abs(z) >= 1) continue;
    const double weight = std::pow(1 - z * z, 3) * point.dA;
    mass += weight;
    add_pressure_at(pair, point.edge, point.xi, weight, window.weights);
  }
  if (!(mass > 0)) return {};
  window.weights /= mass;
  return window;
}

}  // namespace

std::vector<PressureWindow> pressure_windows(const ContactPair& pair, const PressureLine& line) {
  const LoadedLength loaded = loaded_length(line);
  std::vector<PressureWindow> windows;
  if (!(loaded.distance > 0)) return windows;
  for (int k = 0; k < loaded.count; ++k)
    if (auto window = window_at(pair, line, loaded, (k + 0.5) * loaded.distance)) windows.push_back(std::move(*window));
  return windows;
}

std::vector<PressureWindow> with_end_windows(const ContactPair& pair, const PressureLine& line,
                                             const std::vector<char>& excluded, std::vector<PressureWindow> windows) {
  const LoadedLength loaded = loaded_length(line);
  const Eigen::Index last = line.p.size() - 1;
  if (line.closed || !(loaded.distance > 0)) return windows;
  const auto counts = [&](Eigen::Index end, Eigen::Index next) {
    return line.loaded[end] && line.loaded[next] && !excluded[end];
  };
  if (counts(0, 1))
    if (auto window = window_at(pair, line, loaded, 0)) windows.insert(windows.begin(), std::move(*window));
  if (counts(last, last - 1))
    if (auto window = window_at(pair, line, loaded, loaded.t(last))) windows.push_back(std::move(*window));
  return windows;
}

}  // namespace mortise
