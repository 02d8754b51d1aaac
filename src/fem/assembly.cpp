#include "fem/assembly.hpp"

#include <algorithm>

#include "fem/edges.hpp"
#include "fem/elements.hpp"
#include "fem/quadrature.hpp"

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
CellTable<kind> cell_table() {
  const CellRule rule = cell_rule(kind);
  CellTable<kind> table;
  table.weights = rule.weights;
  for (Eigen::Index q = 0; q < points<kind>; ++q) {
    const CellShape s = cell_shape(kind, rule.points[q]);
    for (int a = 0; a < n<kind>; ++a) {
      table.N(q, a) = s.N[a];
      table.dxi(q, a) = s.dN[a].x();
      table.deta(q, a) = s.dN[a].y();
    }
  }
  return table;
}

// Gradients of the shape functions in space, d/dx1 and d/dx2 (a row a quadrature point), and weight x Jacobian.
template <CellKind kind>
struct CellGradients {
  Table<kind> d1, d2;
  Eigen::Matrix<double, points<kind>, 1> dV;
};

template <CellKind kind>
void cell_gradients(const Points& nodes, const Cell& cell, const CellTable<kind>& table, CellGradients<kind>& g) {
  Eigen::Matrix<double, n<kind>, 2> x;
  for (int a = 0; a < n<kind>; ++a) x.row(a) = nodes.row(cell.nodes[a]);
  for (Eigen::Index q = 0; q < points<kind>; ++q) {
    const Eigen::Matrix<double, 1, 2> x_xi = table.dxi.row(q) * x, x_eta = table.deta.row(q) * x;
    const double J = x_xi(0) * x_eta(1) - x_xi(1) * x_eta(0);
    g.d1.row(q) = (x_eta(1) * table.dxi.row(q) - x_xi(1) * table.deta.row(q)) / J;
    g.d2.row(q) = (x_xi(0) * table.deta.row(q) - x_eta(0) * table.dxi.row(q)) / J;
    g.dV(q) = table.weights[q] * J;
  }
}

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

// The lower triangle of a symmetric matrix of 2 x 2 blocks on the graph, all zero.
SparseMatrix block_matrix(const NodeGraph& graph) {
  const auto columns = graph.first.size() - 1;
  const Eigen::Index n = 2 * columns;
  SparseMatrix K(n, n);
  K.resizeNonZeros(4 * graph.row.size() - columns);
  int* outer = K.outerIndexPtr();
  int* inner = K.innerIndexPtr();
  int at = 0;
  for (std::size_t j = 0; j < columns; ++j)
    for (int c = 0; c < 2; ++c) {
      outer[2 * j + c] = at;
      for (int k = graph.first[j]; k < graph.first[j + 1]; ++k)
        for (int r = 0; r < 2; ++r)
          if (2 * graph.row[k] + r >= int(2 * j) + c) inner[at++] = 2 * graph.row[k] + r;
    }
  outer[n] = at;
  std::fill(K.valuePtr(), K.valuePtr() + at, 0.0);
  return K;
}

// Adds the block of nodes (i, j), i >= j, in place.
void add_block(const NodeGraph& graph, SparseMatrix& K, int i, int j, double k11, double k12, double k21, double k22) {
  const int* begin = graph.row.data() + graph.first[j];
  const int* end = graph.row.data() + graph.first[j + 1];
  const auto position = std::lower_bound(begin, end, i) - begin;
  double* column1 = K.valuePtr() + K.outerIndexPtr()[2 * j] + 2 * position;
  double* column2 = K.valuePtr() + K.outerIndexPtr()[2 * j + 1] + 2 * position - 1;
  column1[0] += k11;
  column1[1] += k21;
  if (i != j) column2[0] += k12;
  column2[1] += k22;
}

