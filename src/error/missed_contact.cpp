#include "error/missed_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/dense.hpp"
#include "contact/least_gap.hpp"
#include "error/goal_estimate.hpp"
#include "error/narrow_contact.hpp"
#include "fem/edges.hpp"
#include "solve/nonnegative_fit.hpp"

namespace mortise {
namespace {

constexpr double round_off = 1e-9;  // of the largest displacement
constexpr int many_motions = 200;   // that fit_nonnegative is not made for: these bodies stay where they are
// What moving a body by a length costs over what an overlap of that length does, to choose one of many places: its
// square of the way is left of an overlap that the body could leave, which is less than gaps are known to.
constexpr double of_moving = 1e-5;

// The gap at the points of a pair that are away from contact, troughs among them, and what motions do to it.
struct OpenPoints {
  std::vector<ContactPoint> points;
  VecX curvature;  // of troughs; else 0
  VecX gaps;       // length
  MatX motions;    // points x motions
  double overlap() const { return gaps.size() > 0 ? std::max(0.0, -gaps.minCoeff()) : 0; }
};

using Motion = std::vector<RigidMotion>;

VecX openings_at(const Mesh& mesh, const ContactPair& pair, const ContactPoint& point,
                 const std::vector<Motion>& motions) {
  VecX openings(Eigen::Index(motions.size()));
  for (std::size_t j = 0; j < motions.size(); ++j)
    openings(Eigen::Index(j)) = opened(mesh.nodes, motions[j], pair, point);
  return openings;
}

// Motions x count: the combinations that leave every vertex with a pressure, and of pairs that cannot open all of them,
// as they are in the mean.
MatX left_free(const Problem& p, const std::vector<Motion>& motions, const std::vector<PressureEstimate>& list) {
  std::vector<VecX> held;
  for (std::size_t k = 0; k < p.pairs.size(); ++k) {
    const ContactPair& pair = p.pairs[k];
    MatX means = MatX::Zero(Eigen::Index(motions.size()), list[k].line.p.size());
    for (const ContactPoint& point : pair.points) {
      const VecX opened = point.ds * openings_at(p.mesh, pair, point, motions);
      means.col(point.edge) += (1 - point.xi) / 2 * opened;
      means.col(point.edge + 1) += (1 + point.xi) / 2 * opened;
    }
    for (Eigen::Index i = 0; i < means.cols(); ++i)
      if (list[k].line.p(i) != 0 || pair.spec.condition != Condition::unilateral)
        held.push_back(means.col(i) / list[k].line.h(i));
  }
  MatX rows = MatX::Zero(std::max<Eigen::Index>(Eigen::Index(held.size()), 1), Eigen::Index(motions.size()));
  for (std::size_t i = 0; i < held.size(); ++i) rows.row(Eigen::Index(i)) = held[i].transpose();
  return kernel_of(rows, 1e-8);  // what the errors of drawn curves make of a turn about the centre of a circle
}

// Gaps count as wide as they may be; where they are least, as in the one of both displaced states in which they are
// less: elsewhere a spin that hardly anything holds makes of a round body's gap what it would not be.
OpenPoints open_points(const Mesh& mesh, const ContactPair& pair, const PressureLine& line,
                       const std::array<VecX, 2>& states) {
  OpenPoints open;
  if (pair.spec.condition != Condition::unilateral) return open;
  std::vector<double> gaps, curvature;
  const auto add = [&](const ContactPoint& point, double gap, double bend) {
    if (line.loaded[point.edge] || line.loaded[point.edge + 1]) return;
    open.points.push_back(point);
    gaps.push_back(gap + point.unknown);
    curvature.push_back(bend);
  };
  for (const ContactPoint& point : pair.points) add(point, gap_at(states[0], pair, point), 0);
  for (const Trough& trough : troughs(mesh.nodes, states[0], pair))
    add(trough.point, std::min(gap_at(states[0], pair, trough.point), gap_at(states[1], pair, trough.point)),
        trough.curvature);
  open.gaps = Eigen::Map<VecX>(gaps.data(), Eigen::Index(gaps.size()));
  open.curvature = Eigen::Map<VecX>(curvature.data(), Eigen::Index(gaps.size()));
  return open;
}

struct Constraint {
  std::size_t pair;
  Eigen::Index point;
  bool operator==(const Constraint&) const = default;
};

// Of the motions by which the pairs overlap least, in the sum of squares of the most that each does, at these points
// alone: least distance programming (Lawson & Hanson 1974, chapter 23) for (of_moving times motions, overlaps).
VecX least_overlaps(const std::vector<OpenPoints>& pairs, const std::vector<Constraint>& constraints, double unit) {
  const Eigen::Index motions = pairs[constraints.front().pair].motions.cols(),
                     size = motions + Eigen::Index(pairs.size());
  MatX columns = MatX::Zero(size + 1, Eigen::Index(constraints.size()));
  for (std::size_t c = 0; c < constraints.size(); ++c) {
    const auto [k, point] = constraints[c];
    auto column = columns.col(Eigen::Index(c));
    column.head(motions) = pairs[k].motions.row(point).transpose() / of_moving;
    column(motions + Eigen::Index(k)) = 1;
    column(size) = -pairs[k].gaps(point) / unit;
  }
  const std::vector<char> free(constraints.size(), 0);
  const VecX left = fit_nonnegative(columns, VecX::Unit(size + 1, size), free).residual;
  if (!(left(size) > 0)) return VecX::Zero(size);
  VecX found = -left.head(size) / left(size) * unit;
  found.head(motions) /= of_moving;
  return found;
}

// The gaps once bodies that no pressure holds are moved apart, from the overlap `unit`. Constraints are those that
// earlier ones leave violated.
void move_apart(std::vector<OpenPoints>& pairs, double unit, double least) {
  const Eigen::Index motions = pairs[0].motions.cols();
  std::vector<Constraint> constraints;
  VecX by = VecX::Zero(motions + Eigen::Index(pairs.size()));
  for (;;) {
    const std::size_t before = constraints.size();
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (pairs[k].gaps.size() == 0 || pairs[k].motions.cwiseAbs().maxCoeff() < round_off) continue;
      Eigen::Index worst;
      const double gap = (pairs[k].gaps + pairs[k].motions * by.head(motions)).minCoeff(&worst);
      const Constraint constraint{k, worst};
      if (gap + by(motions + Eigen::Index(k)) < -least &&
          std::ranges::find(constraints, constraint) == constraints.end())
        constraints.push_back(constraint);
    }
    if (constraints.size() == before) break;
    by = least_overlaps(pairs, constraints, unit);
  }
  for (OpenPoints& open : pairs)
    if (open.gaps.size() > 0) open.gaps += open.motions * by.head(motions);
}

void add_overlaps(const Mesh& mesh, const ContactPair& pair, const OpenPoints& open, double modulus, double least,
                  PressureEstimate& estimate) {
  PressureLine& line = estimate.line;
  LineError& error = estimate.local;
  const Eigen::Index edges = line.p.size() - 1;
  VecX overlap = VecX::Zero(edges), width = VecX::Zero(edges), deepest = VecX::Zero(edges);  // its place on the edge
  for (Eigen::Index k = 0; k < open.gaps.size(); ++k) {
    if (open.gaps(k) >= -least) continue;
    const ContactPoint& point = open.points[k];
    const bool deeper = -open.gaps(k) > overlap(point.edge);
    if (deeper) deepest(point.edge) = point.xi;
    overlap(point.edge) = std::max(overlap(point.edge), -open.gaps(k));
    width(point.edge) += point.ds;
    if (point.ds > 0 || !deeper) continue;
    // A trough, which comes after the other points: as wide as its parabola, if that is less than the edge.
    const double length = edge_length(mesh.nodes, pair.multiplier.edges[point.edge]),
                 parabola = 2 * std::sqrt(-2 * open.gaps(k) / open.curvature(k));
    width(point.edge) = std::min(parabola, length);
  }
  if (overlap.sum() == 0) return;
  for (Eigen::Index e = 0; e < edges; ++e) {
    if (overlap(e) == 0) continue;
    const double a = width(e) / 2;
    double p0 = modulus * overlap(e) / a;
    if (pair.spec.stiffness) p0 = std::min(p0, pair.spec.stiffness->pressure(overlap(e)));
    if (!(p0 > loaded_part * largest_entry(line.p))) continue;  // as of a layer that hardly resists at first
    const double half = std::sqrt(2 * a / 3) * p0;
    error.missed_at.push_back(
        {edge_point(mesh.nodes, pair.multiplier.edges[e], deepest(e)).position, a / edges_of_contact});
    for (const Eigen::Index i : {e, e + 1}) {
      error.missed(i) = std::hypot(error.missed(i), half);
      error.raise(i, p0);
      line.loaded[i] = 1;
    }
  }
  if (line.closed && (line.loaded.front() || line.loaded.back())) line.loaded.front() = line.loaded.back() = 1;
}

}  // namespace

