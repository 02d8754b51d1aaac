#include "error/data_works.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "error/outline_works.hpp"
#include "fem/edges.hpp"
#include "fem/patch_recovery.hpp"
#include "fem/quadrature.hpp"

namespace mortise {
namespace {

// Of a cell and dual solutions, what their errors are there.
struct CellErrors {
  VecX energy;  // norm of each dual's error: root of int d C^-1 d dV
  VecX value;   // about what each dual itself may be off by, as a displacement
};

// The difference of the value from an interpolant over the root mean square of that of the strain, in parts of the
// longest side: of a cubic along an edge of a quadratic cell, of a parabola along a linear one's.
double interpolation_part(CellKind kind) { return is_quadratic(kind) ? 0.22 : 0.43; }

double longest_side(const Mesh& mesh, const Cell& cell) {
  double longest = 0;
  for (int a = 0; a < corner_count(cell.kind); ++a)
    longest = std::max(
        longest,
        (mesh.nodes.row(cell.nodes[a]) - mesh.nodes.row(cell.nodes[(a + 1) % corner_count(cell.kind)])).norm());
  return longest;
}

class Duals {
 public:
  Duals(const Problem& problem, const MatX& fields)
      : mesh_(problem.mesh),
        points_(problem.points),
        laws_(problem.discretisation.laws),
        all_(fields),
        fields_(fields.colwise().begin(), fields.colwise().end()) {}

  CellErrors errors(int e) {
    if (!patches_) patches_ = recover_patches(mesh_, points_, sample_stresses(mesh_, laws_, all_));
    const Cell& cell = mesh_.cells[e];
    const ElasticLaw& law = laws_[cell.body];
    const CellRule rule = product_rule(cell.kind, 3);
    const Eigen::Index count = Eigen::Index(fields_.size()), each = law.model.axisymmetric() ? 4 : 3;
    VecX squares = VecX::Zero(count);
    double volume = 0;
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const CellShape shape = cell_shape(cell.kind, rule.points[q]);
      const CellPoint at = cell_point(mesh_.nodes, cell, shape);
      const double dV = rule.weights[q] * at.jacobian() * law.model.depth(at.x.x());
      volume += dV;
      const Eigen::RowVectorXd recovered = recovered_stress(mesh_, points_, *patches_, {e, rule.points[q], 0});
      for (Eigen::Index k = 0; k < count; ++k) {
        const Vec4 d = whole_stress(laws_, cell.body, recovered.segment(each * k, each), at.x) -
                       stress_at(mesh_, cell, law, fields_[k], shape);
        squares(k) += dV * d.dot(law.compliance * d);
      }
    }
    const double strain = 1 / std::sqrt(law.young * volume);
    const double part = interpolation_part(cell.kind) * longest_side(mesh_, cell);
    return {squares.cwiseSqrt(), part * strain * squares.cwiseSqrt()};
  }

  // Of each dual by how much it dents the body where a foundation stands that the side does not follow, and the mesh
  // does not: a force along a length w sinks by 2 F / (pi E) ln (h / w) more than one along h (Flamant).
  VecX dents(const DataMisfit& on) const {
    const Edge edge = side_edge(mesh_.cells[on.cell], on.side);
    const ElasticLaw& law = laws_[mesh_.cells[on.cell].body];
    const double deeper = 2 * std::numbers::inv_pi / law.young * std::log1p(edge_length(mesh_.nodes, edge) / on.spread);
    VecX all(Eigen::Index(fields_.size()));
    for (Eigen::Index k = 0; k < all.size(); ++k)
      all(k) = deeper * on.size / law.model.depth(on.at.x()) * largest_on(mesh_, on, fields_[k]);
    return all;
  }

  // Of each dual int (g - g_h) . t dA on a side, t its traction: the mean of t with the mean of g - g_h, and the rest.
  VecX works(const DataMisfit& on) const {
    const Cell& cell = mesh_.cells[on.cell];
    const ElasticLaw& law = laws_[cell.body];
    const Edge edge = side_edge(cell, on.side);
    const Points reference = reference_nodes(cell.kind);
    const Vec2 first = reference.row(on.side), second = reference.row((on.side + 1) % corner_count(cell.kind));
    constexpr std::array<double, 3> weights{1. / 6, 4. / 6, 1. / 6};
    VecX works(Eigen::Index(fields_.size()));
    for (Eigen::Index k = 0; k < works.size(); ++k) {
      std::array<Vec2, 3> t;
      Vec2 mean = Vec2::Zero();
      for (int i = 0; i < 3; ++i) {
        const CellShape shape = cell_shape(cell.kind, first + i / 2. * (second - first));
        const Vec4 s =
            stress_at(mesh_, cell, law, fields_[k], shape) - law.stress0(cell_point(mesh_.nodes, cell, shape).x);
        const Vec2 n = edge_point(mesh_.nodes, edge, i - 1.).normal();
        t[i] = {s(0) * n.x() + s(3) * n.y(), s(3) * n.x() + s(1) * n.y()};
        mean += weights[i] * t[i];
      }
      double varies = 0;
      for (const Vec2& at : t) varies = std::max(varies, (at - mean).norm());
      works(k) = std::abs(on.mean.dot(mean)) + on.size * varies;
    }
    return works;
  }

  const std::vector<VecX>& fields() const { return fields_; }

 private:
  const Mesh& mesh_;
  const BodyPoints& points_;
  const std::vector<ElasticLaw>& laws_;
  const MatX& all_;
  const std::vector<VecX> fields_;  // a dual each: as a column of them all it would be copied at each use
  std::optional<StressPatches> patches_;
};

// Of each dual.
VecX works_of(const Mesh& mesh, const DataMisfit& part, const VecX& u, Duals& duals, OutlineWorks& outline,
              std::map<int, CellErrors>& known) {
  if (part.kind == DataMisfit::Kind::displacement) return duals.works(part);
  if (part.kind == DataMisfit::Kind::outline) return outline.of(part, duals.fields());
  auto at = known.find(part.cell);
  if (at == known.end()) at = known.emplace(part.cell, duals.errors(part.cell)).first;
  if (part.kind == DataMisfit::Kind::strain) return part.size * at->second.energy;
  if (part.kind == DataMisfit::Kind::force) return part.size * at->second.value;
  return part.size * largest_on(mesh, part, u) * (at->second.value + duals.dents(part));
}

}  // namespace

double largest_on(const Mesh& mesh, const DataMisfit& part, const VecX& u) {
  const Edge edge = side_edge(mesh.cells[part.cell], part.side);
  double most = 0;
  for (int a = 0; a < edge.node_count; ++a) most = std::max(most, u.segment<2>(2 * edge.nodes[a]).norm());
  return most;
}

MatX data_works(const Problem& problem, const VecX& u, const MatX& z) {
  const std::vector<DataMisfit>& parts = problem.misfits.parts;
  MatX works(Eigen::Index(parts.size()), z.cols());
  if (works.size() == 0) return works;
  Duals duals(problem, z);
  OutlineWorks outline(problem, u);
  std::map<int, CellErrors> known;
  for (std::size_t i = 0; i < parts.size(); ++i)
    works.row(Eigen::Index(i)) = works_of(problem.mesh, parts[i], u, duals, outline, known);
  return works;
}

}  // namespace mortise
