#include "error/wanted_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fem/edges.hpp"

namespace mortise {
namespace {

constexpr double side_of_area = 1.5;         // side of a triangle over the root of its area
constexpr double coarsen = 0.4, refine = 6;  // by what sizes may fall at once where the error is smooth
// By what edges may shorten at once. Where contact ends is known to an edge, of those that it is refined to, all but
// one are for nothing.
constexpr double line_refine = 8;
constexpr double least_at_border = 0.7;  // likewise at a border, where they hardly grow: it may move on to any of them
constexpr double corner_share = 0.2;     // of the target of the far field, for all corners of the bodies
constexpr double most_missed = 0.1;      // of p in L2: a mesh whose error is larger is not aimed at
constexpr double border_share = 0.5;     // of the target of the local error, for all borders
// Likewise for all loads beside the line, and for all points where p goes as a small power of the distance: rings of
// edges around a point are few, however short these are, so that they cost next to nothing.
constexpr double weak_share = 0.3;
// Of the scene's size: an edge of which round-off of its ends' coordinates is a millionth.
constexpr double least_size = 1e-9;
constexpr double least_layer = 3e-5;  // likewise; corners have no less to tell from there on

// Window by window the squares of what duals say of a place, as one number: stress length^(1/2).
class WindowNorm {
 public:
  explicit WindowNorm(const ErrorEstimate& estimate) : windows_(estimate.far.windows) {
    for (const PressureEstimate& e : estimate.pressures)
      for (const PressureWindow& window : e.windows) lengths_.push_back(window.length);
    for (const PressureEstimate& e : estimate.pressures)
      if (e.fluctuation) of_fluctuations_.push_back(e.fluctuation->length);
  }
  double operator()(int body, const Vec2& x, const Eigen::Ref<const Eigen::RowVectorXd>& parts) const {
    double sum = 0;
    for (int d = 0; d < windows_.count; ++d)
      windows_.for_each_window(body, d, x, [&](int window, double share) {
        sum += lengths_[window] * (share * parts(d) * (share * parts(d)));
      });
    for (std::size_t k = 0; k < of_fluctuations_.size(); ++k)
      sum += of_fluctuations_[k] * std::pow(parts(windows_.count + Eigen::Index(k)), 2);
    return std::sqrt(sum);
  }

