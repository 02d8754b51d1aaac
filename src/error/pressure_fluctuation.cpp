#include "error/pressure_fluctuation.hpp"

#include <algorithm>
#include <cmath>

#include "base/dense.hpp"
#include "error/pressure_windows.hpp"

namespace mortise {
namespace {

using Eigen::Index;

constexpr Index coefficients = 5;           // of a piece: three windows on it, and one at each of its ends
constexpr double least_fluctuation = 1e-6;  // of the largest p

// p on vertices first ... first + count - 1 less its polynomial.
VecX less_polynomial(const PressureLine& line, Index first, Index count) {
  const VecX root = line.h.segment(first, count).cwiseSqrt();
  const VecX t = line.s.segment(first, count).array() - (line.s(first) + line.s(first + count - 1)) / 2;
  MatX powers(count, coefficients);
  powers.col(0).setOnes();
  for (Index k = 1; k < coefficients; ++k) powers.col(k) = powers.col(k - 1).cwiseProduct(t / largest_entry(t));
  const MatX Q = orthonormal(root.asDiagonal() * powers);
  const VecX p = root.cwiseProduct(line.p.segment(first, count));
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
  for (Index start = 0; start < count; ++start) {
    if (!counts(start)) continue;
    Index end = start;
    while (end < count && counts(end)) ++end;
    if (end - start > coefficients) found.p.segment(start, end - start) = less_polynomial(line, start, end - start);
    start = end;
  }
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
  const Index period = line.closed ? count - 1 : count;
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
