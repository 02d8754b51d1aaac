#include "fem/constraints.hpp"

#include <cmath>
#include <sstream>

#include "base/errors.hpp"
#include "base/printable.hpp"

namespace mortise {
Constraints no_constraints(const Mesh& mesh) {
  return {std::vector<char>(2 * mesh.nodes.rows(), 0), VecX::Zero(2 * mesh.nodes.rows())};
}

void prescribe(const Mesh& mesh, int boundary, int component, double value, Constraints& constraints) {
  const Boundary& curve = mesh.boundaries[boundary];
  for (const Edge& edge : curve.edges)
    for (int a = 0; a < edge.node_count; ++a) {
      const int dof = 2 * edge.nodes[a] + component;
      if (constraints.fixed[dof] && constraints.value(dof) != value) {
        std::ostringstream text;
        text << mesh.source << ": boundary '" << curve.name << "': displacement " << (component ? "y" : "x") << " = "
             << value << " " << near_point(mesh.nodes.row(edge.nodes[a]).transpose())
             << ", where another boundary prescribes " << constraints.value(dof) << "; expected one value a node";
        throw InputError(text.str());
      }
      constraints.fixed[dof] = 1;
      constraints.value(dof) = value;
    }
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
  for (int c = 0; c < 2; ++c)
    if (std::abs(n(c)) > 1e-8 && !constraints.fixed[2 * node + c]) return false;
  return true;
}

}  // namespace mortise
