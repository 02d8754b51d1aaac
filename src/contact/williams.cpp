#include "contact/williams.hpp"

#include <Eigen/LU>
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

Complex determinant(const Rows& a, const Rows& b) {
  Eigen::Matrix<Complex, 4, 4> all;
  all << a, b;
  return all.determinant();
}

// Of a wedge whose other face, in contact, slides along a rigid wall or is free: zero where it has a mode of its own.
// On that face (sigma_rtheta = 0) sigma_thetatheta : 2 mu u_theta / (kappa + 1) = free : wall.
struct Response {
  Complex wall, free;
  double size;  // bound of both (Hadamard)
};

Response response(const Wedge& w, Complex lambda) {
  const Rows outer = rows_of(w.outer, lambda, w.angle, w.kolosov),
             wall = rows_of(Face::symmetric, lambda, 0, w.kolosov), free = rows_of(Face::free, lambda, 0, w.kolosov);
  return {determinant(outer, wall), determinant(outer, free),
          outer.rowwise().norm().prod() * free.rowwise().norm().prod()};
}

// Eq. (44): equal sigma_thetatheta on both sides, opposite u_theta.
Complex matching(const Wedge& a, const Wedge& b, Complex lambda) {
  const Response ra = response(a, lambda), rb = response(b, lambda);
  const double ca = a.compliance(), cb = b.compliance();
  return (ca * ra.wall * rb.free + cb * rb.wall * ra.free) / (ca + cb);
}

// A mode in which either wedge has sigma_thetatheta = 0 on the face in contact has it on both sides.
bool loads_contact(const Wedge& a, const Wedge& b, Complex lambda) {
  const Response ra = response(a, lambda), rb = response(b, lambda);
  return std::abs(ra.free) > 1e-7 * ra.size && std::abs(rb.free) > 1e-7 * rb.size;
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

Wedge half_of(Wedge w, Face bisector) {
  w.angle /= 2;
  w.outer = bisector;
  return w;
}

using Matrix4 = Eigen::Matrix<Complex, 4, 4>;

// What neighbours have in common along a ray: u_r, u_theta, sigma_thetatheta, sigma_rtheta, of A, B, C, D.
Matrix4 state(const Wedge& w, Complex lambda, double theta) {
  Matrix4 rows;
  rows << rows_of(Face::clamped, lambda, theta, w.kolosov) / w.shear, rows_of(Face::free, lambda, theta, w.kolosov);
  return rows;
}

// From A, B, C, D of the first wedge to those of the last. The state at theta = 0 can be inverted but for lambda = -1.
Matrix4 transfer(std::span<const Wedge> wedges, Complex lambda) {
  Matrix4 all = Matrix4::Identity();
  for (std::size_t i = 0; i + 1 < wedges.size(); ++i)
    all = state(wedges[i + 1], lambda, 0).inverse() * state(wedges[i], lambda, wedges[i].angle) * all;
  return all;
}

// Stiffnesses over that of the first: only their ratios count.
std::vector<Wedge> relative(std::span<const Wedge> wedges) {
  std::vector<Wedge> list(wedges.begin(), wedges.end());
  for (Wedge& w : list) w.shear /= wedges[0].shear;
  return list;
}

// The least real exponent above a regular one, of a mode that loads the contact: of faces that meet at other than right
// angles p = 0 at the very end, if neither shear nor the free face leaves anything else.
double falling_exponent(const Wedge& a, const Wedge& b) {
  constexpr double begin = 2 - regular_exponent, step = 0.01;
  const auto f = [&](double lambda) { return matching(a, b, lambda).real(); };
  for (double left = begin, right; left < falling_limit; left = right) {
    right = std::min(left + step, falling_limit);
    const double at_left = f(left);
    if (!(at_left * f(right) < 0)) continue;
    double low = left, high = right;
    while (high - low > 1e-10) {
      const double middle = (low + high) / 2;
      (at_left * f(middle) < 0 ? high : low) = middle;
    }
    if (loads_contact(a, b, low)) return low;
  }
  return 1;
}

bool lower(Complex a, Complex b) { return a.real() < b.real(); }

}  // namespace

Wedge wedge(double angle, const ElasticLaw& law, Face outer) {
  const double coupling = law.stiffness(0, 1), mu = law.stiffness(3, 3);
  return {angle, mu, (coupling + 3 * mu) / (coupling + mu), outer};
}

