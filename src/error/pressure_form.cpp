#include "error/pressure_form.hpp"

#include <Eigen/SparseLU>
#include <algorithm>
#include <unsupported/Eigen/Splines>
#include <utility>

#include "fem/quadrature.hpp"

namespace mortise {
namespace {

using Eigen::Index;
using Cubics = Eigen::Spline<double, 1, 3>;
constexpr int degree = 3;

// Whether a place is so near to the tip at this end that q has no knot there.
bool beside_tip(const LoadedPiece& piece, const std::array<double, 2>& ends, int which, double s) {
  return piece.end[which].tip && std::abs(s - ends[which]) < piece.swing.part * (ends[1] - ends[0]);
}

// The knots of q: its ends, and the vertices between them but for those next to each end. Without an end's own
// condition a cubic leaves out one (not a knot); at r = 0 one more, as that moment is none.
VecX knots_of(const LoadedPiece& piece, const std::array<double, 2>& ends) {
  std::vector<double> places{ends[0]};
  for (const double s : piece.s)
    if (s > ends[0] && s < ends[1]) places.push_back(s);
  places.push_back(ends[1]);
  const Index last = piece.s.size() - 1;
  const auto skipped = [&](int k) -> Index {
    if (!piece.end[k].tip && !piece.end[k].border) return piece.width(k * last) == 0 ? 3 : 2;
    const auto within = std::ranges::count_if(places, [&](double s) { return beside_tip(piece, ends, k, s); });
    return std::max<Index>(piece.swing.edges, within);
  };
  const Index count = std::max<Index>(Index(places.size()) - skipped(0) - skipped(1), 0);
  VecX knots(count + 2 * (degree + 1));
  knots.head(degree + 1).setConstant(ends[0]);
  for (Index k = 0; k < count; ++k) knots(degree + 1 + k) = places[skipped(0) + k];
  knots.tail(degree + 1).setConstant(ends[1]);
  return knots;
}

double power_of(double distance, double length, double power) {
  return power == 0 ? 1 : std::pow(std::max(distance, 0.0) / length, power);
}

// The factor of q at s.
double factor_at(const std::array<double, 2>& ends, const std::array<double, 2>& powers, double s) {
  const double length = ends[1] - ends[0];
  return power_of(s - ends[0], length, powers[0]) * power_of(ends[1] - s, length, powers[1]);
}

// Of each hat (row) and spline (column) the moment of the spline times the factor.
Triplets spline_moments(const LoadedPiece& piece, const std::array<double, 2>& ends, const VecX& knots) {
  static const LineRule rule = gauss_legendre(10);
  const Cubics::KnotVectorType row = knots.transpose().array();
  const std::array<double, 2> powers{piece.end[0].power, piece.end[1].power};
  Triplets moments;
  for (Index e = 0; e + 1 < piece.s.size(); ++e) {
    const double from = std::max(piece.s(e), ends[0]), to = std::min(piece.s(e + 1), ends[1]);
    if (!(from < to)) continue;
    const bool left = from == ends[0] && powers[0] != 0, right = to == ends[1] && powers[1] != 0;
    // Graded: of r^(exponent - 1) dr a line in t is left, of a root a parabola and a polynomial in t.
    const double exponent = 1 + (left ? powers[0] : right ? powers[1] : 0);
    const double grading = exponent == 1 ? 1 : exponent == 1.5 ? 2 : 2 / exponent;
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const double t = (1 + rule.points[q]) / 2, graded = std::pow(t, grading);
      const double s = left || !right ? from + (to - from) * graded : to - (to - from) * graded;
      const double z = (s - piece.s(e)) / (piece.s(e + 1) - piece.s(e));
      const double width = (1 - z) * piece.width(e) + z * piece.width(e + 1);
      const double weight =
          (to - from) * grading * graded / t * rule.weights[q] / 2 * width * factor_at(ends, powers, s);
      const Index first = Cubics::Span(s, degree, row) - degree;
      const auto values = Cubics::BasisFunctions(s, degree, row);
      for (int k = 0; k <= degree; ++k) {
        moments.emplace_back(e, first + k, weight * (1 - z) * values(k));
        moments.emplace_back(e + 1, first + k, weight * z * values(k));
      }
    }
  }
  return moments;
}

// int p_h phi_i.
VecX multiplier_moments(const LoadedPiece& piece) {
  if (piece.moments.size() > 0) return piece.moments;
  VecX moments = VecX::Zero(piece.s.size());
  for (Index e = 0; e + 1 < piece.s.size(); ++e) {
    const double h = piece.s(e + 1) - piece.s(e);
    for (const double t : {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)}) {  // Gauss, 3 points
      const double weight = h * (t == 0.5 ? 4.0 : 2.5) / 9 * ((1 - t) * piece.width(e) + t * piece.width(e + 1)) *
                            ((1 - t) * piece.p(e) + t * piece.p(e + 1));
      moments(e) += weight * (1 - t);
      moments(e + 1) += weight * t;
    }
  }
  return moments;
}