void add_missed_contact(const Problem& p, const VecX& u, const VecX& of_overlaps, std::vector<PressureEstimate>& list) {
  const std::array<VecX, 2> states = {u, u + of_overlaps};
  std::vector<OpenPoints> open;
  double overlap = 0;
  for (std::size_t k = 0; k < p.pairs.size(); ++k) {
    overlap = std::max(overlap, open.emplace_back(open_points(p.mesh, p.pairs[k], list[k].line, states)).overlap());
  }
  const double least = round_off * largest_entry(u);
  if (overlap <= least) return;
  const std::vector<Motion>& motions = p.floating.motions;
  if (!motions.empty() && int(motions.size()) <= many_motions) {
    const MatX free = left_free(p, motions, list);
    for (std::size_t k = 0; k < p.pairs.size(); ++k) {
      open[k].motions.resize(open[k].gaps.size(), free.cols());
      for (Eigen::Index i = 0; i < open[k].gaps.size(); ++i)
        open[k].motions.row(i) = openings_at(p.mesh, p.pairs[k], open[k].points[i], motions).transpose() * free;
    }
    if (free.cols() > 0) move_apart(open, overlap, least);
  }
  for (std::size_t k = 0; k < p.pairs.size(); ++k) {
    const std::vector<ElasticLaw>& laws = p.discretisation.laws;
    const double modulus = contact_modulus(laws[p.pairs[k].multiplier.body], laws[p.pairs[k].opposite.body]);
    add_overlaps(p.mesh, p.pairs[k], open[k], modulus, least, list[k]);
  }
}

}  // namespace mortise
