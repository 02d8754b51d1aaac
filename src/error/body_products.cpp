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

bool same(const MatX& a, const MatX& b) { return a.rows() == b.rows() && a.cols() == b.cols() && a == b; }

// Of a body's own points, rows of fields.
MatX fields_at(const std::vector<int>& node, int first, int count, const Eigen::Ref<const MatX>& fields) {
  MatX own(2 * count, fields.cols());
  for (int i = 0; i < count; ++i) own.middleRows<2>(2 * i) = fields.middleRows<2>(2 * node[first + i]);
  return own;
}

}  // namespace

BodyProducts::Body BodyProducts::body_of(const Problem& problem, std::size_t b, int first_cell) {
  const Mesh& mesh = problem.mesh;
  const BodyPoints& points = problem.points;
  const int first = points.first[b], nodes = points.first[b + 1] - first;
  Body body;
  body.mesh.bodies = {mesh.bodies[b]};
  body.mesh.nodes.resize(nodes, 2);
  body.points = {.first = {0, nodes}, .node = std::vector<int>(nodes)};
  std::iota(body.points.node.begin(), body.points.node.end(), 0);
  for (int i = 0; i < nodes; ++i) body.mesh.nodes.row(i) = mesh.nodes.row(points.node[first + i]);
  for (std::size_t e = first_cell; e < mesh.cells.size() && mesh.cells[e].body == int(b); ++e) {
    Cell& cell = body.mesh.cells.emplace_back(mesh.cells[e]);
    for (int a = 0; a < node_count(cell.kind); ++a) cell.nodes[a] = point_of(points, int(b), cell.nodes[a]) - first;
    cell.body = 0;
  }
  return body;
}

// `kept`: z by body, made where it is empty, and kept there; null: made and dropped.
ErrorProducts BodyProducts::products(const Problem& problem, const VecX& u, const MatX& z,
                                     std::vector<OtherFields>* kept) {
  const Mesh& mesh = problem.mesh;
  const BodyPoints& points = problem.points;
  const std::vector<int> first_cell = first_cells(mesh);
  const Eigen::Index cells = Eigen::Index(mesh.cells.size()), count = 1 + z.cols();
  ErrorProducts all{.products = MatX(cells, count), .norms = VecX(cells), .areas = VecX(cells)};
  if (keeps_) bodies_.resize(mesh.bodies.size());
  const bool known = kept && !kept->empty();
  if (kept) kept->resize(mesh.bodies.size());
  for_each_index(mesh.bodies.size(), solver_threads(), [&](std::size_t b) {
    Body made, &body = keeps_ ? bodies_[b] : made;
    if (body.mesh.cells.empty()) body = body_of(problem, b, first_cell[b]);
    const std::vector<ElasticLaw> law{problem.discretisation.laws[b]};
    const int nodes = int(body.points.node.size());
    const auto recovered = [&](const Eigen::Ref<const MatX>& fields) {
      RecoveredFields own{fields_at(points.node, points.first[b], nodes, fields), {}};
      const StressSamples samples = sample_stresses(body.mesh, law, own.fields);
      if (!body.recovery) body.recovery = std::make_unique<PatchRecovery>(body.mesh, body.points, samples);
      own.patches = body.recovery->fit(samples);
      return own;
    };
    OtherFields dropped, &others = kept ? (*kept)[b] : dropped;
    if (z.cols() > 0 && !known) others = recovered(z);
    const ErrorProducts found = error_products(body.mesh, body.points, law, recovered(u), others);
    const Eigen::Index own_cells = found.areas.size();
    all.products.middleRows(first_cell[b], own_cells) = found.products;
    all.norms.segment(first_cell[b], own_cells) = found.norms;
    all.areas.segment(first_cell[b], own_cells) = found.areas;
  });
  return all;
}

BodyProducts::Duals& BodyProducts::find(const std::shared_ptr<const ContactFactor>& factor, DualsAsked asked) {
  if (!keeps_ || factor_ != factor) duals_.clear();
  factor_ = factor;
  for (const auto& duals : duals_)
    if (same(duals->asked.functionals, asked.functionals) && same(duals->asked.loads, asked.loads)) return *duals;
  MatX z = factor->duals(asked.functionals, asked.loads);
  return *duals_.emplace_back(std::make_unique<Duals>(Duals{std::move(asked), std::move(z), {}}));
}

ErrorProducts BodyProducts::with_duals(const Problem& problem, const VecX& u,
                                       const std::shared_ptr<const ContactFactor>& factor, const DualsAsked& asked,
                                       const SeeDuals& see) {
  constexpr Eigen::Index at_once = 12;  // recovered stresses take far more room than displacements
  const Eigen::Index count = asked.functionals.cols(), without_load = count - asked.loads.cols();
  ErrorProducts all;
  for (Eigen::Index first = 0; first < count; first += at_once) {
    const Eigen::Index some = std::min(at_once, count - first);
    const Eigen::Index loaded = std::clamp(first + some - without_load, Eigen::Index(0), some);
    Duals& duals = find(factor, {asked.functionals.middleCols(first, some),
                                 asked.loads.middleCols(std::max(first - without_load, Eigen::Index(0)), loaded)});
    if (see) {
      MatX fields(u.size(), 1 + some);
      fields << u, duals.z;
      see(first, fields);
    }
    ErrorProducts found = products(problem, u, duals.z, keeps_ ? &duals.by_body : nullptr);
    if (first == 0) {
      all = std::move(found);
      all.products.conservativeResize(Eigen::NoChange, 1 + count);
    } else {
      all.products.middleCols(1 + first, some) = found.products.rightCols(some);
    }
  }
  return all;
}

VecX off_by(const MatX& parts) {
  VecX all(parts.cols());
  for (Eigen::Index k = 0; k < all.size(); ++k)
    all(k) = off_by(parts.col(k).sum(), parts.col(k).squaredNorm(), parts.col(k).lpNorm<1>());
  return all;
}

FoundDuals find_duals(const Problem& problem, const VecX& u, const std::shared_ptr<const ContactFactor>& factor,
                      const MatX& functionals) {
  FoundDuals found{.z = MatX(u.size(), functionals.cols()), .sums = {}};
  const auto keep = [&](Eigen::Index first, const MatX& fields) {
    found.z.middleCols(first, fields.cols() - 1) = fields.rightCols(fields.cols() - 1);
  };
  const ErrorProducts parts = BodyProducts().with_duals(problem, u, factor, {functionals, MatX(u.size(), 0)}, keep);
  found.sums = off_by(parts.products.rightCols(functionals.cols()));
  return found;
}

}  // namespace mortise