// By which forces summed up to each edge count, squared: as p's own square along the line, the same near the axis of
// rings as away from it, whatever the edges; where q has no knot beside the tip of a crack, as that of a p which varies
// over so much.
VecX sum_weights(const LoadedPiece& piece, const std::array<double, 2>& ends) {
  const Index edges = piece.s.size() - 1;
  const double smooth = piece.swing.part * (ends[1] - ends[0]);
  VecX weights(edges);
  for (Index e = 0; e < edges; ++e) {
    const double length = piece.s(e + 1) - piece.s(e), middle = (piece.s(e) + piece.s(e + 1)) / 2;
    const bool beside = beside_tip(piece, ends, 0, middle) || beside_tip(piece, ends, 1, middle);
    const double varies = beside ? smooth * smooth / length : length;
    weights(e) = 1 / (varies * std::pow((piece.width(e) + piece.width(e + 1)) / 2, 2));
  }
  return weights;
}

VecX column_sizes(const Triplets& entries, Index columns) {
  VecX sizes = VecX::Constant(columns, std::numeric_limits<double>::min());
  for (const auto& entry : entries) sizes(entry.col()) = std::max(sizes(entry.col()), std::abs(entry.value()));
  return sizes;
}

void add_both(Index i, Index j, double value, Triplets& symmetric) {
  symmetric.emplace_back(i, j, value);
  symmetric.emplace_back(j, i, value);
}

// Two rows: p* has no slope at an end on an axis; nothing at others. q' = 3 (q_1 - q_0) / h there, and the factor of
// the other end slopes too.
void add_slopes(const LoadedPiece& piece, const std::array<double, 2>& ends, const VecX& knots, const VecX& sizes,
                Index first_row, Triplets& system) {
  const Index columns = sizes.size();
  for (const int which : {0, 1}) {
    const Index row = first_row + which;
    if (!piece.end[which].even) {
      system.emplace_back(row, row, 1);
      continue;
    }
    const Index edge = which == 0 ? 0 : columns - 1, next = which == 0 ? 1 : columns - 2;
    const double h = which == 0 ? knots(degree + 1) - ends[0] : ends[1] - knots(columns - 1);
    const double of_factor = piece.end[1 - which].power * h / (ends[1] - ends[0]);
    add_both(row, edge, (degree + of_factor) / sizes(edge), system);
    add_both(row, next, -degree / sizes(next), system);
  }
}

}  // namespace

Index LoadedPiece::loaded(int which) const {
  Index i = which == 0 ? 0 : p.size() - 1;
  while (p(i) == 0) i += which == 0 ? 1 : -1;
  return i;
}

double PressureForm::operator()(double s) const {
  if (s < ends_[0] || s > ends_[1]) return 0;
  const Cubics::KnotVectorType row = knots_.transpose().array();
  const Index first = Cubics::Span(s, degree, row) - degree;
  const auto values = Cubics::BasisFunctions(s, degree, row);
  double q = 0;
  for (int k = 0; k <= degree; ++k) q += values(k) * q_(first + k);
  return factor_at(ends_, powers_, s) * q;
}

struct PressureFit::Factor {
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu;
};

// With c the sums of what is left of the moments: min sum_i w_i c_i^2 / 2 with c_i - c_{i-1} = m_i - (M q)_i, no force
// left (the last c is 0), no moment (sum_i c_i h_i = 0) and no slope on an axis, by its saddle point, which is sparse.
PressureFit::PressureFit(const LoadedPiece& piece, const std::array<double, 2>& ends) {
  form_.ends_ = ends;
  form_.powers_ = {piece.end[0].power, piece.end[1].power};
  form_.knots_ = knots_of(piece, ends);
  const Triplets entries = spline_moments(piece, ends, form_.knots_);
  const Index columns = form_.knots_.size() - degree - 1, count = piece.s.size(), sums = count - 1;
  if (columns > count) return;
  sizes_ = column_sizes(entries, columns);
  const VecX weights = sum_weights(piece, ends);
  const double heaviest = weights.maxCoeff(), length = piece.s(sums) - piece.s(0);
  // Unknowns: q, c, the multipliers of the rows, of the moment, of the slopes at both ends.
  const Index at_row = columns + sums, moment = at_row + count, all = moment + 3;
  Triplets system;
  for (const auto& entry : entries)
    add_both(at_row + entry.row(), entry.col(), entry.value() / sizes_(entry.col()), system);
  for (Index i = 0; i < sums; ++i) {
    system.emplace_back(columns + i, columns + i, weights(i) / heaviest);
    add_both(at_row + i, columns + i, 1, system);
    add_both(at_row + i + 1, columns + i, -1, system);
    add_both(moment, columns + i, (piece.s(i + 1) - piece.s(i)) / length, system);
  }
  add_slopes(piece, ends, form_.knots_, sizes_, moment + 1, system);
  factor_ = std::make_unique<Factor>();
  factor_->lu.compute(filled(all, all, system));
}

