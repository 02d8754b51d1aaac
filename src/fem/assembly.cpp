#include "fem/assembly.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "fem/edges.hpp"
#include "fem/elements.hpp"
#include "fem/quadrature.hpp"
#include "fem/resolved_loads.hpp"

namespace mortise {
namespace {

// Nodes and quadrature points of a kind, known when the kernels are compiled.
template <CellKind kind>
constexpr int n = node_count(kind);
template <CellKind kind>
constexpr int points = cell_rule_size(kind);

template <CellKind kind>
using Table = Eigen::Matrix<double, points<kind>, n<kind>, points<kind> == 1 ? Eigen::RowMajor : Eigen::ColMajor>;

// Shape functions and their reference gradients at the quadrature points, a row a point.
template <CellKind kind>
struct CellTable {
  Table<kind> N, dxi, deta;
  std::vector<double> weights;
};

template <CellKind kind>
CellTable<kind> cell_table(const CellRule& rule, std::size_t first = 0) {
  CellTable<kind> table;
  table.weights.assign(rule.weights.begin() + std::ptrdiff_t(first),
                       rule.weights.begin() + std::ptrdiff_t(first) + points<kind>);
  for (Eigen::Index q = 0; q < points<kind>; ++q) {
    const CellShape s = cell_shape(kind, rule.points[first + q]);
    for (int a = 0; a < n<kind>; ++a) {
      table.N(q, a) = s.N[a];
      table.dxi(q, a) = s.dN[a].x();
      table.deta(q, a) = s.dN[a].y();
    }
  }
  return table;
}

// A cell's values at the quadrature points of a table: gradients of the shape functions in space, d/dx1 and d/dx2 (a
// row a point), and the area that each point stands for.
template <CellKind kind>
struct CellValues {
  CellTable<kind> table;
  Eigen::Matrix<double, n<kind>, 2> nodes = {};
  Table<kind> d1 = {}, d2 = {};
  Eigen::Matrix<double, points<kind>, 1> dA = {};

  Vec2 x(Eigen::Index q) const { return (table.N.row(q) * nodes).transpose(); }

  void reinit(const Points& all, const Cell& cell) {
    for (int a = 0; a < n<kind>; ++a) nodes.row(a) = all.row(cell.nodes[a]);
    const Eigen::Matrix<double, n<kind>, 2> from_first = nodes.rowwise() - nodes.row(0);  // as cell_point
    for (Eigen::Index q = 0; q < points<kind>; ++q) {
      const Eigen::Matrix<double, 1, 2> x_xi = table.dxi.row(q) * from_first, x_eta = table.deta.row(q) * from_first;
      const double J = x_xi(0) * x_eta(1) - x_xi(1) * x_eta(0);
      d1.row(q) = (x_eta(1) * table.dxi.row(q) - x_xi(1) * table.deta.row(q)) / J;
      d2.row(q) = (x_xi(0) * table.deta.row(q) - x_eta(0) * table.dxi.row(q)) / J;
      dA(q) = table.weights[q] * J;
    }
  }
};

// Which nodes share a cell, lower triangle: rows of column j are row[first[j]] .. row[first[j+1] - 1], ascending,
// beginning with j itself.
struct NodeGraph {
  std::vector<int> first, row;
};

NodeGraph node_graph(const Mesh& mesh) {
  const std::size_t node_total = mesh.nodes.rows();
  std::vector<int> cell_first(node_total + 1, 0);
  for (const Cell& cell : mesh.cells)
    for (int a = 0; a < node_count(cell.kind); ++a) ++cell_first[cell.nodes[a] + 1];
  for (std::size_t i = 0; i < node_total; ++i) cell_first[i + 1] += cell_first[i];
  std::vector<int> cells(cell_first.back()), next(cell_first.begin(), cell_first.end() - 1);
  for (std::size_t e = 0; e < mesh.cells.size(); ++e)
    for (int a = 0; a < node_count(mesh.cells[e].kind); ++a) cells[next[mesh.cells[e].nodes[a]]++] = int(e);

  NodeGraph graph;
  graph.first.reserve(node_total + 1);
  graph.first.push_back(0);
  graph.row.reserve(node_total * 8);
  std::vector<int> seen(node_total, -1);
  for (int j = 0; j < int(node_total); ++j) {
    const std::size_t begin = graph.row.size();
    for (int k = cell_first[j]; k < cell_first[j + 1]; ++k) {
      const Cell& cell = mesh.cells[cells[k]];
      for (int a = 0; a < node_count(cell.kind); ++a) {
        const int i = cell.nodes[a];
        if (i < j || seen[i] == j) continue;
        seen[i] = j;
        graph.row.push_back(i);
      }
    }
    std::sort(graph.row.begin() + std::ptrdiff_t(begin), graph.row.end());
    graph.first.push_back(int(graph.row.size()));
  }
  return graph;
}

// A run of nodes: first <= j < last.
struct NodeRange {
  int first, last;

