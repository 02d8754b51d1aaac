#include "error/pressure_swing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/dense.hpp"

namespace mortise {
namespace {

constexpr Eigen::Index beside = swing_reach;
constexpr Eigen::Index cubic = 4;  // coefficients

// p(i) less the cubic that fits nodes first ... first + count - 1, over the root of 1 - q, with q the part of p(i)
// itself in the cubic there: by that root a fit comes nearer to what it was made with, at the end of a line more than
// within.
double swing(const PressureNodes& nodes, Eigen::Index i, Eigen::Index first, Eigen::Index count) {
  const VecX t = nodes.s.segment(first, count).array() - nodes.s(i);
  const double scale = largest_entry(t);
  MatX powers(count, cubic);
  powers.col(0).setOnes();
  for (Eigen::Index k = 1; k < cubic; ++k) powers.col(k) = powers.col(k - 1).cwiseProduct(t / scale);
  const MatX Q = orthonormal(powers);
  const Eigen::RowVectorXd own = Q.row(i - first);
  const VecX at = nodes.p.segment(first, count).array() - nodes.p(i);
  return -own.dot(Q.transpose() * at) / std::sqrt(1 - own.squaredNorm());
}

}  // namespace

PressureNodes pressure_nodes(const PressureLine& line, const std::vector<char>& excluded) {
  const Eigen::Index edges = line.p.size() - 1;
  PressureNodes nodes{.step = line.middle.size() > 0 ? 2 : 1, .s = {}, .p = {}, .smooth = {}, .closed = line.closed};
  const Eigen::Index count = nodes.step * edges + 1;
  nodes.s.resize(count);
  nodes.p.resize(count);
  nodes.smooth.assign(count, 0);
  for (Eigen::Index i = 0; i <= edges; ++i) {
    const Eigen::Index at = nodes.step * i;
    nodes.s(at) = line.s(i);
    nodes.p(at) = line.p(i);
    nodes.smooth[at] = line.loaded[i] && line.p(i) != 0 && !excluded[i];
    if (i == edges || nodes.step == 1) continue;
    nodes.s(at + 1) = (line.s(i) + line.s(i + 1)) / 2;
    nodes.p(at + 1) = line.middle(i);
    nodes.smooth[at + 1] = line.faced[i] && line.middle(i) != 0 && line.loaded[i] && line.loaded[i + 1] &&
                           !excluded[i] && !excluded[i + 1];
  }
  return nodes;
}

namespace {

// Of closed ones so many nodes more at both ends as a fit reaches, so that the first is one like the others.
constexpr Eigen::Index beyond = 2 * beside;

PressureNodes extended(const PressureNodes& nodes) {
  const Eigen::Index period = nodes.s.size() - 1, count = period + 1 + 2 * beyond;
  PressureNodes more{.step = nodes.step, .s = VecX(count), .p = VecX(count), .smooth = std::vector<char>(count)};
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Index turns = (k + period - beyond) / period - 1, i = k - beyond - turns * period;
    more.s(k) = nodes.s(i) + double(turns) * (nodes.s(period) - nodes.s(0));
    more.p(k) = nodes.p(i);
    more.smooth[k] = nodes.smooth[i];
  }
  return more;
}

}  // namespace

VecX swings(const PressureNodes& nodes) {
  const Eigen::Index count = nodes.s.size();
  if (nodes.closed && count > beyond) return swings(extended(nodes)).segment(beyond, count);
  VecX found = VecX::Zero(count);
  for (Eigen::Index start = 0; start < count; ++start) {
    if (!nodes.smooth[start]) continue;
    Eigen::Index end = start;
    while (end < count && nodes.smooth[end]) ++end;
    const Eigen::Index fitted = std::min(2 * beside + 1, end - start);
    for (Eigen::Index i = start; fitted > cubic && i < end; ++i)
      found(i) = swing(nodes, i, std::clamp(i - beside, start, end - fitted), fitted);
    start = end;
  }
  return found;
}

VecX means_at_vertices(const PressureNodes& nodes, const VecX& figures) {
  const Eigen::Index count = nodes.s.size();
  VecX means = VecX::Constant((count - 1) / nodes.step + 1, std::numeric_limits<double>::infinity());
  for (Eigen::Index v = 0; v < means.size(); ++v) {
    double squares = 0;
    int taken = 0;
    for (Eigen::Index near = nodes.step * v - beside; near <= nodes.step * v + beside; ++near) {
      const Eigen::Index i = nodes.closed ? (near + count - 1) % (count - 1) : near;
      if (i < 0 || i >= count || !nodes.smooth[i] || std::isnan(figures(i))) continue;
      squares += figures(i) * figures(i);
      ++taken;
    }
    if (taken > 0) means(v) = std::sqrt(squares / taken);
  }
  return means;
}

void set_swing(const VecX& errors, const PressureLine& line, LineError& local) {
  for (Eigen::Index i = 0; i < errors.size(); ++i)
    if (line.loaded[i] && std::isfinite(errors(i))) local.swing(i) = errors(i) * std::sqrt(line.h(i));
}

}  // namespace mortise
