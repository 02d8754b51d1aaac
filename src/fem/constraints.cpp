#include "fem/constraints.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/errors.hpp"
#include "base/printable.hpp"

namespace mortise {
Constraints no_constraints(const Mesh& mesh) {
  return {std::vector<char>(2 * mesh.nodes.rows(), 0), VecX::Zero(2 * mesh.nodes.rows())};
}

void prescribe(const Mesh& mesh, const std::string& name, int dof, double value, Constraints& constraints) {
  const double other = constraints.value(dof), round_off = 1e-12 * std::max(std::abs(value), std::abs(other));
  if (constraints.fixed[dof] && std::abs(value - other) > round_off) {
    throw InputError(worded(mesh.source, ": boundary '", name, "': displacement ", (dof % 2 ? "y" : "x"), " = ", value,
                            " ", near_point(mesh.nodes.row(dof / 2).transpose()),
                            ", where another boundary prescribes ", other, "; expected one value a node"));
  }
  constraints.fixed[dof] = 1;
  constraints.value(dof) = value;
}

void prescribe(const Mesh& mesh, int boundary, int component, const std::function<double(int node)>& value,
               Constraints& constraints) {
  const Boundary& curve = mesh.boundaries[boundary];
  for (const Edge& edge : curve.edges)
    for (int a = 0; a < edge.node_count; ++a)
      prescribe(mesh, curve.name, 2 * edge.nodes[a] + component, value(edge.nodes[a]), constraints);
}

void prescribe(const Mesh& mesh, int boundary, int component, double value, Constraints& constraints) {
  prescribe(
      mesh, boundary, component, [value](int) { return value; }, constraints);
}

void hold_axis(const Mesh& mesh, Constraints& constraints) {
  constraints.rings = true;
  const double round_off = 1e-10 * mesh.nodes.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i) {
    if (mesh.nodes(i, 0) < -round_off)
      throw InputError(mesh.source + ": a node lies " + near_point(mesh.nodes.row(i).transpose()) +
                       ", beyond the axis x = 0 of an axisymmetric model; expected x >= 0, the radius");
    if (mesh.nodes(i, 0) <= round_off) constraints.fixed[2 * i] = 1;
  }
}

bool prescribed_along(const Constraints& constraints, int node, const Vec2& n) {
  if (!constraints.multipoint) {
    for (int c = 0; c < 2; ++c)
      if (std::abs(n(c)) > 1e-8 && !constraints.fixed[2 * node + c]) return false;
    return true;
  }
  const SparseRows& T = constraints.multipoint->T;
  std::map<int, double> along;  // n . u by the q
  for (int c = 0; c < 2; ++c)
    for (SparseRows::InnerIterator it(T, 2 * node + c); it; ++it) along[int(it.col())] += n(c) * it.value();
  return std::ranges::all_of(
      along, [&](const auto& part) { return std::abs(part.second) <= 1e-8 || constraints.fixed[part.first]; });
}

Vec2 prescribed_displacement(const Constraints& constraints, int node) {
  if (!constraints.multipoint) return constraints.value.segment<2>(2 * node);
  return (constraints.multipoint->T.middleRows<2>(2 * node) * constraints.value).eval();
}

std::vector<Vec2> prescribed_directions(const Constraints& constraints, int node) {
  std::vector<Vec2> directions;
  const auto& multipoint = constraints.multipoint;
  for (int c = 0; c < 2; ++c) {
    const int q = 2 * node + c;
    if (multipoint)
      for (SparseRows::InnerIterator it(multipoint->T, q); it; ++it)
        if (it.col() / 2 != node) return {Vec2::UnitX(), Vec2::UnitY()};
    if (constraints.fixed[q])
      directions.push_back(multipoint ? Vec2(multipoint->T.coeff(2 * node, q), multipoint->T.coeff(2 * node + 1, q))
                                      : Vec2(Vec2::Unit(c)));
  }
  return directions;
}

VecX constraint_forces(const Constraints& constraints, const std::vector<char>& chosen, const VecX& residual) {
  const auto& multipoint = constraints.multipoint;
  VecX forces = multipoint ? VecX(multipoint->T.transpose() * residual) : residual;
  for (Eigen::Index i = 0; i < forces.size(); ++i)
    if (!chosen[i]) forces(i) = 0;
  return multipoint ? VecX(multipoint->inverse.transpose() * forces) : forces;
}

}  // namespace mortise