  bool has(int j) const { return first <= j && j < last; }
  bool touches(const Cell& cell) const {
    return std::any_of(cell.nodes.begin(), cell.nodes.begin() + node_count(cell.kind), [&](int j) { return has(j); });
  }
};

// Room for the lower triangle of a symmetric matrix of 2 x 2 blocks on the graph.
SparseMatrix block_matrix(const NodeGraph& graph) {
  const auto columns = graph.first.size() - 1;
  SparseMatrix K(2 * columns, 2 * columns);
  K.resizeNonZeros(4 * graph.row.size() - columns);
  K.outerIndexPtr()[2 * columns] = int(4 * graph.row.size() - columns);
  return K;
}

// Of two nodes' displacements.
struct Block {
  double k11, k12, k21, k22;
};

// The columns of some nodes.
struct Columns {
  const NodeGraph& graph;
  NodeRange nodes;
  SparseMatrix& K;

  // All zero.
  void lay_out() const {
    int* inner = K.innerIndexPtr();
    const int begin = 4 * graph.first[nodes.first] - nodes.first;
    int at = begin;
    for (int j = nodes.first; j < nodes.last; ++j)
      for (int c = 0; c < 2; ++c) {
        K.outerIndexPtr()[2 * j + c] = at;
        for (int k = graph.first[j]; k < graph.first[j + 1]; ++k)
          for (int r = 0; r < 2; ++r)
            if (2 * graph.row[k] + r >= 2 * j + c) inner[at++] = 2 * graph.row[k] + r;
      }
    std::fill(K.valuePtr() + begin, K.valuePtr() + at, 0.0);
  }

  // Whether the block of nodes (i, j) is stored here.
  bool have(int i, int j) const { return i >= j && nodes.has(j); }

