#include "error/coarser_forms.hpp"

#include <algorithm>
#include <cmath>

namespace mortise {
namespace {

using Eigen::Index;

constexpr std::size_t most_levels = 3;  // as many differences as two ratios take
constexpr Index least_edges = 4;        // that every other vertex may be taken of
constexpr int least_swing = 2;          // edges without knots: as at an end beside which p_h does not swing
constexpr double best_ratio = 1. / 16;  // cubics on edges twice as long miss 2^4 times as much of a smooth p

std::optional<PressureForm> fit_coarse(const LoadedPiece& piece, LoadedPiece coarse, Index stride) {
  std::array<double, 2> ends;
  for (const int which : {0, 1}) {
    ends[which] = piece.s(which * (piece.s.size() - 1));
    if (!piece.end[which].border) continue;
    const Index farthest = piece.loaded(which) + (which == 0 ? 2 : -2) * stride;
    if (farthest < 0 || farthest >= piece.s.size()) return std::nullopt;
    ends[which] = border_place(piece, which, stride);
  }
  // Over as much of the piece without knots, or less where so few vertices leave no cubic.
  coarse.swing.edges = std::max(int((piece.swing.edges + stride - 1) / stride), least_swing);
  for (; coarse.swing.edges >= least_swing; --coarse.swing.edges)
    if (auto form = fit_pressure(coarse, ends)) return form;
  return std::nullopt;
}

}  // namespace

std::vector<PressureForm> coarser_forms(const LoadedPiece& piece) {
  std::vector<PressureForm> forms;
  LoadedPiece coarse = piece;
  for (Index stride = 2; forms.size() < most_levels && coarse.s.size() > least_edges; stride *= 2) {
    coarse = every_other(coarse);
    const auto form = fit_coarse(piece, coarse, stride);
    if (!form) break;
    forms.push_back(*form);
  }
  return forms;
}

double part_left(const std::vector<double>& squares) {
  if (squares.size() < most_levels) return 1;
  const double last = squares[0] / squares[1], before = squares[1] / squares[2];
  const double ratio = std::sqrt(std::max({last, before, best_ratio * best_ratio}));
  // By what the last is larger than it would be, had it fallen as the one before, does not fall with the edges.
  const double stays = std::max(0.0, 1 - before / last);
  // From a ratio of 1/2 on a series is no less than its first term; of differences that are all 0 it is not known.
  return std::min(1.0, std::sqrt(std::pow(ratio / (1 - ratio), 2) + stays));
}

}  // namespace mortise