template <CellKind kind>
void add_cells(const Mesh& mesh, const std::vector<ElasticLaw>& laws, const NodeGraph& graph, SparseMatrix& K) {
  const CellTable<kind> table = cell_table<kind>();
  CellGradients<kind> g;
  for (const Cell& cell : mesh.cells) {
    if (cell.kind != kind) continue;
    cell_gradients(mesh.nodes, cell, table, g);
    const auto& C = laws[cell.body].stiffness;
    const double a = C(0, 0), b = C(0, 1), c = C(3, 2);
    // G_ij = int dN/dx_i dN/dx_j, n x n.
    const Table<kind> w1 = g.dV.asDiagonal() * g.d1, w2 = g.dV.asDiagonal() * g.d2;
    using Square = Eigen::Matrix<double, n<kind>, n<kind>>;
    const Square G11 = g.d1.transpose() * w1, G12 = g.d1.transpose() * w2, G22 = g.d2.transpose() * w2;
    for (int p = 0; p < n<kind>; ++p)
      for (int q = 0; q < n<kind>; ++q) {
        const int i = cell.nodes[p], j = cell.nodes[q];
        if (i < j) continue;
        add_block(graph, K, i, j, a * G11(p, q) + c * G22(p, q), b * G12(p, q) + c * G12(q, p),
                  b * G12(q, p) + c * G12(p, q), a * G22(p, q) + c * G11(p, q));
      }
  }
}

// load += int (B^T stress + N force) over the cells of one kind, with constants of each body.
template <CellKind kind>
void add_cell_loads(const Mesh& mesh, const std::vector<Vec4>& stress, const std::vector<Vec2>& force, VecX& load) {
  const CellTable<kind> table = cell_table<kind>();
  CellGradients<kind> g;
  for (const Cell& cell : mesh.cells) {
    if (cell.kind != kind) continue;
    const Vec4& s = stress[cell.body];
    const Vec2& b = force[cell.body];
    cell_gradients(mesh.nodes, cell, table, g);
    for (int a = 0; a < n<kind>; ++a) {
      const double d1 = g.dV.dot(g.d1.col(a)), d2 = g.dV.dot(g.d2.col(a)), v = g.dV.dot(table.N.col(a));
      const int i = cell.nodes[a];
      load(2 * i) += d1 * s(0) + d2 * s(3) + v * b(0);
      load(2 * i + 1) += d2 * s(1) + d1 * s(3) + v * b(1);
    }
  }
}

void add_body_loads(const Mesh& mesh, const std::vector<Vec4>& stress, const std::vector<Vec2>& force, VecX& load) {
  for_each_kind([&]<CellKind kind>() { add_cell_loads<kind>(mesh, stress, force, load); });
}

}  // namespace

SparseMatrix assemble_stiffness(const Mesh& mesh, const std::vector<ElasticLaw>& laws) {
  const NodeGraph graph = node_graph(mesh);
  SparseMatrix K = block_matrix(graph);
  for_each_kind([&]<CellKind kind>() { add_cells<kind>(mesh, laws, graph, K); });
  return K;
}

void add_initial_strain(const Mesh& mesh, const std::vector<ElasticLaw>& laws, VecX& load) {
  std::vector<Vec4> stress;
  for (const ElasticLaw& law : laws) stress.push_back(-law.stress0);
  if (std::all_of(stress.begin(), stress.end(), [](const Vec4& s) { return s.isZero(0); })) return;
  add_body_loads(mesh, stress, std::vector<Vec2>(laws.size(), Vec2::Zero()), load);
}

void add_body_forces(const Mesh& mesh, const std::vector<Vec2>& forces, VecX& load) {
  add_body_loads(mesh, std::vector<Vec4>(mesh.bodies.size(), Vec4::Zero()), forces, load);
}

VecX body_areas(const Mesh& mesh) {
  VecX areas = VecX::Zero(mesh.bodies.size());
  for_each_kind([&]<CellKind kind>() {
    const CellTable<kind> table = cell_table<kind>();
    CellGradients<kind> g;
    for (const Cell& cell : mesh.cells) {
      if (cell.kind != kind) continue;
      cell_gradients(mesh.nodes, cell, table, g);
      areas(cell.body) += g.dV.sum();
    }
  });
  return areas;
}

Vec2 add_traction(const Mesh& mesh, const std::vector<CellSide>& sides, const Traction& traction, VecX& load,
                  int gauss_points) {
  const LineRule rule = gauss_legendre(gauss_points);
  Vec2 sum = Vec2::Zero();
  for (const CellSide& at : sides) {
    const Edge edge = side_edge(mesh.cells[at.cell], at.side);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const EdgePoint p = edge_point(mesh.nodes, edge, rule.points[q]);
      const EdgeShape s = edge_shape(edge.node_count, rule.points[q]);
      const Vec2 t = rule.weights[q] * p.jacobian() * traction(p.position, p.normal());
      for (int a = 0; a < edge.node_count; ++a) load.segment<2>(2 * edge.nodes[a]) += s.N[a] * t;
      sum += t;
    }
  }
  return sum;
}

}  // namespace mortise