 private:
  const SharedDuals& windows_;
  std::vector<double> lengths_, of_fluctuations_;
};

// Of each cell what it does to what is asked for, and of each corner.
VecX cell_parts(const Mesh& mesh, const ErrorEstimate& estimate) {
  if (estimate.goal) return estimate.goal->parts.rowwise().norm();
  const WindowNorm norm(estimate);
  VecX part(Eigen::Index(mesh.cells.size()));
  for (Eigen::Index e = 0; e < part.size(); ++e)
    part(e) = norm(mesh.cells[e].body, centre_of(mesh.nodes, mesh.cells[e]), estimate.far.parts.row(e));
  return part;
}

VecX corner_parts(const ErrorEstimate& estimate) {
  return estimate.goal ? VecX(estimate.tails.goal.rowwise().norm()) : estimate.tails.norms;
}

double side_of(const ErrorEstimate& estimate, int cell) {
  return side_of_area * std::sqrt(estimate.energy.areas(cell));
}

// By what the size of each cell is to fall, for the far field.
VecX cell_refinement(const Mesh& mesh, const ErrorEstimate& estimate, double factor) {
  const VecX part = cell_parts(mesh, estimate);
  const double corners = corner_parts(estimate).sum();
  const double target = (part.sum() + corners) / factor;
  VecX r = VecX::Constant(part.size(), coarsen);
  if (!(target > 0)) return r;
  const double all = std::pow(part.array().pow(1.0 / 3).sum() / target, 0.25);
  return (all * part.array().pow(1.0 / 6)).max(coarsen).min(refine);
}

// Layers towards the bodies' corners where these would do more than they may, all together: what the sizes without
// layers leave of them, h^(2 lambda), and the same largest part of all that have layers, as rings of cells cost the
// same at all of them. `allowed`: the sum, as of corner_parts.
void add_corner_layers(const ErrorEstimate& estimate, const VecX& sizes, double allowed, double least,
                       std::vector<SizeLayers>& layers) {
  const VecX parts = corner_parts(estimate);
  VecX size = parts, without = parts;  // of the first ring's cells; the part without layers
  for (Eigen::Index c = 0; c < parts.size(); ++c) {
    const CornerRings& rings = estimate.tails.corners[c];
    double logs = 0;
    for (const int e : rings.cells[0]) logs += std::log(side_of(estimate, e));
    size(c) = std::exp(logs / double(rings.cells[0].size()));
    without(c) *= std::pow(sizes(rings.corner.node) / size(c), 2 * rings.corner.exponent);
  }
  std::vector<double> rising(without.begin(), without.end());
  std::ranges::sort(rising);
  double level = std::numeric_limits<double>::infinity(), left = allowed;
  for (std::size_t i = 0; i < rising.size(); left -= rising[i++])
    if (rising[i] * double(rising.size() - i) > left) {
      level = left / double(rising.size() - i);
      break;
    }
  for (Eigen::Index c = 0; c < parts.size(); ++c) {
    const BodyCorner& corner = estimate.tails.corners[c].corner;
    if (!(without(c) > level)) continue;
    const double h = size(c) * std::pow(level / parts(c), 1 / (2 * corner.exponent));
    layers.push_back({corner.position, std::max(h, least), size_growth});
  }
}

// By what edges of a pair are to shorten: those at each vertex, and those at each border whose place is known; these
// are few, as sizes grow from there on, and shorten by as much as is asked.
struct Shorter {
  explicit Shorter(const PressureEstimate& e)
      : vertices(VecX::Constant(e.line.p.size(), coarsen)), borders(VecX::Zero(Eigen::Index(e.local.borders.size()))) {}
  void at_least(const Shorter& other) {
    vertices = vertices.cwiseMax(other.vertices);
    borders = borders.cwiseMax(other.borders);
  }
  VecX vertices, borders;
};

double edge_of(const PressureLine& line, const LineError::Border& border) {
  return line.s(border.edge + 1) - line.s(border.edge);
}

// `least`: the shortest edges that are made at a corner.
Shorter line_refinement(const PressureEstimate& e, double target, double borders, double border, double weak,
                        double least) {
  VecX l2 = e.local.along();
  for (const LineError::Weak& of : e.local.weak) l2(of.vertex) = std::max(l2(of.vertex) - of.part, 0.);
  for (const LineError::Load& of : e.local.loads) l2(of.vertex) = std::max(l2(of.vertex) - of.part, 0.);
  Shorter shorter(e);
  VecX& r = shorter.vertices;
  if (!(target > 0)) return shorter;
  double sum = 0;
  for (Eigen::Index i = 0; i < l2.size(); ++i)
    if (!e.excluded[i]) sum += std::pow(l2(i), 0.4);
  const double all = std::pow(sum / (target * target), 0.25);
  const auto at_border = [&](Eigen::Index i) {
    return border > 0 ? border : std::max(l2(i) / (border_share * target / std::sqrt(borders)), least_at_border);
  };
  for (Eigen::Index i = 0; i < l2.size(); ++i)
    if (!e.excluded[i] && e.line.loaded[i])
      r(i) = e.local.border[i] ? std::min(at_border(i), line_refine)
                               : std::clamp(all * std::pow(l2(i), 0.4), coarsen, line_refine);
  for (std::size_t b = 0; b < e.local.borders.size(); ++b) {
    const LineError::Border& known = e.local.borders[b];
    if (!known.place) continue;
    for (const Eigen::Index i : vertices_at(e.line, known)) {
      if (!e.local.border[i] || !e.line.loaded[i]) continue;
      r(i) = std::clamp(all * std::pow(l2(i), 0.4), coarsen, line_refine);
      double& most = shorter.borders(Eigen::Index(b));
      most = std::max(most, at_border(i) * edge_of(e.line, known) / e.line.h(i));
    }
  }
  for (const LineError::Weak& of : e.local.weak)
    r(of.vertex) =
        std::max(r(of.vertex), std::min(std::pow(of.part / (weak_share * target / std::sqrt(weak)), 1 / of.power),
                                        of.at_end ? e.line.h(of.vertex) / least : line_refine));
  return shorter;
}

// What the parts of the goal's lines that fall as h^power may add up to, and the sum of their roots with which the
// fewest edges bring them there.
struct GoalLines {
  double target = 0, roots = 0;
};

VecX goal_parts(const MatX& part) { return part.rowwise().norm(); }

GoalLines goal_lines(const GoalEstimate& goal, double factor) {
  GoalLines lines;
  for (const LinePart& part : goal.lines) {
    lines.target += (goal_parts(part.vertices).sum() + goal_parts(part.borders).sum()) / (2 * factor);
    lines.roots +=
        goal_parts(part.vertices).array().pow(1.0 / 6).sum() + goal_parts(part.borders).array().pow(1.0 / 3).sum();
  }
  return lines;
}

// At the borders of a pair by parts that fall as the square of their edges; `between`: the sum of all parts' cube roots
// over what these may add up to.
void shorten_at_borders(const PressureEstimate& e, const VecX& parts, double between, Shorter& shorter) {
  for (std::size_t b = 0; b < e.local.borders.size(); ++b) {
    const LineError::Border& border = e.local.borders[b];
    const double asked = std::max(std::sqrt(between) * std::cbrt(parts(Eigen::Index(b))), least_at_border);
    if (border.place)
      shorter.borders(Eigen::Index(b)) = std::max(shorter.borders(Eigen::Index(b)), asked);
    else
      for (const Eigen::Index i : vertices_at(e.line, border))
        shorter.vertices(i) = std::max(shorter.vertices(i), std::min(asked, line_refine));
  }
}

// As line_refinement, by what the vertices and borders of a pair do to the goal.
Shorter goal_line_refinement(const PressureEstimate& e, const LinePart& part, const GoalLines& lines) {
  Shorter shorter(e);
  VecX& r = shorter.vertices;
  if (!(lines.target > 0)) return shorter;
  const double between = lines.roots / lines.target;
  const VecX vertices = goal_parts(part.vertices);
  for (Eigen::Index i = 0; i < r.size(); ++i)
    r(i) = std::clamp(std::pow(between, 0.2) * std::pow(vertices(i), 1.0 / 6), coarsen, line_refine);
  shorten_at_borders(e, goal_parts(part.borders), between, shorter);
  return shorter;
}

// Of each pair what the overlaps at each of its borders do to p elsewhere, as ErrorEstimate::overlaps.
std::vector<VecX> overlap_parts(const ErrorEstimate& estimate) {
  const VecX of_pairs = estimate.overlaps();
  std::vector<VecX> parts;
  for (std::size_t k = 0; k < estimate.pressures.size(); ++k) {
    const Eigen::Index count = Eigen::Index(estimate.pressures[k].local.borders.size());
    parts.push_back(VecX::Constant(count, of_pairs(Eigen::Index(k)) / double(std::max<Eigen::Index>(count, 1))));
  }
  return parts;
}

// At each node the geometric mean of what its cells' sizes become; infinite where it is a corner of none.
VecX node_sizes(const Mesh& mesh, const ErrorEstimate& estimate, const VecX& refinement) {
  VecX logs = VecX::Zero(mesh.nodes.rows()), cells_at = logs;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const double size = side_of(estimate, int(e)) / refinement(e);
    for (int a = 0; a < corner_count(mesh.cells[e].kind); ++a) {
      logs(mesh.cells[e].nodes[a]) += std::log(size);
      cells_at(mesh.cells[e].nodes[a]) += 1;
    }
  }
  VecX sizes = VecX::Constant(logs.size(), std::numeric_limits<double>::infinity());
  for (Eigen::Index i = 0; i < sizes.size(); ++i)
    if (cells_at(i) > 0) sizes(i) = std::exp(logs(i) / cells_at(i));
  return sizes;
}

// Of the line's own error, stress length^(1/2).
double line_target(const ErrorEstimate& estimate, const ErrorFactors& factors) {
  return estimate.slopes() * std::sqrt(estimate.pressure_square()) / factors.line;
}

// Where loads stand that their cells do not follow: as far from the line as these are, its own edges do nothing for it.
void add_load_layers(const ErrorEstimate& estimate, double target, double least, std::vector<SizeLayers>& layers) {
  double count = 0;
  for (const PressureEstimate& e : estimate.pressures) count += double(e.local.loads.size());
  const double each = weak_share * target / std::sqrt(count);
  for (const PressureEstimate& e : estimate.pressures)
    for (const LineError::Load& of : e.local.loads)
      if (e.counts(of.vertex) && of.part > each)
        layers.push_back({of.place, std::max(of.cell * std::pow(each / of.part, 1.0 / of.power), least), size_growth});
}

// At contact that is narrower than its edges; but where p is asked for, to `target`, not at that which may be missed
// altogether: its pressures add up to less than half of what is left to all.
void add_narrow_layers(const ErrorEstimate& estimate, double target, double least, std::vector<SizeLayers>& layers) {
  std::vector<LineError::Narrow> all;
  for (const PressureEstimate& e : estimate.pressures)
    all.insert(all.end(), e.local.narrow_at.begin(), e.local.narrow_at.end());
  std::ranges::sort(all, {}, &LineError::Narrow::square);
  double square = estimate.pressure_square();
  for (const LineError::Narrow& narrow : all) square += narrow.square;
  double left = estimate.goal ? 0 : square * std::pow(std::min(target, most_missed) / 2, 2);
  for (const LineError::Narrow& narrow : all)
    if ((left -= narrow.square) < 0) layers.push_back({narrow.place, std::max(narrow.edge, least), size_growth});
}

// Of each pair, for p and for the goal.
std::vector<Shorter> lines_refinement(const ErrorEstimate& estimate, const ErrorFactors& factors, double least) {
  double borders = 0, weak = 0;
  for (const PressureEstimate& e : estimate.pressures) {
    weak += double(e.local.weak.size());
    borders += double(std::ranges::count(e.local.border, 1));
  }
  const double target = line_target(estimate, factors);
  const GoalLines lines = estimate.goal ? goal_lines(*estimate.goal, factors.goal_line) : GoalLines{};
  const std::vector<VecX> overlaps = overlap_parts(estimate);
  double roots = 0, sum = 0;
  for (const VecX& parts : overlaps) {
    roots += parts.array().pow(1.0 / 3).sum();
    sum += parts.sum();
  }
  std::vector<Shorter> all;
  for (std::size_t k = 0; k < estimate.pressures.size(); ++k) {
    const PressureEstimate& e = estimate.pressures[k];
    Shorter& shorter = all.emplace_back(e);
    if (!estimate.goal || estimate.goal->local > 0)
      shorter = line_refinement(e, target, borders, factors.border, weak, least);
    if (!estimate.goal && sum > 0) shorten_at_borders(e, overlaps[k], roots * factors.overlaps / sum, shorter);
    if (estimate.goal) shorter.at_least(goal_line_refinement(e, estimate.goal->lines[k], lines));
  }
  return all;
}

// The sizes at the nodes of both sides of a pair. `along`: of the edges at each vertex of its line.
void lower_sizes(const Mesh& mesh, const ContactPair& pair, const PressureEstimate& e, const VecX& along,
                 WantedSizes& wanted) {
  const auto lower = [&](int node, const Vec2& from, double size) {
    const double distance = (mesh.nodes.row(node).transpose() - from).norm();
    wanted.sizes(node) = std::min(wanted.sizes(node), size + size_growth * distance);
  };
  const std::vector<Edge>&edges = pair.multiplier.edges, &opposite = pair.opposite.edges;
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (const int end : {0, 1})
      if (e.line.loaded[i + end]) lower(edges[i].nodes[end], e.line.position[i + end], along(Eigen::Index(i) + end));
  // The opposite side where it faces these: its vertices, and at the border, where its edges are too long for the
  // sizes that are wanted, the places themselves.
  int last_edge = -1;
  for (const ContactPoint& point : pair.points) {
    if (!e.line.loaded[point.edge] || !e.line.loaded[point.edge + 1]) continue;
    const Edge& other = opposite[point.opposite_edge];
    const Vec2 place = edge_point(mesh.nodes, other, point.eta).position;
    const double end = (1 + point.xi) / 2, size = (1 - end) * along(point.edge) + end * along(point.edge + 1);
    for (const int a : {0, 1}) lower(other.nodes[a], place, size);
    if (point.edge != last_edge && e.local.border[point.edge] && e.local.border[point.edge + 1])
      wanted.layers.push_back({place, size, size_growth});
    last_edge = point.edge;
  }
}

}  // namespace

