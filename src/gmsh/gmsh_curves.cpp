#include "gmsh/gmsh_curves.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <stdexcept>

#include "base/printable.hpp"
#include "gmsh/gmsh_groups.hpp"
#include "mesh_files/element_types.hpp"

namespace mortise {
namespace {

constexpr double on_curve = 1e-5;  // a node that is off by more of its edge's length does not lie on the curve

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

}  // namespace

void sample_curve(const std::vector<std::array<double, 3>>& nodes, const std::vector<std::size_t>& tags,
                  const Vec2& shift, ElementBlock& block) {
  const int node_count = line_node_count(block.type);
  std::vector<EdgeSamples> samples;
  std::vector<std::array<double, 2>> ends;
  try {
    std::string type;
    gmsh::model::getType(1, block.entity, type);
    if (type == "Discrete curve") return;  // merged from a mesh, not drawn
    ends = parameters_of(tags, block, node_count);
    const CurvePlaces curve = [&](const std::vector<double>& t) { return places(block.entity, t); };
    samples = type == "Line" ? sample_straight_edges(curve, ends) : sample_edges(curve, ends);
  } catch (...) {  // gmsh 4.8 throws strings and numbers
    block.undrawn = "gmsh knows no formula for it";
    return;
  }
  for (std::size_t e = 0; e < samples.size(); ++e) {
    const std::array<Vec2, 2> found{samples[e].pieces.front().places.front(), samples[e].pieces.back().places.back()};
    for (const int end : {0, 1}) {
      const auto& x = nodes[block.nodes[node_count * e + end]];
      const Vec2 node(x[0], x[1]);
      if ((found[end] - node).norm() <= on_curve * (found[1] - found[0]).norm() && ends[e][0] < ends[e][1]) continue;
      block.undrawn = "the mesh does not follow it " + near_point(node - shift);
      return;
    }
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
    for (const int group : groups_of_entity(dimension, curve)) {
      const std::string name = group_name(dimension, group);
      names[curve].push_back(name.empty() ? "curve_" + std::to_string(group) : name);
    }
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
