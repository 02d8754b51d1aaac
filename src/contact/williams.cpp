#include "contact/williams.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <optional>

#include "base/dense.hpp"
#include "model/moduli.hpp"

namespace mortise {
namespace {

using Complex = std::complex<double>;
using Function = std::function<Complex(Complex)>;
using Matrix = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic>;
using Matrix4 = Eigen::Matrix<Complex, 4, 4>;

// Where zeros are looked for: from a real part, up to an imaginary one. None is above 0.5i on a grid of angles, faces
// and materials.
constexpr double first_exponent = 1e-3, highest = 1;

// sinh x / x and tanh^-1 x / x are even: below this the next terms of their series, x^4 / 120 and x^4 / 5, are
// round-off.
constexpr double small = 1e-4;

Complex sinh_over(Complex x) { return std::abs(x) < small ? 1.0 + x * x / 6.0 : std::sinh(x) / x; }
Complex atanh_over(Complex x) { return std::abs(x) < small ? 1.0 + x * x / 3.0 : std::atanh(x) / x; }

// What y = (u_r, u_theta, phi_r, phi_theta), displacements times a modulus of the body and stress functions, is on the
// last face of a wedge by what it is on the first: docs/theory.md eq. (42).
class AcrossWedge {
 public:
  explicit AcrossWedge(const Wedge& w);
  /// Its matrix, of y ~ r^lambda.
  Matrix4 at(Complex lambda) const;

 private:
  std::array<Complex, 2> roots_;        // eigenvalues p of N, Im p > 0
  std::array<Complex, 2> turns_;        // by how much ln(cos theta + p sin theta) grows across it
  Complex slope_;                       // the divided difference of these
  std::array<Matrix4, 4> polynomials_;  // Newton's, of the eigenvalues and their conjugates, in polar components
};

// N of y,2 = N y,1 (Stroh 1958): Hooke's law with sigma_i1 = -phi_i,2 and sigma_i2 = phi_i,1, and equilibrium. Of
// compliances times a modulus.
Mat4 stroh(const Eigen::Matrix3d& s) {
  const double s11 = s(0, 0), r2 = s(0, 1) / s11, r6 = s(0, 2) / s11, n26 = s(1, 2) - s(0, 1) * r6;
  Mat4 N;
  N << r6, -1, s(2, 2) - s(0, 2) * r6, n26,  //
      r2, 0, n26, s(1, 1) - s(0, 1) * r2,    //
      -1 / s11, 0, r6, r2,                   //
      0, 0, -1, 0;
  return N;
}

// ln(cos theta + p sin theta), Im p > 0, with the argument that goes with theta.
Complex logarithm(Complex p, double theta) {
  const Complex log = std::log(std::cos(theta) + p * std::sin(theta));
  return {log.real(), log.imag() + 2 * straight * std::round((theta - log.imag()) / (2 * straight))};
}

// Of it the divided difference between two p, however near each other.
Complex logarithm_slope(Complex p, Complex q, double theta) {
  const Complex half = std::sin(theta) / (2 * std::cos(theta) + (p + q) * std::sin(theta));
  return 2.0 * half * atanh_over(half * (p - q));
}

Mat4 into_polar(double theta) {
  Mat4 turn = Mat4::Zero();
  turn.topLeftCorner<2, 2>() = turn.bottomRightCorner<2, 2>() = Eigen::Rotation2Dd(-theta).toRotationMatrix();
  return turn;
}

double shear(const Wedge& w) { return 1 / w.compliance(2, 2); }

AcrossWedge::AcrossWedge(const Wedge& w) {
  const Mat4 N = stroh(shear(w) * w.compliance);
  const double begin = w.first.value_or(0), end = begin + w.angle;
  std::size_t count = 0;
  for (const Complex& p : eigenvalues(N))
    if (p.imag() > 0 && count < 2) roots_[count++] = p;
  for (const int k : {0, 1}) turns_[k] = logarithm(roots_[k], end) - logarithm(roots_[k], begin);
  slope_ = logarithm_slope(roots_[0], roots_[1], end) - logarithm_slope(roots_[0], roots_[1], begin);
  Matrix4 product = into_polar(begin).transpose().cast<Complex>();
  for (const int k : {0, 1, 2, 3}) {
    polynomials_[k] = into_polar(end) * product;
    product = N * product - (k < 2 ? roots_[k] : std::conj(roots_[k - 2])) * product;
  }
}

// (cos theta + N sin theta)^lambda by Newton's divided differences on the eigenvalues of N, which are double in
// isotropic bodies.
Matrix4 AcrossWedge::at(Complex lambda) const {
  const auto& [p, q] = roots_;
  const Complex p2 = std::conj(p), q2 = std::conj(q);
  const auto power = [&](Complex turn) { return std::exp(lambda * turn); };
  const auto between = [&](Complex s, Complex t, Complex slope, Complex apart) {
    return power((s + t) / 2.0) * lambda * slope * sinh_over(lambda * slope * apart / 2.0);
  };
  const Complex at_q = power(turns_[1]), at_p2 = power(std::conj(turns_[0])),
                pq = between(turns_[0], turns_[1], slope_, p - q), qp2 = (at_p2 - at_q) / (p2 - q),
                p2q2 = between(std::conj(turns_[0]), std::conj(turns_[1]), std::conj(slope_), p2 - q2),
                pqp2 = (qp2 - pq) / (p2 - p), qp2q2 = (p2q2 - qp2) / (q2 - q), all = (qp2q2 - pqp2) / (q2 - p);
  return power(turns_[0]) * polynomials_[0] + pq * polynomials_[1] + pqp2 * polynomials_[2] + all * polynomials_[3];
}

// Places in y. On a face sigma_rtheta ~ phi_r and sigma_thetatheta ~ phi_theta.
enum Component { ur, ut, shear_stress, pressure };

// The two of them that a face holds at zero.
std::array<Component, 2> held_by(Face face) {
  switch (face) {
    case Face::free:
      return {shear_stress, pressure};
    case Face::clamped:
      return {ur, ut};
    case Face::symmetric:
      return {ut, shear_stress};
    case Face::antisymmetric:
      return {ur, pressure};
  }
  std::abort();
}

// Of a fan, the conditions on y on the first faces of all wedges.
class Modes {
 public:
  explicit Modes(const Fan& fan) : fan_(fan), across_(fan.wedges.begin(), fan.wedges.end()) {}
  Matrix conditions(Complex lambda) const;
  Complex determinant(Complex lambda) const { return conditions(lambda).determinant(); }
  bool loads(std::size_t joint, Complex lambda) const;
  TipMode mode(Complex lambda) const;

