#include "error/data_estimate.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "error/gap_misfit.hpp"
#include "error/pressure_bars.hpp"
#include "fem/quadrature.hpp"
#include "solve/contact_factor.hpp"

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

Vec2 place_of(const Mesh& mesh, const Cell& cell, const CellShape& shape) {
  Vec2 x = Vec2::Zero();
  for (int a = 0; a < node_count(cell.kind); ++a) x += shape.N[a] * mesh.nodes.row(cell.nodes[a]).transpose();
  return x;
}

class Duals {
 public:
  Duals(const Problem& problem, MatX fields)
      : mesh_(problem.mesh),
        points_(problem.points),
        laws_(problem.discretisation.laws),
        fields_(std::move(fields)),
        patches_(recover_patches(mesh_, points_, sample_stresses(mesh_, laws_, fields_))) {}

  CellErrors errors(int e) const {
    const Cell& cell = mesh_.cells[e];
    const ElasticLaw& law = laws_[cell.body];
    const CellRule rule = product_rule(cell.kind, 3);
    const Eigen::Index count = fields_.cols(), each = law.model.axisymmetric() ? 4 : 3;
    VecX squares = VecX::Zero(count);
    double volume = 0;
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const CellShape shape = cell_shape(cell.kind, rule.points[q]);
      const Vec2 x = place_of(mesh_, cell, shape);
      Eigen::Matrix2d x_xi = Eigen::Matrix2d::Zero();
      for (int a = 0; a < node_count(cell.kind); ++a) x_xi += shape.dN[a] * mesh_.nodes.row(cell.nodes[a]);
      const double dV = rule.weights[q] * (x_xi(0, 0) * x_xi(1, 1) - x_xi(0, 1) * x_xi(1, 0)) * law.model.depth(x.x());
      volume += dV;
      const Eigen::RowVectorXd recovered = recovered_stress(mesh_, points_, patches_, {e, rule.points[q], 0});
      for (Eigen::Index k = 0; k < count; ++k) {
        const Vec4 d = whole_stress(laws_, cell.body, recovered.segment(each * k, each), x) -
                       stress_at(mesh_, cell, law, fields_.col(k), shape);
        squares(k) += dV * d.dot(law.compliance * d);
      }
    }
    const double strain = 1 / std::sqrt(law.young * volume);
    const double part = interpolation_part(cell.kind) * longest_side(mesh_, cell);
    return {squares.cwiseSqrt(), part * strain * squares.cwiseSqrt()};
  }

  // Of each dual int (g - g_h) . t dA on a side, t its traction: the mean of t with the mean of g - g_h, and the rest.
  VecX works(const DataMisfit& on) const {
    const Cell& cell = mesh_.cells[on.cell];
    const ElasticLaw& law = laws_[cell.body];
    const Edge edge = side_edge(cell, on.side);
    const Points reference = reference_nodes(cell.kind);
    const Vec2 first = reference.row(on.side), second = reference.row((on.side + 1) % corner_count(cell.kind));
    constexpr std::array<double, 3> weights{1. / 6, 4. / 6, 1. / 6};
    VecX works(fields_.cols());
    for (Eigen::Index k = 0; k < works.size(); ++k) {
      std::array<Vec2, 3> t;
      Vec2 mean = Vec2::Zero();
      for (int i = 0; i < 3; ++i) {
        const CellShape shape = cell_shape(cell.kind, first + i / 2. * (second - first));
        const Vec4 s = stress_at(mesh_, cell, law, fields_.col(k), shape) - law.stress0(place_of(mesh_, cell, shape));
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

 private:
  const Mesh& mesh_;
  const BodyPoints& points_;
  const std::vector<ElasticLaw>& laws_;
  MatX fields_;
  StressPatches patches_;
};

double largest_on(const Mesh& mesh, const DataMisfit& part, const VecX& u) {
  const Edge edge = side_edge(mesh.cells[part.cell], part.side);
  double most = 0;
  for (int a = 0; a < edge.node_count; ++a) most = std::max(most, u.segment<2>(2 * edge.nodes[a]).norm());
  return most;
}

// Of each dual.
VecX works_of(const Mesh& mesh, const DataMisfit& part, const VecX& u, const Duals& duals,
              std::map<int, CellErrors>& known) {
  if (part.kind == DataMisfit::Kind::displacement) return duals.works(part);
  auto at = known.find(part.cell);
  if (at == known.end()) at = known.emplace(part.cell, duals.errors(part.cell)).first;
  if (part.kind == DataMisfit::Kind::strain) return part.size * at->second.energy;
  return part.size * (part.kind == DataMisfit::Kind::foundation ? largest_on(mesh, part, u) : 1) * at->second.value;
}

// Where the gap jumps within the loaded line p has no limit: a corner of a rigid punch's exponent.
void add_jumps(const GapErrors& gap, const PressureLine& line, std::vector<SingularPoint>& points) {
  for (const auto& [edge, position] : gap.jumps) {
    if (!line.loaded[edge] && !line.loaded[edge + 1]) continue;
    points.push_back({.position = position,
                      .edge = line.s(edge + 1) - line.s(edge),
                      .exponent = 0.5,
                      .pressure_exponent = 0.5,
                      .meeting = Meeting::kink,
                      .wedges = {}});
  }
}

void add_gap_errors(const Problem& problem, double excluded, std::vector<PressureEstimate>& pressures) {
  for (std::size_t k = 0; k < pressures.size(); ++k) {
    const GapErrors gap = gap_errors(problem.mesh, problem.pairs[k], problem.discretisation.laws);
    if (gap.l2.size() == 0) continue;
    PressureEstimate& e = pressures[k];
    for (Eigen::Index i = 0; i < gap.l2.size(); ++i)
      for (const int end : {0, 1}) e.local.add_data(i + end, gap.l2(i));
    if (!problem.pairs[k].spec.stiffness) add_jumps(gap, e.line, e.singular);
    find_excluded(excluded, e);
    find_bars(e);
  }
}

// Edges of the multiplier side at each node of both sides of a pair.
std::map<int, std::set<int>> edges_at_nodes(const ContactPair& pair) {
  std::map<int, std::set<int>> edges;
  for (const ContactPoint& point : pair.points)
    for (const Edge& edge : {pair.multiplier.edges[point.edge], pair.opposite.edges[point.opposite_edge]})
      for (int a = 0; a < edge.node_count; ++a) edges[edge.nodes[a]].insert(point.edge);
  return edges;
}

// An initial strain that a cell does not follow makes stresses of its own size there. Where the cell is on the line
// they are a part of p at its vertices: means over windows, which are many times as wide, hardly feel them.
void add_strains_on_line(const Problem& problem, ErrorEstimate& estimate) {
  const std::vector<DataMisfit>& parts = problem.misfits.parts;
  const auto is_strain = [](const DataMisfit& part) { return part.kind == DataMisfit::Kind::strain; };
  if (std::ranges::none_of(parts, is_strain)) return;
  for (std::size_t k = 0; k < problem.pairs.size(); ++k) {
    const std::map<int, std::set<int>> edges = edges_at_nodes(problem.pairs[k]);
    PressureEstimate& e = estimate.pressures[k];
    for (const DataMisfit& part : parts) {
      if (!is_strain(part)) continue;
      const Cell& cell = problem.mesh.cells[part.cell];
      std::set<int> vertices;
      for (int a = 0; a < node_count(cell.kind); ++a)
        if (const auto at = edges.find(cell.nodes[a]); at != edges.end())
          for (const int edge : at->second) vertices.insert({edge, edge + 1});
      const int last = int(e.line.p.size()) - 1;
      if (e.line.closed && (vertices.contains(0) || vertices.contains(last))) vertices.insert({0, last});  // one vertex
      const ElasticLaw& law = problem.discretisation.laws[cell.body];
      const double volume = estimate.energy.areas(part.cell) * law.model.depth(centre_of(problem.mesh.nodes, cell).x());
      const double stress = part.size * std::sqrt(law.young / volume);
      for (const int i : vertices)
        if (e.line.loaded[i]) e.local.add_data(i, stress * std::sqrt(e.line.h(i)));
    }
  }
}

// Misfits x duals: what each does to the windows' shared means, and after them to the goal's components.
MatX works_of_all(const Problem& problem, const Solution& solution, const AccuracySpec& spec,
                  const ErrorEstimate& estimate) {
  constexpr Eigen::Index at_once = 12;
  const Discretisation& d = problem.discretisation;
  const std::vector<DataMisfit>& parts = problem.misfits.parts;
  const Eigen::Index rows = d.system.B.rows(), shared = estimate.far.windows.count;
  const GoalFunctionals goal =
      goal_functionals(problem.mesh, d, problem.pairs[spec.pair], estimate.pressures[spec.pair].line, spec);
  const Eigen::Index goals = estimate.goal ? goal.rows.cols() : 0, count = shared + goals;
  MatX works(Eigen::Index(parts.size()), count);
  if (count == 0) return works;
  MatX functionals(rows, count), loads = MatX::Zero(d.system.K.cols(), count);
  functionals.leftCols(shared) = window_functionals(problem.pairs, estimate.pressures, estimate.far.windows, rows);
  if (goals > 0) {
    functionals.rightCols(goals) = goal.rows;
    loads.rightCols(goals) = goal.loads;
  }
  const std::shared_ptr<const ContactFactor> factor = contact_factor(d.system, solution);
  for (Eigen::Index first = 0; first < count; first += at_once) {
    const Eigen::Index some = std::min(at_once, count - first);
    const Duals duals(problem, factor->duals(functionals.middleCols(first, some), loads.middleCols(first, some)));
    std::map<int, CellErrors> known;
    for (std::size_t i = 0; i < parts.size(); ++i)
      works.row(Eigen::Index(i)).segment(first, some) = works_of(problem.mesh, parts[i], solution.u, duals, known);
  }
  return works;
}

}  // namespace

void add_data_errors(const Problem& problem, const Solution& solution, const AccuracySpec& spec,
                     ErrorEstimate& estimate) {
  const std::vector<DataMisfit>& parts = problem.misfits.parts;
  add_gap_errors(problem, spec.exclude, estimate.pressures);
  if (parts.empty() || problem.pairs.empty()) return;
  add_strains_on_line(problem, estimate);
  const MatX works = works_of_all(problem, solution, spec, estimate);
  if (works.cols() == 0) return;
  const Eigen::Index shared = estimate.far.windows.count;
  VecX far = VecX::Zero(Eigen::Index(estimate.far.windows.dual.size()));
  const auto grow = [](double& part, double by) { part += part < 0 ? -by : by; };
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const DataMisfit& part = parts[i];
    const Eigen::Index row = Eigen::Index(i);
    for (int k = 0; k < int(shared); ++k) {
      grow(estimate.far.parts(part.cell, k), works(row, k));
      estimate.far.windows.for_each_window(problem.mesh.cells[part.cell].body, k, part.at,
                                           [&](int window, double share) { far(window) += share * works(row, k); });
    }
    for (Eigen::Index k = shared; k < works.cols(); ++k) {
      grow(estimate.goal->parts(part.cell, k - shared), works(row, k));
      estimate.goal->besides(k - shared) += works(row, k);
    }
  }
  Eigen::Index window = 0;
  for (PressureEstimate& e : estimate.pressures) {
    e.far += far.segment(window, Eigen::Index(e.windows.size()));
    window += Eigen::Index(e.windows.size());
    find_bars(e);
  }
}

}  // namespace mortise
