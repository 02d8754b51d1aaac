#include "fem/constraints.hpp"

#include <cmath>
#include <sstream>

#include "base/errors.hpp"
#include "mesh/place.hpp"

namespace mortise {
Constraints no_constraints(const Mesh& mesh) {
  return {std::vector<char>(std::size_t(2 * mesh.nodes.rows()), 0), VecX::Zero(2 * mesh.nodes.rows())};
}

void prescribe(const Mesh& mesh, int boundary, int component, double value, Constraints& constraints) {
  const Boundary& curve = mesh.boundaries[std::size_t(boundary)];
  for (const Edge& edge : curve.edges)
    for (std::size_t a = 0; a < std::size_t(edge.node_count); ++a) {
      const int dof = 2 * edge.nodes[a] + component;
      if (constraints.fixed[std::size_t(dof)] && constraints.value(dof) != value) {
        std::ostringstream text;
        text << mesh.source << ": boundary '" << curve.name << "': displacement " << (component ? "y" : "x") << " = "
             << value << " " << near_point(mesh.nodes.row(edge.nodes[a]).transpose())
             << ", where another boundary prescribes " << constraints.value(dof) << "; expected one value a node";
        throw InputError(text.str());
      }
      constraints.fixed[std::size_t(dof)] = 1;
      constraints.value(dof) = value;
    }
}

bool prescribed_along(const Constraints& constraints, int node, const Vec2& n) {
  for (int c = 0; c < 2; ++c)
    if (std::abs(n(c)) > 1e-8 && !constraints.fixed[std::size_t(2 * node + c)]) return false;
  return true;
}

}  // namespace mortise