Complex wedge_exponent(const Wedge& w, Face other) {
  const Function f = [&](Complex lambda) {
    return determinant(rows_of(w.outer, lambda, w.angle, w.kolosov), rows_of(other, lambda, 0, w.kolosov));
  };
  return next_zero(f, first_exponent).value_or(1);
}

std::complex<double> bonded_exponent(std::span<const Wedge> bonded, Face first, Face last) {
  const std::vector<Wedge> wedges = relative(bonded);
  const Wedge& end = wedges.back();
  const Function f = [&](Complex lambda) {
    const Rows at_last = rows_of(last, lambda, end.angle, end.kolosov) * transfer(wedges, lambda);
    return determinant(at_last, rows_of(first, lambda, 0, wedges[0].kolosov));
  };
  return next_zero(f, first_exponent).value_or(1);
}

std::complex<double> bonded_exponent_inside(std::span<const Wedge> bonded) {
  const std::vector<Wedge> wedges = relative(bonded);
  const Function f = [&](Complex lambda) {
    const Matrix4 around = state(wedges.back(), lambda, wedges.back().angle) * transfer(wedges, lambda);
    return (around - state(wedges[0], lambda, 0)).determinant();
  };
  return next_zero(f, first_exponent).value_or(1);
}

TipExponents end_exponents(const Wedge& a, const Wedge& b) {
  const Function f = [&](Complex lambda) { return matching(a, b, lambda); };
  TipExponents found;
  for (auto zero = next_zero(f, first_exponent); zero; zero = next_zero(f, zero->real() + 1e-6)) {
    if (found.stress == 1.0) found.stress = *zero;
    if (!loads_contact(a, b, *zero)) continue;
    found.pressure = *zero;
    break;
  }
  if (found.stress == 1.0) found.falling = falling_exponent(a, b);
  return found;
}

TipExponents kink_exponents(const Wedge& a, const Wedge& b, Face bisector) {
  return end_exponents(half_of(a, bisector), half_of(b, bisector));
}

TipExponents kink_exponents(const Wedge& a, const Wedge& b) {
  const TipExponents s = kink_exponents(a, b, Face::symmetric), t = kink_exponents(a, b, Face::antisymmetric);
  return {std::min(s.stress, t.stress, lower), std::min(s.pressure, t.pressure, lower)};
}

TipExponents TipTable::find(bool kink, Wedge a, Wedge b) {
  for (Wedge* w : {&a, &b}) w->angle = 1e-10 * std::round(1e10 * w->angle);  // whoever comes first
  const Key key{kink, a.angle, a.shear, a.kolosov, a.outer, b.angle, b.shear, b.kolosov, b.outer};
  {
    const std::lock_guard lock(mutex_);
    if (const auto at = known_.find(key); at != known_.end()) return at->second;
  }
  const TipExponents found = kink ? kink_exponents(a, b) : end_exponents(a, b);
  const std::lock_guard lock(mutex_);
  return known_.emplace(key, found).first->second;
}

template <typename Find>
double TipTable::find_corner(const std::vector<Wedge>& wedges, double first, double last, const Find& find) {
  std::vector<double> key{first, last};
  for (const Wedge& w : wedges) key.insert(key.end(), {w.angle, w.shear / wedges[0].shear, w.kolosov});
  {
    const std::lock_guard lock(mutex_);
    if (const auto at = known_corners_.find(key); at != known_corners_.end()) return at->second;
  }
  const double found = find().real();
  const std::lock_guard lock(mutex_);
  return known_corners_.emplace(key, found).first->second;
}

double TipTable::corner(const std::vector<Wedge>& wedges, Face first, Face last) {
  return find_corner(wedges, double(first), double(last), [&]() -> Complex {
    if (wedges.size() > 1) return bonded_exponent(wedges, first, last);
    Wedge one = wedges[0];
    one.outer = last;
    return wedge_exponent(one, first);
  });
}

double TipTable::inside(const std::vector<Wedge>& wedges) {
  return find_corner(wedges, -1, -1, [&] { return bonded_exponent_inside(wedges); });
}

TipExponents TipTable::ends(const Wedge& a, const Wedge& b) { return find(false, a, b); }

TipExponents TipTable::kinks(const Wedge& a, const Wedge& b) { return find(true, a, b); }

}  // namespace mortise
