#include "io/gmsh_curves.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <stdexcept>

#include "base/printable.hpp"
#include "base/vectors.hpp"
#include "io/gmsh_groups.hpp"

namespace mortise {
namespace {

constexpr double on_curve = 1e-5;     // a node that is off by more of its edge's length does not lie on the curve
constexpr double abrupt_turn = 1e-4;  // radians within one edge, where most of the curve's edges turn smoothly

std::vector<Vec2> places(int entity, const std::vector<double>& parameters) {
  std::vector<double> xyz;
  gmsh::model::getValue(1, entity, parameters, xyz);
  if (xyz.size() != 3 * parameters.size()) throw std::runtime_error("gmsh::model::getValue");
  std::vector<Vec2> found;
  for (std::size_t i = 0; i < xyz.size(); i += 3) found.emplace_back(xyz[i], xyz[i + 1]);
  return found;
}

std::array<double, 2> parameter_range(int curve) {
  std::vector<double> low, high;
  gmsh::model::getParametrizationBounds(1, curve, low, high);
  if (low.size() != 1 || high.size() != 1) throw std::runtime_error("gmsh::model::getParametrizationBounds");
  return {low[0], high[0]};
}

// The curve's parameter at the start and the end of each edge. gmsh meshes a curve in its own direction, from its
// first end, which on a closed curve is its last one too.
std::vector<std::array<double, 2>> parameters_of(const std::vector<std::size_t>& tags, const ElementBlock& block,
                                                 int node_count) {
  const auto [low, high] = parameter_range(block.entity);
  const auto at = [](std::size_t tag, double at_end) {
    std::vector<double> xyz, parameter;
    gmsh::model::mesh::getNode(tag, xyz, parameter);
    return parameter.size() == 1 ? parameter[0] : at_end;  // a node at an end has none
  };
  std::vector<std::array<double, 2>> parameters;
  for (auto tag = tags.begin(); tag != tags.end(); tag += node_count)
    parameters.push_back({at(tag[0], low), at(tag[1], high)});
  return parameters;
}

// By how much a drawn curve turns within an edge in ways that the polynomial through its samples cannot follow,
// radians: the last three Chebyshev coefficients of its distance from the chord.
double unresolved_turn(const EdgeSamples& x) {
  constexpr int last = std::tuple_size_v<EdgeSamples> - 1;
  const Vec2 chord = x[last] - x[0];
  double turn = 0;
  for (int k = last - 2; k <= last; ++k) {
    double coefficient = 0;
    for (int j = 0; j <= last; ++j)
      coefficient +=
          (j == 0 || j == last ? 0.5 : 1) * cross(chord, x[j] - x[0]) * std::cos(std::numbers::pi * j * k / last);
    turn += k * k * std::abs(coefficient) * (k == last ? 1 : 2) / last;
  }
  return 2 * turn / chord.squaredNorm();
}

}  // namespace

void sample_curve(const std::vector<std::array<double, 3>>& nodes, const std::vector<std::size_t>& tags,
                  ElementBlock& block) {
  const int node_count = block.type == 1 ? 2 : 3;
  constexpr int last = std::tuple_size_v<EdgeSamples> - 1;
  std::vector<EdgeSamples> samples;
  try {
    std::string type;
    gmsh::model::getType(1, block.entity, type);
    if (type == "Discrete curve") return;  // merged from a mesh, not drawn
    std::vector<double> t;
    for (const auto& [start, end] : parameters_of(tags, block, node_count))
      for (int k = 0; k <= last; ++k)
        t.push_back((start + end) / 2 - (end - start) / 2 * std::cos(std::numbers::pi * k / last));
    const std::vector<Vec2> found = places(block.entity, t);
    for (std::size_t i = 0; i < found.size(); i += last + 1)
      std::copy_n(&found[i], last + 1, samples.emplace_back().begin());
    for (std::size_t e = 0; e < samples.size(); ++e)
      for (const int end : {0, 1}) {
        const auto& x = nodes[block.nodes[node_count * e + end]];
        const Vec2 node(x[0], x[1]);
        const double size = (samples[e][last] - samples[e][0]).norm();
        const double off = (samples[e][end * last] - node).norm();
        if (off <= on_curve * size && t[e * (last + 1)] < t[e * (last + 1) + last]) continue;
        block.undrawn = "the mesh does not follow it " + near_point(node);
        return;
      }
  } catch (...) {  // gmsh 4.8 throws strings and numbers
    block.undrawn = "gmsh knows no formula for it";
    return;
  }
  std::vector<double> turns;
  for (const EdgeSamples& edge : samples) turns.push_back(unresolved_turn(edge));
  std::vector<double> sorted = turns;
  std::ranges::nth_element(sorted, sorted.begin() + std::ssize(sorted) / 2);
  const auto worst = std::ranges::max_element(turns);
  if (*worst > abrupt_turn && *worst > 20 * sorted[sorted.size() / 2]) {
    block.undrawn = "it turns abruptly within an edge " + near_point(samples[worst - turns.begin()][0]) +
                    " (a Spline does at its ends, a Nurbs need not)";
    return;
  }
  block.samples = std::move(samples);
}

std::vector<DrawnCurve> drawn_curves() {
  constexpr int intervals = 128;
  std::map<int, std::vector<std::string>> names;  // by tag of the curve
  gmsh::vectorpair surfaces, found;
  gmsh::model::getEntities(surfaces, 2);
  gmsh::model::getBoundary(surfaces, found, false, false);
  for (const auto& [dimension, curve] : found) names[curve];
  gmsh::model::getEntities(found, 1);
  for (const auto& [dimension, curve] : found)
    for (const int group : groups_of_entity(dimension, curve))
      if (const std::string name = group_name(dimension, group); !name.empty()) names[curve].push_back(name);
  std::vector<DrawnCurve> drawn;
  for (const auto& [curve, its_names] : names) {
    const auto [low, high] = parameter_range(curve);
    std::vector<double> t;
    for (int i = 0; i <= intervals; ++i) t.push_back(low + (high - low) * i / intervals);
    drawn.push_back({its_names, places(curve, t)});
  }
  return drawn;
}

double speed_factor(int curve) {
  const auto [low, high] = parameter_range(curve);
  const double step = 1e-5 * (high - low);
  std::vector<double> factors;
  for (const double part : {0.12, 0.31, 0.47, 0.68, 0.89}) {
    const double t = low + part * (high - low);
    const std::vector<Vec2> ends = places(curve, {t - step, t + step});
    const double speed = (ends[1] - ends[0]).norm() / (2 * step);
    std::vector<double> derivative;
    gmsh::model::getDerivative(1, curve, {t}, derivative);
    factors.push_back(std::hypot(derivative.at(0), derivative.at(1)) / speed);
  }
  std::ranges::sort(factors);
  const double middle = factors[factors.size() / 2];
  return std::isnormal(middle) ? middle : 1;
}

}  // namespace mortise
