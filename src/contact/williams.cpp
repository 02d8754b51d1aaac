#include "contact/williams.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

namespace mortise {
namespace {

using Complex = std::complex<double>;
using Rows = Eigen::Matrix<Complex, 2, 4>;
using Function = std::function<Complex(Complex)>;

// Where zeros are looked for: from a real part, up to an imaginary one. None is above 0.5i on a grid of angles, faces
// and materials.
constexpr double first_exponent = 1e-3, highest = 1;

// Williams (1952), docs/theory.md eq. (42): Airy's function r^(lambda + 1) F, F = A cos(lambda + 1) theta + B
// sin(lambda + 1) theta + C cos(lambda - 1) theta + D sin(lambda - 1) theta. Of A, B, C, D, up to factors of r and
// lambda:
//   sigma_thetatheta = F, sigma_rtheta = F', 2 mu u_r = (kappa + 1) G_r - (lambda + 1) F,
//   2 mu u_theta = (kappa + 1) G_theta - F'.
// The two of them that a face holds at zero.
Rows rows_of(Face face, Complex lambda, double theta, double kappa) {
  using Row = Eigen::Matrix<Complex, 1, 4>;
  const Complex i(0, 1), p = lambda + 1.0, m = lambda - 1.0, e = std::exp(i * (lambda * theta)),
                         e1 = std::polar(1.0, theta), ep = e * e1, em = e / e1, cp = (ep + 1.0 / ep) / 2.0,
                         sp = (ep - 1.0 / ep) / (2.0 * i), c = (em + 1.0 / em) / 2.0, s = (em - 1.0 / em) / (2.0 * i);
  const Row F(cp, sp, c, s), dF(-p * sp, p * cp, -m * s, m * c), Gr(0, 0, c, s), Gt(0, 0, s, -c);
  Rows rows;
  switch (face) {
    case Face::free:
      rows << F, dF;
      break;
    case Face::clamped:
      rows << (kappa + 1) * Gr - p * F, (kappa + 1) * Gt - dF;
      break;
    case Face::symmetric:
      rows << Gt, dF;
      break;
    case Face::antisymmetric:
      rows << F, Gr;
  }
  return rows;
}

using Matrix = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic>;

// Eq. (43), or of a bonded joint: the four rows on the wedges before and after it; displacements in those of the softer
// one, so that all rows are of one size.
void set_joint(Joint joint, const Wedge& before, const Wedge& after, Complex lambda, Eigen::Ref<Matrix> of_before,
               Eigen::Ref<Matrix> of_after) {
  const double soft = std::min(before.shear, after.shear);
  const auto u = [&](const Wedge& w, double theta) {
    return Rows(soft / w.shear * rows_of(Face::clamped, lambda, theta, w.kolosov));
  };
  const Rows t = rows_of(Face::free, lambda, before.angle, before.kolosov),
             t_after = rows_of(Face::free, lambda, 0, after.kolosov);
  if (joint == Joint::bonded) {
    of_before << u(before, before.angle), t;
    of_after << -u(after, 0), -t_after;
  } else {
    of_before << u(before, before.angle).row(1), t.row(0), t.row(1), Rows::Zero().row(0);
    of_after << -u(after, 0).row(1), -t_after.row(0), Rows::Zero().row(0), t_after.row(1);
  }
}

// Eq. (44): the conditions on A, B, C, D of all wedges, singular where the fan has a mode.
Matrix conditions(const Fan& fan, Complex lambda) {
  const Eigen::Index count = Eigen::Index(fan.wedges.size());
  Matrix all = Matrix::Zero(4 * count, 4 * count);
  for (std::size_t i = 0; i < fan.joints.size(); ++i) {
    const std::size_t next = (i + 1) % fan.wedges.size();
    Matrix before(4, 4), after(4, 4);
    set_joint(fan.joints[i], fan.wedges[i], fan.wedges[next], lambda, before, after);
    all.block(4 * i, 4 * i, 4, 4) += before;
    all.block(4 * i, 4 * next, 4, 4) += after;
  }
  if (fan.joints.size() < fan.wedges.size()) {
    const Wedge& last = fan.wedges.back();
    all.block(4 * count - 4, 0, 2, 4) = rows_of(fan.first, lambda, 0, fan.wedges[0].kolosov);
    all.block(4 * count - 2, 4 * count - 4, 2, 4) += rows_of(fan.last, lambda, last.angle, last.kolosov);
  }
  return all;
}

// Whether a mode at lambda presses on a joint: what is smaller is round-off of a zero that is found to 1e-7.
bool loads(const Fan& fan, std::size_t joint, Complex lambda) {
  constexpr double least = 1e-6;
  const Eigen::JacobiSVD<Matrix> svd(conditions(fan, lambda), Eigen::ComputeFullV);
  const Eigen::Index size = svd.cols();
  const VecX values = svd.singularValues();
  Eigen::Index modes = 1;
  while (modes < size && values(size - 1 - modes) < least * values(0)) ++modes;
  const Wedge& w = fan.wedges[joint];
  const Eigen::Matrix<Complex, 1, 4> pressure = rows_of(Face::free, lambda, w.angle, w.kolosov).row(0);
  return (pressure * svd.matrixV().block(4 * joint, size - modes, 4, modes)).norm() > least * pressure.norm();
}

// How far arg f turns on the way from one place to another. Steps are short beside the distance to the zeros at 0 and
// 1, which are multiple.
double turn(const Function& f, Complex from, Complex to) {
  double total = 0, step = 1;
  Complex z = from, value = f(from);
  while (z != to) {
    step = std::min({2 * step, 0.1, 0.3 * std::abs(z), 0.3 * std::abs(z - 1.0)});
    for (;; step /= 2) {
      const Complex next = std::abs(to - z) <= step ? to : z + step * (to - z) / std::abs(to - z), there = f(next);
      const double angle = std::arg(there / value);
      if (std::abs(angle) > 1 && step > 1e-9) continue;
      total += angle;
      z = next;
      value = there;
      break;
    }
  }
  return total;
}

Complex newton(const Function& f, Complex z) {
  constexpr double h = 1e-6;
  for (int k = 0; k < 50; ++k) {
    const Complex step = 2 * h * f(z) / (f(z + h) - f(z - h));
    z -= step;
    if (!(std::abs(step) > 1e-14)) break;
  }
  return z;
}

// The zero of the smallest real part above `begin`, its imaginary part not negative. By the argument principle: as
// f(conj z) = conj f(z), half of the way around a box about the real axis is half of the turn.
std::optional<Complex> next_zero(const Function& f, double begin) {
  double end = regular_exponent, low = 0, high = highest;
  if (begin >= end) return {};
  const auto up = [&](double x, double y) { return turn(f, x, {x, y}); };
  const auto is_between = [&](double up_begin, double up_end, double x, double y) {
    return up_end + turn(f, {x, y}, {begin, y}) - up_begin > std::numbers::pi / 2;
  };
  // Small beside the distance to the zeros at 0 and 1, where Newton's method would go.
  const auto width = [&] { return 0.1 * std::min({0.1, begin, 1 - end}); };
  const double up_begin = up(begin, high);
  if (!is_between(up_begin, up(end, high), end, high)) return {};
  for (double left = up_begin; end - begin > width();) {
    const double middle = begin + 0.483 * (end - begin), right = up(middle, high);  // not where exponents tend to be
    if (is_between(left, right, middle, high)) {
      end = middle;
    } else {
      begin = middle;
      left = right;
    }
  }
  while (high - low > width()) {
    const double middle = low + 0.483 * (high - low);
    (is_between(up(begin, middle), up(end, middle), end, middle) ? high : low) = middle;
  }
  const Complex z = newton(f, {(begin + end) / 2, (low + high) / 2});
  return Complex(std::clamp(z.real(), begin, end), std::abs(z.imag()) < 1e-8 ? 0 : std::abs(z.imag()));
}

// The least real exponent above a regular one, of a mode that loads the contact: where no constant stress does, as at
// the end of faces that meet at other than right angles, p = 0 at the very place.
double falling_exponent(const Fan& fan, std::size_t joint) {
  constexpr double begin = 2 - regular_exponent, step = 0.01;
  const auto f = [&](double lambda) { return conditions(fan, lambda).determinant().real(); };
  for (double left = begin, right; left < falling_limit; left = right) {
    right = std::min(left + step, falling_limit);
    const double at_left = f(left);
    if (!(at_left * f(right) < 0)) continue;
    double low = left, high = right;
    while (high - low > 1e-10) {
      const double middle = (low + high) / 2;
      (at_left * f(middle) < 0 ? high : low) = middle;
    }
    if (loads(fan, joint, low)) return low;
  }
  return 1;
}

// What is alike makes one key, the angles as whoever comes first has them.
std::vector<double> key_of(Fan& fan, std::optional<std::size_t> joint) {
  std::vector<double> key{joint ? double(*joint) : -1, double(fan.first), double(fan.last)};
  for (const Joint of_two : fan.joints) key.push_back(double(of_two));
  for (Wedge& w : fan.wedges) {
    w.angle = 1e-10 * std::round(1e10 * w.angle);
    key.insert(key.end(), {w.angle, w.shear / fan.wedges[0].shear, w.kolosov});
  }
  return key;
}

}  // namespace

Wedge wedge(double angle, const ElasticLaw& law, Face outer) {
  const double coupling = law.stiffness(0, 1), mu = law.stiffness(3, 3);
  return {angle, mu, (coupling + 3 * mu) / (coupling + mu), outer};
}

Fan end_fan(const Wedge& a, const Wedge& b) { return {{a, b}, {Joint::sliding}, a.outer, b.outer}; }

Fan kink_fan(const Wedge& a, const Wedge& b) { return {{a, b}, {Joint::sliding, Joint::sliding}}; }

TipExponents exponents(const Fan& fan, std::optional<std::size_t> joint) {
  const Function f = [&](Complex lambda) { return conditions(fan, lambda).determinant(); };
  TipExponents found;
  for (auto zero = next_zero(f, first_exponent); zero; zero = next_zero(f, zero->real() + 1e-6)) {
    if (found.stress == 1.0) found.stress = *zero;
    if (joint && !loads(fan, *joint, *zero)) continue;
    if (joint) found.pressure = *zero;
    break;
  }
  if (joint && found.stress == 1.0 && !loads(fan, *joint, 1)) found.falling = falling_exponent(fan, *joint);
  return found;
}

TipExponents TipTable::find(const Fan& asked, std::optional<std::size_t> joint) {
  Fan fan = asked;
  const std::vector<double> key = key_of(fan, joint);
  {
    const std::lock_guard lock(mutex_);
    if (const auto at = known_.find(key); at != known_.end()) return at->second;
  }
  const TipExponents found = exponents(fan, joint);
  const std::lock_guard lock(mutex_);
  return known_.emplace(key, found).first->second;
}

}  // namespace mortise
