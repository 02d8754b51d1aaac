#include "app/short_edges.hpp"

#include <algorithm>

#include "error/wanted_sizes.hpp"
#include "fem/edges.hpp"
#include "fem/motion_sets.hpp"
#include "solve/nonnegative_fit.hpp"

namespace mortise {
namespace {

constexpr double fit_tolerance = 1e-8;  // of the largest terms
// Of the scene's size: a load upon the very end of contact is not within fit_tolerance of an edge as long as that,
// though levers and terms be tens of one another.
constexpr double shortest = 100 * fit_tolerance;

// A place of a segment that may press, and what each motion opens there.
struct Presses {
  Vec2 place;
  double length;  // of the segment
  VecX opened;
};

VecX work_on(const Problem& p) {
  const auto& motions = p.floating.motions;
  VecX work = VecX::Zero(Eigen::Index(motions.size()));
  for (const MotionSet& set : motion_sets(p.mesh, motions))
    for (std::size_t k = 0; k < set.motions.size(); ++k)
      for (Eigen::Index i = 0; i < set.fields.rows(); ++i)
        work(set.motions[k]) += set.fields(i, Eigen::Index(k)) * p.discretisation.system.f(set.unknown(i));
  return work;
}

// What each motion opens of each row by its pressure, motions x rows.
MatX opened_rows(const Problem& p) {
  const auto& motions = p.floating.motions;
  const SaddlePointSystem& system = p.discretisation.system;
  MatX opened(Eigen::Index(motions.size()), system.B.rows());
  for (const MotionSet& set : motion_sets(p.mesh, motions))
    for (std::size_t k = 0; k < set.motions.size(); ++k) {
      VecX field = VecX::Zero(system.f.size());
      for (Eigen::Index i = 0; i < set.fields.rows(); ++i) field(set.unknown(i)) = set.fields(i, Eigen::Index(k));
      opened.row(set.motions[k]) = -(system.B * field).cwiseQuotient(system.row_scale).transpose();
    }
  return opened;
}

// At both ends of all segments, inwards by a part of the segment.
std::vector<Presses> ends_moved(const Problem& p, double inwards) {
  const auto& motions = p.floating.motions;
  std::vector<Presses> list;
  for (const ContactPair& pair : p.pairs)
    for (const Segment& segment : find_segments(p.mesh.nodes, pair))
      for (const auto& [from, to] : {std::pair{segment.begin, segment.end}, std::pair{segment.end, segment.begin}}) {
        const double xi = from + inwards * (to - from);
        const auto point = contact_point(p.mesh.nodes, pair, segment.edge, xi, segment.opposite_edge);
        if (!point) continue;
        const Edge& edge = pair.multiplier.edges[segment.edge];
        const Vec2 x = edge_point(p.mesh.nodes, edge, xi).position;
        const double part = (segment.end - segment.begin) / 2;
        Presses& at =
            list.emplace_back(x, part * edge_length(p.mesh.nodes, edge), VecX::Zero(Eigen::Index(motions.size())));
        for (std::size_t k = 0; k < motions.size(); ++k)
          for (const RigidMotion& part_of : motions[k])
            at.opened(Eigen::Index(k)) +=
                (int(part_of.body == pair.multiplier.body) - int(part_of.body == pair.opposite.body)) *
                point->normal.dot(part_of.at(x));
      }
  return list;
}

// Which of `ends` carry the work together with any rows; nothing where they do not. They come in where they
// lessen what those before leave, and where none does, that proves that none can (Farkas' lemma): so no ends are among
// them of bodies that rows hold.
std::optional<std::vector<std::size_t>> carriers(const VecX& work, const MatX& rows, const std::vector<Presses>& ends) {
  std::vector<std::size_t> taken;
  std::vector<char> is_taken(ends.size(), 0);
  for (;;) {
    MatX A(work.size(), rows.cols() + Eigen::Index(taken.size()));
    A.leftCols(rows.cols()) = rows;
    for (std::size_t i = 0; i < taken.size(); ++i) A.col(rows.cols() + Eigen::Index(i)) = ends[taken[i]].opened;
    const NonnegativeFit fit = fit_nonnegative(A, work, std::vector<char>(std::size_t(A.cols()), 0));
    const VecX terms = work.cwiseAbs() + A.cwiseAbs() * fit.x;
    if (largest_entry(fit.residual) <= fit_tolerance * largest_entry(terms)) {
      std::vector<std::size_t> used;
      for (std::size_t i = 0; i < taken.size(); ++i)
        if (fit.x(rows.cols() + Eigen::Index(i)) > 0) used.push_back(taken[i]);
      return used;
    }
    const std::size_t before = taken.size();
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if (is_taken[i] ||
          !(ends[i].opened.dot(fit.residual) > fit_tolerance * ends[i].opened.norm() * fit.residual.norm()))
        continue;
      is_taken[i] = 1;
      taken.push_back(i);
    }
    if (taken.size() == before) return std::nullopt;
  }
}

}  // namespace

std::vector<SizeLayers> edges_that_carry(const Problem& p) {
  if (std::ranges::any_of(p.pairs,
                          [](const ContactPair& pair) { return pair.spec.condition != Condition::unilateral; }))
    return {};
  const VecX work = work_on(p);
  const MatX rows = opened_rows(p);
  const std::vector<Presses> at_ends = ends_moved(p, 0);
  if (!carriers(work, rows, at_ends)) return {};
  const double scene = (p.mesh.nodes.colwise().maxCoeff() - p.mesh.nodes.colwise().minCoeff()).norm();
  double longest = 0;
  for (const Presses& at : at_ends) longest = std::max(longest, at.length);
  for (double inwards = 0.5; inwards * longest > shortest * scene; inwards /= 2) {
    const std::vector<Presses> ends = ends_moved(p, inwards);
    const auto used = carriers(work, rows, ends);
    if (!used) continue;
    std::vector<SizeLayers> wanted;
    for (const std::size_t i : *used) wanted.push_back({ends[i].place, inwards * ends[i].length, size_growth});
    return wanted;
  }
  return {};
}

}  // namespace mortise
