#include "error/body_products.hpp"

#include <algorithm>
#include <numeric>

#include "base/parallel.hpp"
#include "solve/threads.hpp"

namespace mortise {
namespace {

// First cell of each body, and their number.
std::vector<int> first_cells(const Mesh& mesh) {
  std::vector<int> first(mesh.bodies.size() + 1, 0);
  for (const Cell& cell : mesh.cells) ++first[cell.body + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  return first;
}

}  // namespace

ErrorProducts products_by_body(const Problem& problem, const MatX& fields) {
  const Mesh& mesh = problem.mesh;
  const BodyPoints& points = problem.points;
  const std::vector<Cell> on_points = cells_on_points(mesh, points);
  const std::vector<int> first_cell = first_cells(mesh);
  const Eigen::Index cells = Eigen::Index(mesh.cells.size()), count = fields.cols();
  ErrorProducts all{.products = MatX(cells, count), .norms = VecX(cells), .areas = VecX(cells)};
  for_each_index(mesh.bodies.size(), solver_threads(), [&](std::size_t b) {
    const int first = points.first[b], nodes = points.first[b + 1] - first;
    Mesh body;
    body.bodies = {mesh.bodies[b]};
    body.nodes.resize(nodes, 2);
    BodyPoints all_nodes{.first = {0, nodes}, .node = std::vector<int>(nodes)};
    std::iota(all_nodes.node.begin(), all_nodes.node.end(), 0);
    MatX of_body(2 * nodes, count);
    for (int i = 0; i < nodes; ++i) {
      const int node = points.node[first + i];
      body.nodes.row(i) = mesh.nodes.row(node);
      of_body.middleRows<2>(2 * i) = fields.middleRows<2>(2 * node);
    }
    body.cells.assign(on_points.begin() + first_cell[b], on_points.begin() + first_cell[b + 1]);
    for (Cell& cell : body.cells) {
      cell.body = 0;
      for (int a = 0; a < node_count(cell.kind); ++a) cell.nodes[a] -= first;
    }
    const std::vector<ElasticLaw> law{problem.discretisation.laws[b]};
    const ErrorProducts own = error_products(body, all_nodes, law, of_body,
                                             recover_patches(body, all_nodes, sample_stresses(body, law, of_body)));
    const Eigen::Index own_cells = own.areas.size();
    all.products.middleRows(first_cell[b], own_cells) = own.products;
    all.norms.segment(first_cell[b], own_cells) = own.norms;
    all.areas.segment(first_cell[b], own_cells) = own.areas;
  });
  return all;
}

ErrorProducts products_with_duals(const Problem& problem, const VecX& u, const ContactFactor& factor,
                                  const MatX& functionals, const MatX& loads, const SeeDuals& see) {
  constexpr Eigen::Index at_once = 12;  // recovered stresses take far more room than displacements
  const Eigen::Index count = functionals.cols(), without_load = count - loads.cols();
  ErrorProducts all;
  for (Eigen::Index first = 0; first < count; first += at_once) {
    const Eigen::Index duals = std::min(at_once, count - first);
    MatX fields(u.size(), 1 + duals);
    fields.col(0) = u;
    const Eigen::Index loaded = std::clamp(first + duals - without_load, Eigen::Index(0), duals);
    const MatX own = loads.middleCols(std::max(first - without_load, Eigen::Index(0)), loaded);
    fields.rightCols(duals) = factor.duals(functionals.middleCols(first, duals), own);
    if (see) see(first, fields);
    ErrorProducts some = products_by_body(problem, fields);
    if (first == 0) {
      all = std::move(some);
      all.products.conservativeResize(Eigen::NoChange, 1 + count);
    } else {
      all.products.middleCols(1 + first, duals) = some.products.rightCols(duals);
    }
  }
  return all;
}

FoundDuals find_duals(const Problem& problem, const VecX& u, const ContactFactor& factor, const MatX& functionals) {
  FoundDuals found{.z = MatX(u.size(), functionals.cols()), .sums = {}};
  const auto keep = [&](Eigen::Index first, const MatX& fields) {
    found.z.middleCols(first, fields.cols() - 1) = fields.rightCols(fields.cols() - 1);
  };
  const MatX no_loads(u.size(), 0);
  const ErrorProducts parts = products_with_duals(problem, u, factor, functionals, no_loads, keep);
  found.sums = parts.products.rightCols(functionals.cols()).cwiseAbs().colwise().sum();
  return found;
}

}  // namespace mortise
