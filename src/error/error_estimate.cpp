#include "error/error_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "error/border_overlaps.hpp"
#include "error/corner_cells.hpp"
#include "error/data_works.hpp"
#include "error/dual_functionals.hpp"
#include "error/false_borders.hpp"
#include "error/fitted_pressure.hpp"
#include "error/gap_error.hpp"
#include "error/missed_contact.hpp"
#include "error/narrow_contact.hpp"
#include "error/pressure_bars.hpp"
#include "error/recovered_pressure.hpp"
#include "error/sliding_kinks.hpp"
#include "error/tip_rings.hpp"
#include "error/weak_points.hpp"
#include "solve/contact_factor.hpp"
#include "solve/threads.hpp"

namespace mortise {
namespace {

// Of the error of the whole's stiffness, the square of that in the energy norm, what one row of bodies may have. Where
// displacements drive it, p everywhere is off by that, which the nearest windows of shared duals do not tell.
constexpr double uneven = 3;

// Those whose logarithm counts: from the scene's size down to the least edges that are made (wanted_sizes.cpp), 15
// times e-fold, it adds more to p than this part of p's mean, or than what is asked.
std::vector<SingularPoint> that_count(std::vector<SingularPoint> points, const PressureLine& line, double asked) {
  constexpr double folds = 15, least = 0.01;
  const double loaded = line.h.dot((line.p.array() != 0).cast<double>().matrix());
  const double mean = std::sqrt(line.h.dot(line.p.cwiseAbs2()) / loaded);
  std::erase_if(points, [&](SingularPoint& point) {
    if (folds * point.log_pressure <= std::max(least, asked) * mean) point.log_pressure = 0;
    return point.exponent > singular_limit && point.log_pressure == 0 && point.small_power == 0 &&
           point.small_turn == 0;
  });
  return points;
}

double error_norm(const std::vector<PressureEstimate>& pressures, double local, double far) {
  double error = 0;
  for (const PressureEstimate& e : pressures) error += local * e.local2 + far * e.far2;
  return std::sqrt(error);
}

std::vector<char> either(std::vector<char> one, const std::vector<char>& other) {
  std::ranges::transform(one, other, one.begin(), [](char a, char b) { return a || b; });
  return one;
}

// Windows at ends and borders, and the fluctuations if each window keeps a dual of its own with them. Returns how many
// duals more those have that lie beside borders.
int add_end_windows(const std::vector<ContactPair>& pairs, std::vector<PressureEstimate>& list) {
  std::size_t count = 0;
  for (const PressureEstimate& e : list) count += e.windows.size() + 2 + e.local.borders.size();
  const bool own = count <= most_own_duals;
  int beside = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    PressureEstimate& e = list[k];
    if (e.windows.empty()) continue;
    if (own)
      e.fluctuation =
          pressure_fluctuation(pairs[k], e.line, either(e.excluded, e.swings), 2 * e.windows[0].place.reach);
    // Beside a point where p has no limit p_h may be zero at vertices that are left out: p does not end there.
    std::vector<LineError::Border> borders = e.local.borders;
    std::erase_if(borders, [&](const auto& b) { return e.excluded[b.edge] && e.excluded[b.edge + 1]; });
    e.windows = with_end_windows(pairs[k], e.line, borders, e.excluded, std::move(e.windows));
    if (own) beside += windows_beside_borders(e.line, borders);
  }
  return beside;
}

// `reached`: of each pair the vertices that contact reaches.
std::vector<PressureEstimate> lines_with_windows(const Problem& p, EstimateMemory& memory, const Solution& solution,
                                                 const EstimateOptions& options, std::vector<ContactReach>& reached) {
  const Discretisation& d = p.discretisation;
  const AccuracySpec& spec = options.spec;
  const double displacement = largest_entry(solution.u);
  std::vector<PressureEstimate> list(p.pairs.size());
  reached.resize(p.pairs.size());
  for_each_index(p.pairs.size(), solver_threads(), [&](std::size_t k) {
    PressureEstimate& e = list[k];
    const ContactPair& pair = p.pairs[k];
    const double round_off = round_off_pressure(p.mesh, pair, d.laws, displacement);
    e.line = pressure_line(p.mesh, pair, solution.lambda, round_off, p.fluid);
    e.local = line_error(e.line);
    if (!e.line.p.any() && solution.lambda.segment(pair.first_row, pair.coupling.B.rows()).any())
      for (Eigen::Index i = 0; i < e.line.p.size(); ++i) e.local.raise(i, round_off);  // of what was set to 0
    add_gap_error(e.line, gap_error(pair, d.laws, e.line), e.local);
    e.windows = pressure_windows(pair, e.line);
    reached[k] = contact_reach(p.mesh, pair, d.laws, e.line, solution.u, options.found);
  });
  const std::vector<std::vector<SingularPoint>> points = memory.points(p, reached);
  const double negligible = negligible_force(list, spec);
  for_each_index(p.pairs.size(), solver_threads(), [&](std::size_t k) {
    PressureEstimate& e = list[k];
    const ContactPair& pair = p.pairs[k];
    if (!pair.spec.stiffness)  // p is no larger than k times the overlap
      e.singular = that_count(points[k], e.line, spec.value);
    e.swings = swinging(e);
    forget_false_borders(e);
    e.weak = add_weak_points(e.line, e.singular, e.local);
    add_hardly_faced(pair, e.line, e.local);
    add_axis_end(pair, e.line, e.local);
    add_hidden_fillets(p.mesh.nodes, pair, e.line, e.local);
    const std::array<ElasticLaw, 2> laws{d.laws[pair.multiplier.body], d.laws[pair.opposite.body]};
    const double modulus = contact_modulus(laws[0], laws[1]);
    if (pair.spec.stiffness) {
      add_layer_ends(e.line, points[k], *pair.spec.stiffness, modulus, e.local);
    } else {
      judge_small_kinks(pair, modulus, solution.u, spec.value, e);
      add_curvature_jumps(p.mesh.nodes, pair, laws, solution.u, reached[k][0], e);
    }
    find_excluded(spec.exclude, negligible, e);
  });
  return list;
}

// The corners of the bodies whose faces are free of contact.
std::vector<BodyCorner> free_corners(std::vector<BodyCorner> corners, Eigen::Index nodes,
                                     const std::vector<ContactPair>& pairs, const std::vector<ContactReach>& reached) {
  std::vector<char> in_contact(nodes, 0);
  for (std::size_t k = 0; k < pairs.size(); ++k)
    for (const int side : {0, 1}) {
      if (pairs[k].spec.stiffness) continue;  // it loads a corner, and holds no face
      const Curve& curve = side == 0 ? pairs[k].multiplier : pairs[k].opposite;
      for (std::size_t e = 0; e < curve.edges.size(); ++e)
        for (const int end : {0, 1})
          if (reached[k][side][e + end].any()) in_contact[curve.edges[e].nodes[end]] = 1;
    }
  std::erase_if(corners, [&](const BodyCorner& corner) { return in_contact[corner.node] != 0; });
  return corners;
}

std::vector<WindowPlace> window_places(const std::vector<PressureEstimate>& pressures) {
  std::vector<WindowPlace> places;
  for (const PressureEstimate& e : pressures)
    for (const PressureWindow& window : e.windows) places.push_back(window.place);
  return places;
}

std::vector<TailShares> tails_along(const Mesh& mesh, const std::vector<PressureEstimate>& pressures,
                                    const SharedDuals& duals, CornerTails& tails) {
  std::vector<const PressureLine*> lines;
  std::vector<const std::vector<PressureWindow>*> windows;
  for (const PressureEstimate& e : pressures) {
    lines.push_back(&e.line);
    windows.push_back(&e.windows);
  }
  return tail_shares(mesh, lines, windows, duals, tails);
}

// Of all pairs; `opening`: what of that of pair `of` is asked for, none where it is empty.
std::vector<LinePart> line_parts(const std::vector<ContactPair>& pairs, const std::vector<PressureEstimate>& pressures,
                                 const MatX& duals, int of, const MatX& opening) {
  std::vector<LinePart> parts;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    MatX opened = openings(pairs[k], duals);
    if (int(k) == of && opening.size() > 0) opened -= opening;
    parts.push_back(line_part(pairs[k], pressures[k].line, pressures[k].local, opened));
  }
  return parts;
}

