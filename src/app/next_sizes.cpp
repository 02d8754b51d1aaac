#include "app/next_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "contact/least_gap.hpp"
#include "results/point_supports.hpp"

namespace mortise {
namespace {

constexpr double largest_step = 16;  // by which one mesh is to lower the error: a coarse one's estimate is not exact
constexpr double least_miss = 0.7;   // of what was asked, lest a mesh that just misses it be solved in vain

}  // namespace

double changed_by_point_supports(const Results& r) {
  const std::vector<double> changes = changes_by_point_supports(r);
  return changes.empty() ? 0 : std::ranges::max(changes);
}

double estimated_error(const Results& r, Goal of) {
  switch (of) {
    case Goal::pressure:
      return std::hypot(r.estimate->pressure(), changed_by_point_supports(r));
    case Goal::peak:
      return r.estimate->peak();
    case Goal::half_width:
      return r.estimate->half_width();
    case Goal::mean:
    case Goal::force:
    case Goal::displacement:
    case Goal::stress:
      return r.estimate->goal->error();
  }
  return 0;
}

// On the first mesh p swings about corners that have no layers yet: its edges are judged by the slopes alone.
WantedSizes wanted_next(const Results& r, const AccuracySpec& spec, bool first, double aim) {
  const ErrorEstimate& e = *r.estimate;
  const double aimed = least_miss * aim;
  // What was asked of another quantity, as an error of p that is as far above what it should be.
  const double found = estimated_error(r, spec.of),
               asked = spec.value * (spec.of == Goal::pressure ? 1 : e.pressure() / found);
  // As few meshes as can be, of which each lowers the error by the same part.
  const double fall = e.pressure() / (aimed * asked),
               meshes = std::max(1.0, std::ceil(std::log(fall) / std::log(largest_step))),
               target = aimed * asked * std::pow(fall, 1 - 1 / meshes) / error_safety;
  const double overlaps = e.overlaps().sum();
  ErrorFactors factors{
      .line = std::clamp((first ? e.slopes() : e.line()) / (0.8 * target), 0.4, largest_step),
      .far_field = std::clamp(std::max(e.far_field() - overlaps, 0.) / (0.5 * target), 0.25, 5 * largest_step),
      .target = target,
      .overlaps = std::clamp(overlaps / (0.1 * target), 0.4, 5 * largest_step)};  // edges at borders are few
  if (spec.of == Goal::half_width) factors.border = found / (aimed * spec.value);
  if (e.goal) {
    const double parts = e.goal->local > 0 ? 3 : 2,
                 each = aimed * spec.value * e.goal->value.norm() / (parts * error_safety);
    factors.line = std::clamp(e.goal->local / each, 0.4, largest_step);
    factors.goal_line = std::clamp(e.goal->line() / each, 0.4, largest_step);
    factors.far_field = std::clamp(e.goal->far() / each, 0.25, 5 * largest_step);
  }
  return wanted_sizes(r.problem.mesh, r.problem.pairs, e, factors);
}

double expected_unknowns(const Mesh& mesh, const VecX& areas, const SizeField& sizes) {
  double count = 0;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const double size = sizes(centre_of(mesh.nodes, mesh.cells[e]));
    count += 4 * areas(e) / (std::sqrt(3.0) / 4 * size * size);  // about four unknowns a triangle
  }
  return count;
}

SizeAt scaled(const SizeAt& sizes, double factor) {
  return [sizes, factor](const Vec2& x) { return factor * sizes(x); };
}

SizeAt with_layers(const SizeAt& sizes, std::vector<SizeLayers> layers) {
  return [sizes, layered = std::make_shared<LayeredSizes>(std::move(layers))](const Vec2& x) {
    return std::min(sizes(x), (*layered)(x));
  };
}

SizeAt small_at_gaps(const Results& r, const SizeAt& sizes) {
  std::vector<SizeLayers> layers;
  for (const ContactPair& pair : r.problem.pairs) {
    if (r.solution.lambda.segment(pair.first_row, pair.coupling.B.rows()).cwiseAbs().maxCoeff() > 0) continue;
    const LeastGap gap = least_gap(r.problem.mesh.nodes, r.solution.u, pair);
    if (std::isfinite(gap.gap)) layers.push_back({gap.place, gap.edge / 8, size_growth});
  }
  return with_layers(sizes, std::move(layers));
}

bool are_shorter(const std::vector<SizeLayers>& layers, const SizeAt& sizes) {
  return std::ranges::any_of(layers, [&](const SizeLayers& of) { return of.least < sizes(of.centre) / another; });
}

}  // namespace mortise