  // Adds the block of nodes (i, j) in place.
  void add(int i, int j, const Block& k) const {
    const int* begin = graph.row.data() + graph.first[j];
    const int* end = graph.row.data() + graph.first[j + 1];
    const auto position = std::lower_bound(begin, end, i) - begin;
    double* column1 = K.valuePtr() + K.outerIndexPtr()[2 * j] + 2 * position;
    double* column2 = K.valuePtr() + K.outerIndexPtr()[2 * j + 1] + 2 * position - 1;
    column1[0] += k.k11;
    column1[1] += k.k21;
    if (i != j) column2[0] += k.k12;
    column2[1] += k.k22;
  }
};

// Whether normal strains make no shear stress and both directions are alike: fewer products.
bool has_alike_axes(const Mat4& C) { return C(0, 0) == C(1, 1) && C(0, 3) == 0 && C(1, 3) == 0; }

template <CellKind kind>
void add_isotropic_plane(const Cell& cell, const ElasticLaw& law, const CellValues<kind>& v, const Columns& columns) {
  const double t = law.model.thickness, a = t * law.stiffness(0, 0), b = t * law.stiffness(0, 1),
               c = t * law.stiffness(3, 3);
  // G_ij = int dN/dx_i dN/dx_j, n x n.
  const Table<kind> w1 = v.dA.asDiagonal() * v.d1, w2 = v.dA.asDiagonal() * v.d2;
  using Square = Eigen::Matrix<double, n<kind>, n<kind>>;
  const Square G11 = v.d1.transpose() * w1, G12 = v.d1.transpose() * w2, G22 = v.d2.transpose() * w2;
  for (int p = 0; p < n<kind>; ++p)
    for (int q = 0; q < n<kind>; ++q)
      if (const int i = cell.nodes[p], j = cell.nodes[q]; columns.have(i, j))
        columns.add(i, j,
                    {a * G11(p, q) + c * G22(p, q), b * G12(p, q) + c * G12(q, p), b * G12(q, p) + c * G12(p, q),
                     a * G22(p, q) + c * G11(p, q)});
}

// Of each node's displacement the strain (11, 22, 33, gamma_12) at a quadrature point: 4 x 2 n, components alternate.
template <CellKind kind>
Eigen::Matrix<double, 4, 2 * n<kind>> strains_at(Eigen::Index q, const CellValues<kind>& v, const Model& model,
                                                 double x1) {
  Eigen::Matrix<double, 4, 2 * n<kind>> B = Eigen::Matrix<double, 4, 2 * n<kind>>::Zero();
  for (int a = 0; a < n<kind>; ++a) {
    B(0, 2 * a) = B(3, 2 * a + 1) = v.d1(q, a);
    B(1, 2 * a + 1) = B(3, 2 * a) = v.d2(q, a);
    if (model.axisymmetric()) B(2, 2 * a) = v.table.N(q, a) / x1;
  }
  return B;
}

template <CellKind kind>
void add_any(const Cell& cell, const ElasticLaw& law, const CellValues<kind>& v, const Columns& columns) {
  Eigen::Matrix<double, 2 * n<kind>, 2 * n<kind>> k = Eigen::Matrix<double, 2 * n<kind>, 2 * n<kind>>::Zero();
  for (Eigen::Index q = 0; q < points<kind>; ++q) {
    const double x1 = v.table.N.row(q).dot(v.nodes.col(0));
    const auto B = strains_at<kind>(q, v, law.model, x1);
    const Eigen::Matrix<double, 4, 2 * n<kind>> stress = v.dA(q) * law.model.depth(x1) * law.stiffness * B;
    k.noalias() += B.transpose() * stress;
  }
  for (int p = 0; p < n<kind>; ++p)
    for (int q = 0; q < n<kind>; ++q)
      if (const int i = cell.nodes[p], j = cell.nodes[q]; columns.have(i, j))
        columns.add(i, j, {k(2 * p, 2 * q), k(2 * p, 2 * q + 1), k(2 * p + 1, 2 * q), k(2 * p + 1, 2 * q + 1)});
}

template <CellKind kind>
void add_cells(const Mesh& mesh, const std::vector<ElasticLaw>& laws, const Columns& columns) {
  CellValues<kind> v{cell_table<kind>(cell_rule(kind))};
  for (const Cell& cell : mesh.cells) {
    if (cell.kind != kind || !columns.nodes.touches(cell)) continue;
    v.reinit(mesh.nodes, cell);
    const ElasticLaw& law = laws[cell.body];
    if (!law.model.axisymmetric() && has_alike_axes(law.stiffness))
      add_isotropic_plane<kind>(cell, law, v, columns);
    else
      add_any<kind>(cell, law, v, columns);
  }
}

// Calls visit(cell, values, q) for the quadrature points of the wanted cells of one kind: those of the cells' own rule,
// or, as many at a time, those of the rule that `rules` has for a cell.
template <CellKind kind, typename Wanted, typename Visit>
void for_each_point(const Mesh& mesh, const CellRules& rules, const Wanted& wanted, const Visit& visit) {
  CellValues<kind> own{cell_table<kind>(cell_rule(kind))};
  for (const Cell& cell : mesh.cells) {
    if (cell.kind != kind || !wanted(cell)) continue;
    const auto visit_points = [&](CellValues<kind>& v) {
      v.reinit(mesh.nodes, cell);
      for (Eigen::Index q = 0; q < points<kind>; ++q) visit(cell, v, q);
    };
    CellRule rule = rules ? rules(cell) : CellRule();
    if (rule.points.empty()) visit_points(own);
    for (; rule.points.size() % points<kind> != 0; rule.weights.push_back(0)) rule.points.push_back(rule.points.back());
    for (std::size_t first = 0; first < rule.points.size(); first += points<kind>) {
      CellValues<kind> v{cell_table<kind>(rule, first)};
      visit_points(v);
    }
  }
}

// load += int B^T C : eps0 over the cells of one kind; the energy of eps0.
template <CellKind kind>
double add_cell_strains(const Mesh& mesh, const std::vector<ElasticLaw>& laws, const CellRules& rules, VecX& load) {
  double energy = 0;
  const auto strained = [&](const Cell& cell) { return bool(laws[cell.body].initial_strain); };
  for_each_point<kind>(mesh, rules, strained, [&](const Cell& cell, const CellValues<kind>& v, Eigen::Index q) {
    const ElasticLaw& law = laws[cell.body];
    const Vec2 x = v.x(q);
    const double dV = v.dA(q) * law.model.depth(x.x());
    const Eigen::Matrix<double, 2 * n<kind>, 1> forces =
        strains_at<kind>(q, v, law.model, x.x()).transpose() * (-dV * law.stress0(x));
    for (int a = 0; a < n<kind>; ++a) load.segment<2>(2 * cell.nodes[a]) += forces.template segment<2>(2 * a);
    energy += dV * law.energy0(x);
  });
  return energy;
}

template <CellKind kind>
Resultant add_cell_forces(const Mesh& mesh, const Model& model, const std::vector<BodyForce>& forces,
                          const CellRules& rules, VecX& load) {
  Resultant sum;
  const auto loaded = [&](const Cell& cell) { return bool(forces[cell.body]); };
  for_each_point<kind>(mesh, rules, loaded, [&](const Cell& cell, const CellValues<kind>& v, Eigen::Index q) {
    const Vec2 x = v.x(q);
    const Vec2 force = v.dA(q) * model.depth(x.x()) * forces[cell.body](x);
    for (int a = 0; a < n<kind>; ++a) load.segment<2>(2 * cell.nodes[a]) += v.table.N(q, a) * force;
    sum.add(x, force);
  });
  return sum;
}

}  // namespace

SparseMatrix assemble_stiffness(const Mesh& mesh, const std::vector<ElasticLaw>& laws, int threads) {
  constexpr int nodes_a_thread = 20000;  // below, a thread takes longer to start than it saves
  const NodeGraph graph = node_graph(mesh);
  SparseMatrix K = block_matrix(graph);
  const int count = int(mesh.nodes.rows()), ranges = std::clamp(count / nodes_a_thread, 1, threads);
  for_each_index(ranges, threads, [&](std::size_t k) {
    const auto start = [&](std::size_t range) { return int(std::size_t(count) * range / ranges); };
    const Columns columns{graph, {start(k), start(k + 1)}, K};
    columns.lay_out();
    for_each_kind([&]<CellKind kind>() { add_cells<kind>(mesh, laws, columns); });
  });
  return K;
}

double add_initial_strain(const Mesh& mesh, const std::vector<ElasticLaw>& laws, const CellRules& rules, VecX& load) {
  double energy = 0;
  if (std::ranges::any_of(laws, [](const ElasticLaw& law) { return bool(law.initial_strain); }))
    for_each_kind([&]<CellKind kind>() { energy += add_cell_strains<kind>(mesh, laws, rules, load); });
  return energy;
}

Resultant add_body_forces(const Mesh& mesh, const Model& model, const std::vector<BodyForce>& forces,
                          const CellRules& rules, VecX& load) {
  Resultant sum;
  for_each_kind([&]<CellKind kind>() { sum += add_cell_forces<kind>(mesh, model, forces, rules, load); });
  return sum;
}

Resultant add_body_forces(const Mesh& mesh, const Model& model, const std::vector<BodyForce>& forces, VecX& load) {
  return add_body_forces(mesh, model, forces, {}, load);
}

Resultant add_traction(const Mesh& mesh, const Model& model, const CutSides& on, const Traction& traction, VecX& load) {
  Resultant sum;
  on.for_each_point(mesh, model, [&](const Edge& edge, const EdgePoint& p, const EdgeShape& s, double dA) {
    const Vec2 t = dA * traction(p.position, p.normal());
    for (int a = 0; a < edge.node_count; ++a) load.segment<2>(2 * edge.nodes[a]) += s.N[a] * t;
    sum.add(p.position, t);
  });
  return sum;
}

Resultant add_traction(const Mesh& mesh, const Model& model, const std::vector<CellSide>& sides,
                       const Traction& traction, VecX& load) {
  return add_traction(mesh, model, CutSides{sides, {}}, traction, load);
}

}  // namespace mortise