PressureFit::~PressureFit() = default;
PressureFit::PressureFit(PressureFit&&) noexcept = default;
PressureFit& PressureFit::operator=(PressureFit&&) noexcept = default;

std::optional<PressureForm> PressureFit::form(const LoadedPiece& piece) const {
  const VecX moments = multiplier_moments(piece);
  const double force = moments.cwiseAbs().maxCoeff();
  if (!factor_ || factor_->lu.info() != Eigen::Success || !(force > 0)) return std::nullopt;
  const Index columns = sizes_.size();
  VecX right = VecX::Zero(factor_->lu.rows());
  right.segment(columns + moments.size() - 1, moments.size()) = moments / force;
  PressureForm form = form_;
  form.q_ = force * factor_->lu.solve(right).head(columns).cwiseQuotient(sizes_);
  if (!form.q_.allFinite()) return std::nullopt;
  return form;
}

std::optional<PressureForm> fit_pressure(const LoadedPiece& piece, const std::array<double, 2>& ends) {
  return PressureFit(piece, ends).form(piece);
}

void PressureFits::begin() { before_ = std::exchange(asked_, {}); }

std::optional<PressureForm> PressureFits::fit(const LoadedPiece& piece, const std::array<double, 2>& ends) {
  const auto is_same = [&](const Asked& other) {
    return other.ends == ends && other.piece.end == piece.end && other.piece.swing == piece.swing &&
           other.piece.s.size() == piece.s.size() && other.piece.s == piece.s && other.piece.width == piece.width;
  };
  auto known = std::ranges::find_if(asked_, is_same);
  if (known == asked_.end()) {
    const auto before = std::ranges::find_if(before_, is_same);
    if (before == before_.end()) {
      asked_.push_back({piece, ends, {}});
      return fit_pressure(piece, ends);
    }
    known = asked_.insert(asked_.end(), std::move(*before));
    before_.erase(before);
  }
  if (!known->fit) known->fit.emplace(piece, ends);
  return known->fit->form(piece);
}

LoadedPiece every_other(const LoadedPiece& piece) {
  const Index edges = piece.s.size() - 1, coarse_edges = edges % 2 == 0 ? edges / 2 : edges / 4 * 2 + 1;
  // Two edges are one, counted from both ends; of an odd number one or three are that in the middle.
  const auto kept = [&](Index k) { return 2 * k <= coarse_edges ? 2 * k : edges - 2 * (coarse_edges - k); };
  const Index count = coarse_edges + 1;
  LoadedPiece coarse{.s = VecX(count),
                     .p = VecX(count),
                     .width = VecX(count),
                     .end = piece.end,
                     .moments = VecX::Zero(count),
                     .swing = piece.swing};
  for (Index k = 0; k < count; ++k) {
    coarse.s(k) = piece.s(kept(k));
    coarse.p(k) = piece.p(kept(k));
    coarse.width(k) = piece.width(kept(k));
  }
  const VecX moments = multiplier_moments(piece);
  coarse.moments(0) = moments(0);
  for (Index k = 0; k + 1 < count; ++k)
    for (Index i = kept(k) + 1; i <= kept(k + 1); ++i) {
      const double z = (piece.s(i) - coarse.s(k)) / (coarse.s(k + 1) - coarse.s(k));
      coarse.moments(k) += (1 - z) * moments(i);
      coarse.moments(k + 1) += z * moments(i);
    }
  return coarse;
}

double border_place(const LoadedPiece& piece, int which, Index stride) {
  const Index last = piece.loaded(which), inward = which == 0 ? 1 : -1;
  Eigen::Vector3d s, square;
  for (Index k = 0; k < 3; ++k) {
    s(k) = piece.s(last + k * inward * stride);
    square(k) = piece.p(last + k * inward * stride) * piece.p(last + k * inward * stride);
  }
  const Eigen::Vector3d off = s.array() - s.mean();
  const double slope = off.dot(square) / off.squaredNorm(), place = s.mean() - square.mean() / slope;
  const double next = piece.s(last - inward);
  const bool rises = slope * double(inward) > 0;
  return rises ? std::clamp(place, std::min(s(0), next), std::max(s(0), next)) : next;
}

std::optional<double> FittedPressure::at(double s) const {
  double sum = 0;
  int count = 0;
  for (const FittedPiece& piece : pieces)
    for (const double round : {0.0, around}) {
      if (!(s + round >= piece.vertices[0] && s + round <= piece.vertices[1])) continue;
      sum += piece.form(s + round) + piece.fluid;
      ++count;
      break;
    }
  return count > 0 && std::isfinite(sum) ? std::optional(sum / count) : std::nullopt;
}

}  // namespace mortise