WantedSizes wanted_sizes(const Mesh& mesh, const std::vector<ContactPair>& pairs, const ErrorEstimate& estimate,
                         const ErrorFactors& factors) {
  WantedSizes wanted;
  wanted.sizes = node_sizes(mesh, estimate, cell_refinement(mesh, estimate, factors.far_field));
  const double far_parts = cell_parts(mesh, estimate).sum() + corner_parts(estimate).sum();
  const double scene = (mesh.nodes.colwise().maxCoeff() - mesh.nodes.colwise().minCoeff()).norm();
  add_corner_layers(estimate, wanted.sizes, corner_share * far_parts / factors.far_field, least_layer * scene,
                    wanted.layers);
  add_load_layers(estimate, line_target(estimate, factors), least_size * scene, wanted.layers);
  add_narrow_layers(estimate, factors.target, least_size * scene, wanted.layers);
  const std::vector<Shorter> shorter = lines_refinement(estimate, factors, least_layer * scene);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const PressureEstimate& e = estimate.pressures[k];
    const VecX along = e.line.h.cwiseQuotient(shorter[k].vertices);
    lower_sizes(mesh, pairs[k], e, along.cwiseMax(least_size * scene), wanted);
    for (std::size_t b = 0; b < e.local.borders.size(); ++b) {
      const LineError::Border& border = e.local.borders[b];
      if (const double by = shorter[k].borders(Eigen::Index(b)); by > 0)
        wanted.layers.push_back(
            {e.line.at(*border.place), std::max(edge_of(e.line, border) / by, least_size * scene), size_growth});
    }
    for (const LineError::Narrow& missed : e.local.missed_at)
      wanted.layers.push_back({missed.place, std::max(missed.edge, least_size * scene), size_growth});
    const double scale = e.line.h.sum() / 2;
    for (const SingularPoint& point : e.singular) {
      const double least = scale * std::pow(0.3 * factors.target, 1 / (2 * point.exponent));
      for (const Vec2& place : {point.position, e.line.foot(point.position)})
        wanted.layers.push_back({place, std::max(least, least_layer * scene), size_growth});
    }
  }
  limit_growth(mesh, size_growth, wanted.sizes);
  wanted.sizes = wanted.sizes.cwiseMax(least_size * scene);
  return wanted;
}

}  // namespace mortise
