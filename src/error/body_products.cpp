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

constexpr Eigen::Index at_once = 12;  // recovered stresses take far more room than displacements
constexpr double alike = 1e-10;       // of a functional: what bars, of a few digits, do not tell

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

ErrorProducts BodyProducts::products(const Problem& problem, const VecX& u, const Terms& terms) {
  const Mesh& mesh = problem.mesh;
  const BodyPoints& points = problem.points;
  const std::vector<int> first_cell = first_cells(mesh);
  const Eigen::Index cells = Eigen::Index(mesh.cells.size()), count = terms.empty() ? 0 : terms[0].second.cols();
  ErrorProducts all{.products = MatX::Zero(cells, 1 + count), .norms = VecX(cells), .areas = VecX(cells)};
  if (keeps_) bodies_.resize(mesh.bodies.size());
  for (const auto& [duals, of] : terms) duals->by_body.resize(mesh.bodies.size());
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
    std::vector<const OtherFields*> others;
    for (const auto& [duals, of] : terms) {
      OtherFields& own = duals->by_body[b];
      if (own.count() == 0) own = recovered(duals->z);
      others.push_back(&own);
    }
    const ErrorProducts found = error_products(body.mesh, body.points, law, recovered(u), others);
    const Eigen::Index own_cells = found.areas.size();
    auto of_body = all.products.middleRows(first_cell[b], own_cells);
    of_body.col(0) = found.products.col(0);
    Eigen::Index first = 1;
    for (const auto& [duals, of] : terms) {
      of_body.rightCols(count).noalias() += found.products.middleCols(first, of.rows()) * of;
      first += of.rows();
      if (!keeps_) duals->by_body[b] = {};
    }
    all.norms.segment(first_cell[b], own_cells) = found.norms;
    all.areas.segment(first_cell[b], own_cells) = found.areas;
  });
  return all;
}

std::unique_ptr<BodyProducts::Duals> BodyProducts::solved(const ContactFactor& factor, DualsAsked asked) {
  MatX z = factor.duals(asked.functionals, asked.loads);
  return std::make_unique<Duals>(Duals{std::move(asked), std::move(z), {}});
}

DualSums BodyProducts::sums_of(const Terms& terms) {
  std::vector<DualSums::Term> all;
  for (const auto& [duals, of] : terms) all.push_back({duals->z, of});
  return DualSums(std::move(all));
}

// Solves for what of the functionals, which have no loads, is no sum of those known.
void BodyProducts::add_unknown(const ContactFactor& factor, const MatX& functionals) {
  MatX known(functionals.rows(), 0);
  const auto add = [&](const auto& columns) {
    known.conservativeResize(Eigen::NoChange, known.cols() + columns.cols());
    known.rightCols(columns.cols()) = columns;
  };
  for (const auto& duals : duals_)
    if (!duals->loaded()) add(duals->asked.functionals);
  if (known.cols() > 2 * functionals.cols()) {
    std::erase_if(duals_, [](const auto& duals) { return !duals->loaded(); });
    known.resize(Eigen::NoChange, 0);
  }
  const Eigen::Index before = known.cols();
  for (const auto& functional : functionals.colwise()) {
    VecX rest = functional;
    for (int pass = 0; pass < 2; ++pass) rest -= known * (known.transpose() * rest);  // once leaves round-off of it
    if (rest.norm() > alike * functional.norm()) add(rest.normalized());
  }
  for (Eigen::Index first = before; first < known.cols(); first += at_once)
    duals_.push_back(solved(factor, {known.middleCols(first, std::min(at_once, known.cols() - first)), {}}));
}

// Duals of functionals and loads that have been asked for together, or are now.
BodyProducts::Duals& BodyProducts::loaded_duals(const ContactFactor& factor, DualsAsked asked) {
  for (const auto& duals : duals_)
    if (same(duals->asked.functionals, asked.functionals) && same(duals->asked.loads, asked.loads)) return *duals;
  return *duals_.emplace_back(solved(factor, std::move(asked)));
}

BodyProducts::Terms BodyProducts::find(const std::shared_ptr<const ContactFactor>& factor, const DualsAsked& asked) {
  if (factor_ != factor) duals_.clear();
  factor_ = factor;
  const Eigen::Index count = asked.functionals.cols(), loaded = asked.loads.cols(), others = count - loaded;
  Terms terms;
  if (others > 0) {
    add_unknown(*factor, asked.functionals.leftCols(others));
    for (const auto& duals : duals_)
      if (!duals->loaded()) {
        MatX of = MatX::Zero(duals->z.cols(), count);
        of.leftCols(others) = duals->asked.functionals.transpose() * asked.functionals.leftCols(others);
        terms.emplace_back(duals.get(), std::move(of));
      }
  }
  for (Eigen::Index first = 0; first < loaded; first += at_once) {
    const Eigen::Index some = std::min(at_once, loaded - first);
    Duals& duals = loaded_duals(*factor, {asked.functionals.middleCols(others + first, some),  //
                                          asked.loads.middleCols(first, some)});
    terms.emplace_back(&duals, MatX::Zero(some, count));
    terms.back().second.middleCols(others + first, some).setIdentity();
  }
  return terms;
}

ErrorProducts BodyProducts::with_duals(const Problem& problem, const VecX& u,
                                       const std::shared_ptr<const ContactFactor>& factor, const DualsAsked& asked,
                                       const SeeDuals& see) {
  const Eigen::Index count = asked.functionals.cols(), without_load = count - asked.loads.cols();
  const auto products_of = [&](Eigen::Index first, const Terms& terms) {
    if (see) see(first, sums_of(terms));
    return products(problem, u, terms);
  };
  if (keeps_) return products_of(0, find(factor, asked));
  ErrorProducts all;
  for (Eigen::Index first = 0; first < count; first += at_once) {
    const Eigen::Index some = std::min(at_once, count - first);
    const Eigen::Index loaded = std::clamp(first + some - without_load, Eigen::Index(0), some);
    const auto duals =
        solved(*factor, {asked.functionals.middleCols(first, some),
                         asked.loads.middleCols(std::max(first - without_load, Eigen::Index(0)), loaded)});
    ErrorProducts found = products_of(first, {{duals.get(), MatX::Identity(some, some)}});
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

}  // namespace mortise
