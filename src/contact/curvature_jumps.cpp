#include "contact/curvature_jumps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "base/vectors.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

// A jump that would turn the normals of the whole curve by less: p feels it by its product with the sliding, which is
// a small part of the length again.
constexpr double least_turn = 0.01;

// What round-off of the samples' coordinates makes of the curvature at the end of a piece of length h, times eps x /
// h^2 with x the largest of them: up to 2100 of random arcs, and places that gmsh computes are off by several eps.
constexpr double round_off_of_curvatures = 1e4;

// The same times m / h^2 with m the misfit of the edges beside (as of directions, singular_points.cpp): of a polynomial
// of degree n second derivatives are off by n^2 (n^2 - 1) / 3 r / (h / 2)^2 or less, on both sides.
constexpr double misfit_of_curvatures = 2 * 2 * 5376;

// A polynomial piece of the line, and how far off round-off may have its curvature.
struct MeasuredPiece {
  int edge;
  double begin;  // coordinate of the edge
  LinePoint first, last;
  double length, off;
};

std::vector<MeasuredPiece> pieces_of(const Curve& curve, const ContactLine& line) {
  std::vector<MeasuredPiece> all;
  for (int e = 0; e < int(curve.edges.size()); ++e)
    for (const LinePiece& piece : line.pieces(e)) {
      const LinePoint first = place_on(piece, piece.begin), last = place_on(piece, piece.end);
      const double length = (piece.end - piece.begin) * std::min(first.tangent.norm(), last.tangent.norm());
      const double off =
          round_off_of_curvatures * std::numeric_limits<double>::epsilon() * first.position.lpNorm<Eigen::Infinity>() +
          misfit_of_curvatures * curve.samples[e].misfit;
      all.push_back({e, piece.begin, first, last, length, off / (length * length)});
    }
  return all;
}

// Where pieces meet, k that after the place. Next to it they may be too short for their curvatures: then those `away`
// pieces away on both sides tell of the jump, and their tangents where between them it is, as the line turns by
// kappa_- s up to it and by kappa_+ (L - s) behind.
class Joints {
 public:
  Joints(const std::vector<MeasuredPiece>& pieces, bool closed, double least)
      : pieces_(pieces), closed_(closed), least_(least) {}

  struct Found {
    double jump;
    double miss = 0;  // of the joint from where the tangents have the place, length
    int away = 0;
  };
  std::optional<Found> jump_at(int k) const {
    for (int away = 0;; away = 2 * away + 1) {
      const auto before = piece(k - 1 - away), after = piece(k + away);
      if (!before || !after || !is_smooth(k - away, k + away)) return std::nullopt;
      const double from = before->last.curvature(), to = after->first.curvature(), jump = std::abs(to - from),
                   off = std::max(before->off, after->off);
      if (jump > std::max(least_, off))
        return away == 0 ? std::optional(Found{to - from}) : from_afar(k, away, from, to, off / jump);
      if (off <= least_) return std::nullopt;
    }
  }

 private:
  const MeasuredPiece* piece(int k) const {
    const int count = int(pieces_.size());
    if (closed_) return std::abs(k) < count ? &pieces_[(k + count) % count] : nullptr;
    return k < 0 || k >= count ? nullptr : &pieces_[k];
  }

  bool is_smooth(int from, int to) const {
    for (int k = from; k <= to; ++k)
      if (!(angle_between(piece(k - 1)->last.tangent, piece(k)->first.tangent) < sharpest_joint)) return false;
    return true;
  }

  // Nothing where the next joint is nearer to the place, or the curvature varies as much on one side alone. `off`: what
  // round-off may be of the jump.
  std::optional<Found> from_afar(int k, int away, double from, double to, double off) const {
    double length_before = 0, length = 0;
    for (int i = k - away; i < k + away; ++i) {
      length += piece(i)->length;
      if (i < k) length_before += piece(i)->length;
    }
    const MeasuredPiece &before = *piece(k - 1 - away), &after = *piece(k + away);
    const double turn = std::remainder(std::atan2(after.first.tangent.y(), after.first.tangent.x()) -
                                           std::atan2(before.last.tangent.y(), before.last.tangent.x()),
                                       2 * std::numbers::pi);
    const double miss = (to * length - turn) / (to - from) - length_before,
                 known = off * std::max(before.length, after.length), jump = std::abs(to - from);
    if (-miss > piece(k - 1)->length / 2 + known || miss > piece(k)->length / 2 + known) return std::nullopt;
    constexpr double far_less = 0.25;  // a curvature that varies evenly does so by half on one side
    const double varies = std::max(std::abs(from - before.first.curvature()), std::abs(to - after.last.curvature()));
    return varies < far_less * jump ? std::optional(Found{to - from, std::abs(miss), away}) : std::nullopt;
  }

  const std::vector<MeasuredPiece>& pieces_;
  bool closed_;
  double least_;
};

}  // namespace

std::vector<CurvatureJump> curvature_jumps(const Points& nodes, const Curve& curve, const ContactLine& line) {
  std::vector<CurvatureJump> jumps;
  if (curve.samples.empty()) return jumps;
  const std::vector<MeasuredPiece> pieces = pieces_of(curve, line);
  const Joints joints(pieces, curve.closed, least_turn / curve_length(nodes, curve));
  Joints::Found last;
  int at = -1;
  for (int k = curve.closed ? 0 : 1; k < int(pieces.size()); ++k) {
    const auto found = joints.jump_at(k);
    if (!found) continue;
    if (at >= 0 && k - at <= std::max(found->away, last.away)) {  // the same one, seen from afar
      if (found->miss >= last.miss) continue;
      jumps.pop_back();
    }
    jumps.push_back({pieces[k].edge, pieces[k].begin, found->jump});
    last = *found;
    at = k;
  }
  return jumps;
}

}  // namespace mortise
