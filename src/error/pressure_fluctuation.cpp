#include "error/pressure_fluctuation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/dense.hpp"
#include "error/pressure_windows.hpp"

namespace mortise {
namespace {

using Eigen::Index;

constexpr Index coefficients = 5;           // of a piece: three windows on it, and one at each of its ends
constexpr double least_fluctuation = 1e-6;  // of the largest p

// Vertices one after another that count, along the whole line or around it.
struct Piece {
  std::vector<Index> vertices;
  bool around = false;  // all of a closed line
};

// The vertices of a line; of a closed one its last is its first.
Index vertex_count(const PressureLine& line) { return line.closed ? line.p.size() - 1 : line.p.size(); }

template <typename Counts>
std::vector<Piece> pieces_of(const PressureLine& line, Counts counts) {
  const Index count = vertex_count(line);
  Index start = 0;  // of a closed line one that does not count, if there is any
  while (line.closed && start < count && counts(start)) ++start;
  std::vector<Piece> pieces(1);
  pieces[0].around = line.closed && start == count;
  for (Index k = 0; k < count; ++k)
    if (const Index i = (start + k) % count; counts(i))
      pieces.back().vertices.push_back(i);
    else if (!pieces.back().vertices.empty())
      pieces.emplace_back();
  return pieces;
}

// Five columns: powers of s, or around a closed line waves, which have no first vertex either.
MatX low_waves(const PressureLine& line, const Piece& piece) {
  const std::vector<Index>& v = piece.vertices;
  const double length = line.s(line.s.size() - 1);
  MatX columns(Index(v.size()), coefficients);
  columns.col(0).setOnes();
  VecX t(Index(v.size()));
  for (std::size_t k = 0; k < v.size(); ++k) t(Index(k)) = line.s(v[k]) + (v[k] < v[0] ? length : 0);
  if (piece.around) {
    for (Index k = 1; k < coefficients; k += 2) {
      const Eigen::ArrayXd angle = 2 * EIGEN_PI * double((k + 1) / 2) / length * t.array();
      columns.col(k) = angle.cos();
      columns.col(k + 1) = angle.sin();
    }
    return columns;
  }
  t.array() -= (t(0) + t(t.size() - 1)) / 2;
  for (Index k = 1; k < coefficients; ++k) columns.col(k) = columns.col(k - 1).cwiseProduct(t / largest_entry(t));
  return columns;
}

// p at the piece's vertices less what five coefficients make of it.
VecX less_low_waves(const PressureLine& line, const Piece& piece) {
  const VecX root = line.h(piece.vertices).cwiseSqrt(), p = root.cwiseProduct(VecX(line.p(piece.vertices)));
  const MatX Q = orthonormal(root.asDiagonal() * low_waves(line, piece));
  return (p - Q * (Q.transpose() * p)).cwiseQuotient(root);
}

}  // namespace

std::optional<PressureFluctuation> pressure_fluctuation(const ContactPair& pair, const PressureLine& line,
                                                        const std::vector<char>& excluded, double distance) {
  const Index count = line.p.size();
  const auto counts = [&](Index i) { return line.loaded[i] && line.p(i) != 0 && !excluded[i]; };
  PressureFluctuation found{.p = VecX::Zero(count),
                            .amplitude = VecX::Zero(count),
                            .weights = VecX::Zero(pair.coupling.B.rows()),
                            .rms = 0,
                            .length = 0};
  for (const Piece& piece : pieces_of(line, counts))
    if (Index(piece.vertices.size()) > coefficients) found.p(piece.vertices) = less_low_waves(line, piece);
  if (line.closed) found.p(count - 1) = found.p(0);
  if (!(largest_entry(found.p) > least_fluctuation * largest_entry(line.p))) return {};
  double area = 0;
  for (const ContactPoint& point : pair.points) {
    const Index e = point.edge;
    if (!line.loaded[e] || !line.loaded[e + 1]) continue;
    const double p = (found.p(e) * (1 - point.xi) + found.p(e + 1) * (1 + point.xi)) / 2;
    area += point.dA;
    found.length += point.ds;
    found.rms += p * p * point.dA;
    add_pressure_at(pair, point.edge, point.xi, p * point.dA, found.weights);
  }
  if (!(found.rms > 0)) return {};
  found.rms = std::sqrt(found.rms / area);
  found.weights /= found.rms * area;
  const Index period = vertex_count(line);
  for (Index i = 0; i < count; ++i)
    for (const Index step : {-1, 1})
      for (Index left = period, k = i; line.loaded[i] && left > 0; --left, k += step) {
        if (line.closed) k = (k + period) % period;
        if (k < 0 || k >= count || line.distance(line.s(i), line.s(k)) > distance / 2) break;
        found.amplitude(i) = std::max(found.amplitude(i), std::abs(found.p(k)));
      }
  return found;
}

}  // namespace mortise