// To the borders of each pair, in equal parts.
void add_overlaps(const MatX& changes, std::vector<LinePart>& lines) {
  for (std::size_t k = 0; k < lines.size(); ++k) {
    MatX& borders = lines[k].borders;
    if (borders.rows() > 0) borders.rowwise() += changes.row(Eigen::Index(k)) / double(borders.rows());
  }
}

// Of each window what the cells' parts make it off by.
VecX far_fields(const Mesh& mesh, const FarField& far, const std::vector<PressureEstimate>& pressures) {
  if (far.windows.own()) return off_by(far.parts.leftCols(far.windows.count), tip_rings(mesh, pressures));
  const Eigen::Index count = Eigen::Index(far.windows.dual.size());
  MatX sums = MatX::Zero(count, 3);  // of the parts, their squares and their sizes
  for (Eigen::Index e = 0; e < far.parts.rows(); ++e) {
    const Cell& cell = mesh.cells[e];
    const Vec2 x = centre_of(mesh.nodes, cell);
    for (int d = 0; d < far.windows.count; ++d)
      far.windows.for_each_window(cell.body, d, x, [&](int window, double share) {
        const double part = share * far.parts(e, d);
        sums.row(window) += Eigen::RowVector3d(part, part * part, std::abs(part));
      });
  }
  VecX all(count);
  for (Eigen::Index k = 0; k < count; ++k) all(k) = off_by(sums(k, 0), sums(k, 1), sums(k, 2));
  return all;
}

