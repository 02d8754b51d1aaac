#include "error/outline_works.hpp"

#include <algorithm>

#include "contact/body_corners.hpp"
#include "fem/edges.hpp"
#include "fem/quadrature.hpp"
#include "fem/stress.hpp"

namespace mortise {
namespace {

// The reference place of a point on a side, xi in [-1, 1].
Vec2 on_side(const Cell& cell, int side, double xi) {
  const Points nodes = reference_nodes(cell.kind);
  return (1 - xi) / 2 * nodes.row(side) + (1 + xi) / 2 * nodes.row((side + 1) % corner_count(cell.kind));
}

// The curve that a straight side of length h stands for, at a point of the side: its parabola.
struct CurvePoint {
  double away;  // from the side, outwards
  Vec2 area;    // its normal, as long as the curve is to the side
};

CurvePoint curve_at(const EdgePoint& side, double xi, double h, double curvature) {
  const double away = curvature * h * h / 8 * (1 - xi * xi), slope = -curvature * h / 2 * xi;
  return {away, side.normal() - slope * side.tangent.normalized()};
}

// Derivative of a displacement along a direction.
Vec2 derivative(const Points& nodes, const Cell& cell, const CellShape& shape, const VecX& u, const Vec2& along) {
  const Vec2 xi = cell_point(nodes, cell, shape).x_xi.transpose().inverse() * along;
  Vec2 sum = Vec2::Zero();
  for (int a = 0; a < node_count(cell.kind); ++a) sum += shape.dN[a].dot(xi) * u.segment<2>(2 * cell.nodes[a]);
  return sum;
}

}  // namespace

const std::vector<OutlineWorks::Load>& OutlineWorks::loads_on(const DataMisfit& on) {
  if (!loads_) {
    loads_.emplace();
    for (const BoundaryEntry& entry : problem_.entries.boundaries)
      if (const TractionField traction = traction_of(problem_.mesh, problem_.entries.model, entry))
        for (const NamedBoundary& curve : entry.curves)
          for (int e = 0; e < int(curve.sides.size()); ++e)
            (*loads_)[{curve.sides[e].cell, curve.sides[e].side}].push_back({&entry, &curve, e, traction});
  }
  static const std::vector<Load> none;
  const auto found = loads_->find({on.cell, on.side});
  return found == loads_->end() ? none : found->second;
}

// A force that is given as a whole keeps its sum.
std::vector<OutlineWorks::Forces> OutlineWorks::forces(const Load& load, const DataMisfit& on) const {
  static const LineRule rule = gauss_legendre(3);  // exact for a constant pressure
  const Mesh& mesh = problem_.mesh;
  const Model& model = problem_.entries.model;
  const Edge edge = side_edge(mesh.cells[on.cell], on.side);
  const double h = on.finest, curvature = 12 * on.size / (h * h * h * model.depth(on.at.x()));
  std::vector<Forces> all;
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const double xi = rule.points[q];
    const EdgePoint side = edge_point(mesh.nodes, edge, xi);
    const CurvePoint curve = curve_at(side, xi, h, curvature);
    const Vec2 n = side.normal(), x = side.position + curve.away * n;
    const double s = load.s_at(side.position), ds = rule.weights[q] * side.jacobian();
    const Vec2 on_side = ds * model.depth(side.position.x()) * load.traction(side.position, n, s);
    const auto there = [&] {
      try {
        return load.traction(x, curve.area.normalized(), s);
      } catch (const SceneError&) {  // beyond where the function has values
        return load.traction(side.position, curve.area.normalized(), s);
      }
    };
    const bool whole = std::holds_alternative<TotalForce>(load.entry->spec.what);
    all.push_back({xi, curve.away, on_side, whole ? on_side : ds * curve.area.norm() * model.depth(x.x()) * there()});
  }
  return all;
}

VecX OutlineWorks::of(const DataMisfit& on, const std::vector<VecX>& z) {
  const Mesh& mesh = problem_.mesh;
  const Cell& cell = mesh.cells[on.cell];
  const ElasticLaw& law = problem_.discretisation.laws[cell.body];
  const Edge edge = side_edge(cell, on.side);
  const CellShape shape = cell_shape(cell.kind, on_side(cell, on.side, 0));
  const Vec2 n = edge_point(mesh.nodes, edge, 0).normal(), force = problem_.entries.force_in(cell.body, on.at);
  std::vector<Forces> loaded;
  for (const Load& load : loads_on(on)) std::ranges::move(forces(load, on), std::back_inserter(loaded));
  Vec4 stress = stress_at(mesh, cell, law, u_, shape);
  if (face_of(mesh.nodes, edge, problem_.discretisation.system.constraints) == Face::free) {
    double pressed = stress(0) * n.x() * n.x() + stress(1) * n.y() * n.y() + 2 * stress(3) * n.x() * n.y();
    for (const Load& load : loads_on(on)) pressed -= n.dot(load.traction(on.at, n, load.s_at(on.at)));
    stress.head<3>().array() -= pressed;
  }
  VecX works(Eigen::Index(z.size()));
  for (std::size_t k = 0; k < z.size(); ++k) {
    const Vec4 strain = law.compliance * (stress_at(mesh, cell, law, z[k], shape) - law.stress0(on.at));
    double work = on.size * (force.dot(edge_value(z[k], edge, 0)) - stress.dot(strain));
    for (const Forces& at : loaded) {
      const CellShape there = cell_shape(cell.kind, on_side(cell, on.side, at.xi));
      const Vec2 z_side = edge_value(z[k], edge, at.xi),
                 z_curve = z_side + at.away * derivative(mesh.nodes, cell, there, z[k], n);
      work += at.on_curve.dot(z_curve) - at.on_side.dot(z_side);
    }
    works(Eigen::Index(k)) = work;
  }
  return works;
}

VecX outline_works(const Problem& problem, const VecX& u, const VecX& motion) {
  OutlineWorks outline(problem, u);
  std::vector<double> works;
  for (const DataMisfit& part : problem.misfits.parts)
    if (part.kind == DataMisfit::Kind::outline) works.push_back(outline.of(part, {motion})(0));
  return VecX::Map(works.data(), Eigen::Index(works.size()));
}

}  // namespace mortise
