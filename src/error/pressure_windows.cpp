#include "error/pressure_windows.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fem/edges.hpp"

namespace mortise {
namespace {

constexpr int windows_a_piece = 3, most_windows = 9;
constexpr double apart = 3;  // by which windows beside a border lie farther from it, each than the one before

}  // namespace

void add_pressure_at(const ContactPair& pair, int edge, double xi, double weight, VecX& weights) {
  const auto& on = pair.coupling.on_edge[edge];
  const int nodes = on[2] >= 0 ? 3 : 2;
  const EdgeShape shape = edge_shape(nodes, xi);
  for (int i = 0; i < nodes; ++i)
    if (const int row = pair.coupling.row[on[i]]; row >= 0) weights(row) += weight * shape.N[i];
}

namespace {

bool is_loaded(const PressureLine& line, Eigen::Index edge) { return line.loaded[edge] && line.loaded[edge + 1]; }

// Loaded length up to each vertex, along which windows are laid out, and in how many pieces it is. Of a closed line
// from a vertex on that is not loaded, if there is one: its first vertex is one like the others.
struct LoadedLength {
  Eigen::Index first = 0;  ///< vertex
  VecX t;
  int pieces = 0;
  double distance = 0;  ///< between two windows
  int count = 0;        ///< of them
};

LoadedLength loaded_length(const PressureLine& line) {
  const Eigen::Index edges = line.p.size() - 1;
  LoadedLength loaded{.t = VecX::Zero(edges + 1)};
  if (line.closed)
    if (const auto open = std::ranges::find(line.loaded, 0); open != line.loaded.end())
      loaded.first = open - line.loaded.begin();
  bool before = false;
  for (Eigen::Index k = 0; k < edges; ++k) {
    const Eigen::Index e = (loaded.first + k) % edges;
    const bool here = is_loaded(line, e);
    loaded.t(k + 1) = loaded.t(k) + (here ? line.s(e + 1) - line.s(e) : 0);
    loaded.pieces += here && !before;
    before = here;
  }
  loaded.count = std::min(windows_a_piece * std::max(loaded.pieces, 1), most_windows);
  loaded.distance = loaded.t(edges) / loaded.count;
  return loaded;
}

// A place of the loaded length: on an edge, at a part of it.
struct LoadedPlace {
  Eigen::Index edge;
  double part;
};

LoadedPlace loaded_place(const LoadedLength& loaded, double t) {
  const Eigen::Index edges = loaded.t.size() - 1;
  Eigen::Index k = 0;
  while (k + 1 < edges && loaded.t(k + 1) < t) ++k;
  return {(loaded.first + k) % edges, (t - loaded.t(k)) / (loaded.t(k + 1) - loaded.t(k))};
}

// About that place, not beyond what is not loaded; nothing where it is narrower than the mesh, or where nothing is
// faced. `reach`: as of WindowPlace.
std::optional<PressureWindow> window_at(const ContactPair& pair, const PressureLine& line, const LoadedPlace& centre,
                                        double reach) {
  const Eigen::Index c = centre.edge;
  const double length = line.s(c + 1) - line.s(c), part = centre.part;
  PressureWindow window{.s = line.s(c) + part * length,
                        .place = {(1 - part) * line.position[c] + part * line.position[c + 1], reach},
                        .weights = VecX::Zero(pair.coupling.B.rows())};
  double mass = 0, inverse_roots = 0;
  for (const ContactPoint& point : pair.points) {
    const Eigen::Index e = point.edge;
    if (!is_loaded(line, e)) continue;
    const double r = line.distance(line.s(e) + (line.s(e + 1) - line.s(e)) * (1 + point.xi) / 2, window.s);
    const double z = r / (window_width * reach);
    if (z >= 1) continue;
    const double weight = std::pow(1 - z * z, 3) * point.dA;
    mass += weight;
    inverse_roots += weight / std::sqrt(r);
    add_pressure_at(pair, point.edge, point.xi, weight, window.weights);
  }
  if (!(mass > 0)) return {};
  window.weights /= mass;
  window.from_border = mass * mass / (inverse_roots * inverse_roots);
  return window;
}

// The place at a distance from the vertex beyond a border, if the piece that ends there goes so far.
std::optional<LoadedPlace> within(const PressureLine& line, const LineError::Border& border, double r) {
  const Eigen::Index edges = line.p.size() - 1, step = open_vertex(line, border) == border.edge ? 1 : -1;
  Eigen::Index e = border.edge;
  for (Eigen::Index left = edges; left > 0 && e >= 0 && e < edges && is_loaded(line, e); --left) {
    const double length = line.s(e + 1) - line.s(e);
    if (r <= length) return LoadedPlace{e, step > 0 ? r / length : 1 - r / length};
    r -= length;
    e += step;
    if (line.closed) e = (e + edges) % edges;
  }
  return {};
}

// Distances from a border of the windows between it and those that are `distance` apart, the nearest of which is half
// of that away: from where p no longer is a root's.
std::vector<double> beside_border(const LineError::Border& border, double distance) {
  std::vector<double> all;
  for (double r = border.reach / 2; r * std::sqrt(apart) < distance / 2; r *= apart) all.push_back(r);
  return all;
}

}  // namespace

int windows_beside_borders(const PressureLine& line, const std::vector<LineError::Border>& borders) {
  const double distance = loaded_length(line).distance;
  std::size_t count = 0;
  for (const LineError::Border& border : borders) count += beside_border(border, distance).size();
  return int(count);
}

std::vector<PressureWindow> pressure_windows(const ContactPair& pair, const PressureLine& line) {
  const LoadedLength loaded = loaded_length(line);
  std::vector<PressureWindow> windows;
  if (!(loaded.distance > 0)) return windows;
  for (int k = 0; k < loaded.count; ++k)
    if (auto window = window_at(pair, line, loaded_place(loaded, (k + 0.5) * loaded.distance), loaded.distance / 2)) {
      window->from_border = 0;
      windows.push_back(std::move(*window));
    }
  std::ranges::sort(windows, {}, &PressureWindow::s);
  return windows;
}

std::vector<PressureWindow> with_end_windows(const ContactPair& pair, const PressureLine& line,
                                             const std::vector<LineError::Border>& borders,
                                             const std::vector<char>& excluded, std::vector<PressureWindow> windows) {
  const LoadedLength loaded = loaded_length(line);
  const Eigen::Index last = line.p.size() - 1;
  if (!(loaded.distance > 0)) return windows;
  const auto add = [&](const LoadedPlace& centre, double reach, bool is_border) {
    auto window = window_at(pair, line, centre, reach);
    if (!window) return;
    if (!is_border) window->from_border = 0;
    windows.push_back(std::move(*window));
  };
  const auto add_end = [&](Eigen::Index edge, double part) {
    const Eigen::Index end = edge + Eigen::Index(part);
    if (!line.closed && line.loaded[edge] && line.loaded[edge + 1] && !excluded[end] && line.p(end) != 0)
      add({edge, part}, loaded.distance / 2, false);
  };
  add_end(0, 0);
  add_end(last - 1, 1);
  for (const LineError::Border& border : borders) {
    const LoadedPlace open{border.edge, double(open_vertex(line, border) - border.edge)};
    add(open, std::min(loaded.distance, border.reach) / 2, true);
    for (const double r : beside_border(border, loaded.distance))
      if (const auto centre = within(line, border, r)) add(*centre, r, false);
  }
  std::ranges::sort(windows, {}, &PressureWindow::s);
  return windows;
}

}  // namespace mortise