// |p|, stress; where p has no limit its largest node measures the mesh.
double largest_that_counts(const PressureEstimate& e) {
  double most = 0;
  for (Eigen::Index i = 0; i < e.line.p.size(); ++i)
    if (e.counts(i)) most = std::max(most, std::abs(e.line.p(i)));
  return most;
}

// What cells do to each window's mean, its corners' tails, and where windows share duals the stiffness of the whole.
void add_far_errors(const Mesh& mesh, ErrorEstimate& estimate) {
  std::vector<TailShares> tails = tails_along(mesh, estimate.pressures, estimate.far.windows, estimate.tails);
  const VecX far = far_fields(mesh, estimate.far, estimate.pressures) + estimate.far.overlaps.windows;
  const Eigen::Index of_windows = estimate.far.windows.count, others = estimate.far.parts.cols() - of_windows;
  const VecX fluctuations =
      off_by(estimate.far.parts.rightCols(others)) + estimate.tails.parts.rightCols(others).colwise().sum().transpose();
  const double stiffness_part = uneven * estimate.energy.error * estimate.energy.error;
  Eigen::Index window = 0, fluctuation = 0;
  for (std::size_t k = 0; k < estimate.pressures.size(); ++k) {
    PressureEstimate& e = estimate.pressures[k];
    e.tails = std::move(tails[k]);
    e.far = far.segment(window, Eigen::Index(e.windows.size())) + e.tails.means;
    if (e.fluctuation) e.fluctuation->far = fluctuations(fluctuation++);
    if (!estimate.far.windows.own()) e.far.array() += stiffness_part * largest_that_counts(e);
    window += Eigen::Index(e.windows.size());
    find_bars(e);
  }
}