 private:
  // What y on the first faces may be at an exponent, a column a mode.
  Matrix null_space(Complex lambda) const;
  const Fan& fan_;
  std::vector<AcrossWedge> across_;
};

// Eq. (43) and (44): singular where the fan has a mode. Displacements of a joint in those of the softer one, so that
// all rows are of one size.
Matrix Modes::conditions(Complex lambda) const {
  const auto& [wedges, joints, first, last] = fan_;
  const Eigen::Index count = Eigen::Index(wedges.size());
  Matrix all = Matrix::Zero(4 * count, 4 * count);
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < wedges.size(); ++i) {
    const std::size_t next = (i + 1) % wedges.size();
    const Matrix4 across = across_[i].at(lambda);
    if (i == joints.size()) {
      for (const Component c : held_by(last)) all.block<1, 4>(row++, 4 * i) = across.row(c);
      for (const Component c : held_by(first)) all(row++, c) = 1;
      break;
    }
    const double soft = std::min(shear(wedges[i]), shear(wedges[next]));
    for (const Component c : {ur, ut, shear_stress, pressure}) {
      const bool moves = c == ur || c == ut;
      if (joints[i] == Joint::sliding && (c == ur || c == shear_stress)) {
        if (c == ur) continue;
        all.block<1, 4>(row++, 4 * i) = across.row(c);
        all(row++, 4 * next + c) += 1;
      } else {
        all.block<1, 4>(row, 4 * i) += (moves ? soft / shear(wedges[i]) : 1) * across.row(c);
        all(row++, 4 * next + c) -= moves ? soft / shear(wedges[next]) : 1;
      }
    }
  }
  return all;
}

// What is smaller is round-off of a zero that is found to 1e-7.
constexpr double least = 1e-6;

Matrix Modes::null_space(Complex lambda) const {
  const Eigen::JacobiSVD<Matrix> svd(conditions(lambda), Eigen::ComputeFullV);
  const Eigen::Index size = svd.cols();
  const VecX values = svd.singularValues();
  Eigen::Index modes = 1;
  while (modes < size && values(size - 1 - modes) < least * values(0)) ++modes;
  return svd.matrixV().rightCols(modes);
}

// Whether a mode at lambda presses on a joint.
bool Modes::loads(std::size_t joint, Complex lambda) const {
  const Eigen::Matrix<Complex, 1, 4> on_joint = across_[joint].at(lambda).row(pressure);
  return (on_joint * null_space(lambda).middleRows(4 * joint, 4)).norm() > least * on_joint.norm();
}

TipMode Modes::mode(Complex lambda) const {
  const Matrix found = null_space(lambda);
  TipMode mode{.exponent = lambda, .pressure = {}};
  mode.has_signs = found.cols() == 1 && lambda.imag() == 0;
  Eigen::Index largest;
  found.col(0).cwiseAbs().maxCoeff(&largest);
  const Matrix y = found.col(0) / found(largest, 0);
  const auto last_face = [&](std::size_t wedge, Component c) {
    const Eigen::Matrix<Complex, 1, 4> row = across_[wedge].at(lambda).row(c);
    const double value = (row * y.middleRows(4 * wedge, 4)).value().real();
    return std::abs(value) > least * row.norm() ? value : 0;
  };
  for (std::size_t i = 0; i < fan_.joints.size(); ++i)
    mode.pressure.push_back(fan_.joints[i] == Joint::sliding ? -last_face(i, pressure) : 0);
  mode.first = y(ut, 0).real() / shear(fan_.wedges.front());
  mode.last = last_face(fan_.wedges.size() - 1, ut) / shear(fan_.wedges.back());
  return mode;
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
double falling_exponent(const Modes& modes, std::size_t joint) {
  constexpr double begin = 2 - regular_exponent, step = 0.01;
  const auto f = [&](double lambda) { return modes.determinant(lambda).real(); };
  for (double left = begin, right; left < falling_limit; left = right) {
    right = std::min(left + step, falling_limit);
    const double at_left = f(left);
    if (!(at_left * f(right) < 0)) continue;
    double low = left, high = right;
    while (high - low > 1e-10) {
      const double middle = (low + high) / 2;
      (at_left * f(middle) < 0 ? high : low) = middle;
    }
    if (modes.loads(joint, low)) return low;
  }
  return 1;
}

}  // namespace

Wedge wedge(double angle, const ElasticLaw& law, Face outer, double first) {
  constexpr std::array in_plane{0, 1, 3};
  return {angle, inverse(Eigen::Matrix3d(law.stiffness(in_plane, in_plane))), contact_modulus(law), outer,
          law.is_isotropic_in_plane() ? std::optional<double>() : first};
}

bool Wedge::goes_on_in(const Wedge& next) const {
  constexpr double alike = 1e-6;  // radians, of directions of drawn curves
  return is_alike(next) && (!first || std::abs(std::remainder(*first + angle - *next.first, 2 * straight)) < alike);
}

void Wedge::round(double to) {
  angle = to * std::round(angle / to);
  if (first) first = to * std::round(*first / to);
}

Fan end_fan(const Wedge& a, const Wedge& b) { return {{a, b}, {Joint::sliding}, a.outer, b.outer}; }

Fan kink_fan(const Wedge& a, const Wedge& b) { return {{a, b}, {Joint::sliding, Joint::sliding}}; }

TipExponents exponents(const Fan& fan, std::optional<std::size_t> joint) {
  const Modes modes(fan);
  const Function f = [&](Complex lambda) { return modes.determinant(lambda); };
  TipExponents found;
  for (auto zero = next_zero(f, first_exponent); zero; zero = next_zero(f, zero->real() + 1e-6)) {
    if (found.stress == 1.0) found.stress = *zero;
    if (joint && !modes.loads(*joint, *zero)) continue;
    if (joint) found.pressure = *zero;
    break;
  }
  if (joint && found.stress == 1.0 && !modes.loads(*joint, 1)) found.falling = falling_exponent(modes, *joint);
  return found;
}

std::vector<TipMode> modes(const Fan& fan) {
  const Modes of(fan);
  const Function f = [&](Complex lambda) { return of.determinant(lambda); };
  std::vector<TipMode> all;
  for (auto zero = next_zero(f, first_exponent); zero; zero = next_zero(f, zero->real() + 1e-6))
    all.push_back(of.mode(*zero));
  return all;
}

}  // namespace mortise
