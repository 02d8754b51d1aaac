#include "error/wanted_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mortise {
namespace {

constexpr double side_of_area = 1.5;         // side of a triangle over the root of its area
constexpr double coarsen = 0.4, refine = 6;  // by what sizes may fall at once where the error is smooth
constexpr double singular_share = 0.12;      // of a cell's energy norm; its error falls slowly then
constexpr double singular_refine = 40, line_refine = 30, border_refine = 100;
constexpr double border_share = 0.5;  // of the target of the local error, for all borders
constexpr double least_layer = 3e-5;  // of the scene's size; gmsh makes flat triangles at corners below 1e-5

// By what the size of each cell is to fall, for the far field.
VecX cell_refinement(const ErrorEstimate& estimate, const VecX& energies, double factor) {
  // The windows' parts as one number a cell, stress^2 length under the root, and what all may add up to.
  VecX part = VecX::Zero(estimate.parts.rows());
  Eigen::Index k = 0;
  for (const PressureEstimate& e : estimate.pressures) {
    const double length = e.line.h.sum() / std::max<double>(1, double(e.windows.size()));
    for (std::size_t i = 0; i < e.windows.size(); ++i) part += length * estimate.parts.col(k++).cwiseAbs2();
  }
  part = part.cwiseSqrt();
  const double target = part.sum() / factor;
  VecX r = VecX::Constant(part.size(), coarsen);
  if (!(target > 0)) return r;
  const double all = std::pow(part.array().pow(1.0 / 3).sum() / target, 0.25);
  r = (all * part.array().pow(1.0 / 6)).max(coarsen).min(refine);
  const double count = r.squaredNorm();
  for (Eigen::Index e = 0; e < r.size(); ++e) {
    const double error = estimate.energy.density(e), share = energies(e) > 0 ? std::sqrt(error / energies(e)) : 0;
    const double proportional = part(e) * count / target;
    if (share > singular_share && proportional > 1) r(e) = std::min(proportional, singular_refine);
  }
  return r;
}

// By what the edges at each vertex of a pair are to shorten.
VecX line_refinement(const PressureEstimate& e, double target, double borders) {
  const VecX& l2 = e.local.l2;
  VecX r = VecX::Constant(l2.size(), coarsen);
  if (!(target > 0)) return r;
  double sum = 0;
  for (Eigen::Index i = 0; i < l2.size(); ++i)
    if (!e.excluded[i]) sum += std::pow(l2(i), 0.4);
  const double all = std::pow(sum / (target * target), 0.25);
  for (Eigen::Index i = 0; i < l2.size(); ++i) {
    if (e.excluded[i] || !e.line.loaded[i]) continue;
    r(i) = e.local.border[i] ? std::clamp(l2(i) / (border_share * target / std::sqrt(borders)), 0.7, border_refine)
                             : std::clamp(all * std::pow(l2(i), 0.4), coarsen, line_refine);
  }
  return r;
}

double scene_size(const Mesh& mesh) {
  return (mesh.nodes.colwise().maxCoeff() - mesh.nodes.colwise().minCoeff()).norm();
}

}  // namespace

VecX wanted_sizes(const Mesh& mesh, const std::vector<ContactPair>& pairs, const ErrorEstimate& estimate,
                  double line_factor, double far_factor) {
  const VecX r = cell_refinement(estimate, estimate.energy.energies, far_factor);
  VecX logs = VecX::Zero(mesh.nodes.rows()), cells_at = logs;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const double size = side_of_area * std::sqrt(estimate.energy.areas(e)) / r(e);
    for (int a = 0; a < corner_count(mesh.cells[e].kind); ++a) {
      logs(mesh.cells[e].nodes[a]) += std::log(size);
      cells_at(mesh.cells[e].nodes[a]) += 1;
    }
  }
  VecX sizes = VecX::Constant(logs.size(), std::numeric_limits<double>::infinity());
  for (Eigen::Index i = 0; i < sizes.size(); ++i)
    if (cells_at(i) > 0) sizes(i) = std::exp(logs(i) / cells_at(i));

  double p2 = 0, borders = 0;
  for (const PressureEstimate& e : estimate.pressures) {
    p2 += e.p2;
    borders += double(std::ranges::count(e.local.border, 1));
  }
  const double target = estimate.line() * std::sqrt(p2) / line_factor;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const PressureLine& line = estimate.pressures[k].line;
    const VecX along = line_refinement(estimate.pressures[k], target, borders);
    const VecX wanted = line.h.cwiseQuotient(along);
    const auto lower = [&](int node, Eigen::Index i) {
      if (!line.loaded[i]) return;
      const double distance = (mesh.nodes.row(node).transpose() - line.position[i]).norm();
      sizes(node) = std::min(sizes(node), wanted(i) + size_growth * distance);
    };
    const std::vector<Edge>& edges = pairs[k].multiplier.edges;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      lower(edges[e].nodes[0], Eigen::Index(e));
      lower(edges[e].nodes[1], Eigen::Index(e) + 1);
    }
    for (const Edge& edge : pairs[k].opposite.edges)
      for (const int end : {0, 1})
        for (Eigen::Index i = 0; i < line.p.size(); ++i) lower(edge.nodes[end], i);
  }
  limit_growth(mesh, size_growth, sizes);
  return sizes;
}

std::vector<SizeLayers> singular_layers(const Mesh& mesh, const ErrorEstimate& estimate, double error) {
  std::vector<SizeLayers> layers;
  for (const PressureEstimate& e : estimate.pressures) {
    const double scale = e.line.h.sum() / 2;
    for (const SingularPoint& point : e.singular) {
      const double least = scale * std::pow(0.3 * error, 1 / (2 * point.exponent));
      layers.push_back({point.position, std::max(least, least_layer * scene_size(mesh)), size_growth});
    }
  }
  return layers;
}

}  // namespace mortise