// The errors of cells and at the bodies' corners, and what they do to the functionals.
void add_products(const Problem& p, const Solution& solution, const GoalFunctionals& goal,
                  const EstimateOptions& options, const BorderOverlaps& overlaps, EstimateMemory& memory,
                  ErrorEstimate& estimate) {
  const SaddlePointSystem& system = p.discretisation.system;
  const MatX functionals = dual_functionals(p, estimate.pressures, estimate.far.windows, options.also, goal.rows);
  const Eigen::Index goals = goal.rows.cols(), more = options.also.cols(), shared = functionals.cols() - goals - more;
  CornerProducts at_corners(p.mesh, p.discretisation.laws, estimate.tails.corners);
  MatX kept(more + goals > 0 ? solution.u.size() : 0, more + goals);
  MatX works(Eigen::Index(p.misfits.parts.size()), functionals.cols());
  const auto see = [&](Eigen::Index first, const DualSums& duals) {
    at_corners.add(solution.u, duals);
    if (works.rows() > 0) works.middleCols(first, duals.count()) = data_works(p, solution.u, duals.fields());
    for (Eigen::Index k = std::max(first, shared); k < first + duals.count(); ++k)
      kept.col(k - shared) = duals.field(k - first);
  };
  const bool has_duals = functionals.cols() > 0;
  const ErrorProducts found = has_duals ? memory.products.with_duals(p, solution.u, contact_factor(system, solution),
                                                                     {functionals, goal.loads}, see)
                                        : memory.products.of(p, solution.u);
  estimate.energy = energy_estimate(p.mesh, found, system.stiffness_scale, solution.u);
  estimate.far.parts = found.products.middleCols(1, shared);
  estimate.far.overlaps = overlaps.of_windows(p.pairs, estimate.pressures);
  if (!has_duals) return;
  if (goals > 0) {
    estimate.goal = goal_estimate(goal, solution, found.products.rightCols(goals));
    estimate.goal->lines =
        line_parts(p.pairs, estimate.pressures, kept.rightCols(goals), options.spec.pair, goal.opening);
    add_overlaps(overlaps.changes(goal.rows, goal.loads), estimate.goal->lines);
  }
  estimate.data_works.resize(works.rows(), shared + goals);
  estimate.data_works.leftCols(shared) = works.leftCols(shared);
  estimate.data_works.rightCols(goals) = works.rightCols(goals);
  const MatX tails = at_corners.tails();
  estimate.tails.parts = tails.leftCols(shared);
  estimate.tails.goal = tails.rightCols(goals);
  if (goals > 0) {
    const std::vector<int> cells = cells_at_contact(p.mesh, memory.around(p).table, p.pairs, estimate.pressures);
    estimate.goal->besides += estimate.tails.goal.colwise().sum().transpose() +
                              unseen_at_corners(p.mesh, cells, found.products.rightCols(goals));
  }
  if (more == 0) return;
  const MatX of_more = found.products.middleCols(1 + shared, more);
  estimate.also = {
      .z = kept.leftCols(more),
      .sums = off_by(of_more) + unseen_at_corners(p.mesh, cells_at_corners(p, estimate.pressures, memory), of_more) +
              off_by(works.middleCols(shared, more)) + overlaps.changes(options.also, {}).colwise().sum().transpose()};
}

void require_pair(const AccuracySpec& spec, std::size_t count) {
  if (spec.pair >= int(count) && spec.pair > 0)
    throw SceneError("accuracy.pair: " + std::to_string(spec.pair) + "; expected a number below that of the pairs, " +
                     std::to_string(count));
}

}  // namespace

double ErrorEstimate::peak() const {
  double p = 0, most = 0, bar = std::numeric_limits<double>::quiet_NaN();
  for (const PressureEstimate& e : pressures)
    for (Eigen::Index i = 0; i < e.line.p.size(); ++i) {
      most = std::max(most, e.line.whole(i) + e.bar(i));
      if (e.line.whole(i) > p) {
        p = e.line.whole(i);
        bar = e.bar(i);
      }
    }
  return std::max(bar, most - p) / p;
}

double ErrorEstimate::half_width() const {
  const auto is_pressed = [](const PressureEstimate& e) { return largest_entry(e.line.p) > 0; };
  if (std::ranges::none_of(pressures, is_pressed)) return std::numeric_limits<double>::infinity();
  double part = 0;
  for (const PressureEstimate& e : pressures) {
    if (!e.local.missed_at.empty()) part = std::max(part, 1.0);  // a contact that is there and has no width yet
    for (const LineError::Border& border : e.local.borders) {
      const double edge = e.line.s(border.edge + 1) - e.line.s(border.edge);
      part = std::max(part, border.part * (1 + error_safety * border_motion(e, border) / edge));
    }
  }
  return part;
}

double ErrorEstimate::pressure_square() const {
  double square = 0;
  for (const PressureEstimate& e : pressures) square += e.p2;
  return square;
}

double ErrorEstimate::pressure() const {
  return error_safety * error_norm(pressures, 1, 1) / std::sqrt(pressure_square());
}
double ErrorEstimate::pressure_of(const std::vector<std::size_t>& pairs) const {
  double error2 = 0, p2 = 0;
  for (const std::size_t k : pairs) {
    error2 += pressures[k].local2 + pressures[k].far2;
    p2 += pressures[k].p2;
  }
  return error_safety * std::sqrt(error2 / p2);
}
double ErrorEstimate::line() const { return error_norm(pressures, 1, 0) / std::sqrt(pressure_square()); }
double ErrorEstimate::slopes() const {
  double square = 0;
  for (const PressureEstimate& e : pressures) {
    const VecX along = e.local.along();
    for (Eigen::Index i = 0; i < e.line.p.size(); ++i)
      if (e.counts(i)) square += along(i) * along(i);
  }
  return std::sqrt(square / pressure_square());
}
double ErrorEstimate::far_field() const { return error_norm(pressures, 0, 1) / std::sqrt(pressure_square()); }
VecX ErrorEstimate::overlaps() const { return far.overlaps.pairs / std::sqrt(pressure_square()); }

ErrorEstimate estimate_error(const Problem& p, const Solution& solution, EstimateMemory& memory,
                             const EstimateOptions& options) {
  const AccuracySpec& spec = options.spec;
  const Discretisation& d = p.discretisation;
  require_pair(spec, p.pairs.size());
  ErrorEstimate estimate;
  memory.keep_for(p);
  std::vector<ContactReach> reached;
  estimate.pressures = lines_with_windows(p, memory, solution, options, reached);
  const int beside_borders = add_end_windows(p.pairs, estimate.pressures);
  estimate.far.windows = share_duals(p.mesh, window_places(estimate.pressures), options.own_duals + beside_borders);
  const BorderOverlaps overlaps(p, solution, estimate.pressures, estimate.far.windows.own());
  add_narrow_contact(p, solution.u, estimate.pressures);
  add_missed_contact(p, solution.u, overlaps.motion(solution.u.size()), estimate.pressures);
  for (PressureEstimate& e : estimate.pressures) find_window_lengths(e);
  std::vector<JudgedLine> lines;
  for (PressureEstimate& e : estimate.pressures) lines.push_back({e.line, e.excluded, e.local});
  add_swings(p, solution.u, lines, memory.beside);
  GoalFunctionals goal;
  if (!p.pairs.empty())
    goal = goal_functionals(p.mesh, d, p.pairs[spec.pair], estimate.pressures[spec.pair].line, spec);
  require_stress(memory.around(p), estimate.pressures, goal, spec);
  if (estimate.far.windows.count + goal.rows.cols() + options.also.cols() > 0)
    estimate.tails.corners = corner_rings(p.mesh, memory.around(p).table,
                                          free_corners(memory.corners(p), p.mesh.nodes.rows(), p.pairs, reached));
  add_products(p, solution, goal, options, overlaps, memory, estimate);
  if (spec.of == Goal::mean) {
    const PressureEstimate& e = estimate.pressures[spec.pair];
    estimate.goal->local =
        mean_error(p.mesh, p.discretisation.model, p.pairs[spec.pair], e.line, e.local.pointwise(e.line), spec.window);
  }
  if (spec.of == Goal::displacement) add_displacement_error(p, goal, solution.u, *estimate.goal);
  if (spec.of == Goal::stress) add_stress_error(p, estimate.pressures, goal, solution.u, *estimate.goal);
  for_each_index(p.pairs.size(), solver_threads(), [&](std::size_t k) {
    memory.with_fits(k, [&](PressureFits& fits) { find_fitted_pressure(p, p.pairs[k], fits, estimate.pressures[k]); });
  });
  add_far_errors(p.mesh, estimate);
  return estimate;
}

}  // namespace mortise
