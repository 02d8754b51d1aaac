#include "support/wedge_fields.hpp"

#include "base/dense.hpp"

namespace mortise::test {
namespace {

using Complex = std::complex<double>;

WedgeFields directional_fields(const Wedge& w, double lambda, double theta) {
  const Eigen::Matrix3d& s = w.compliance;
  Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
  companion.bottomLeftCorner<3, 3>().setIdentity();
  companion.row(0) << 2 * s(0, 2), -2 * s(0, 1) - s(2, 2), 2 * s(1, 2), -s(1, 1);
  companion.row(0) /= s(0, 0);
  WedgeFields f;
  int k = 0;
  const double c = std::cos(theta), d = std::sin(theta);
  for (const Complex& mu : eigenvalues(companion)) {
    if (mu.imag() < 0) continue;
    Complex log = std::log(c + mu * d);
    log.imag(log.imag() + 2 * straight * std::round((theta - log.imag()) / (2 * straight)));
    for (const Complex& unit : {Complex(1), Complex(0, 1)}) {
      const Complex A = unit * std::exp(lambda * log), stress = lambda * unit * std::exp((lambda - 1) * log);
      const double u1 = ((s(0, 0) * mu * mu + s(0, 1) - s(0, 2) * mu) * A).real(),
                   u2 = ((s(0, 1) * mu + s(1, 1) / mu - s(1, 2)) * A).real(), s11 = (mu * mu * stress).real(),
                   s22 = stress.real(), s12 = -(mu * stress).real();
      f.normal(k) = s11 * d * d + s22 * c * c - 2 * s12 * c * d;
      f.shear(k) = (s22 - s11) * c * d + s12 * (c * c - d * d);
      f.ur(k) = u1 * c + u2 * d;
      f.ut(k) = -u1 * d + u2 * c;
      ++k;
    }
  }
  return f;
}

}  // namespace

double shear(const Wedge& w) { return 1 / w.compliance(2, 2); }

double kolosov(const Wedge& w) { return 8 * shear(w) * w.compliance(0, 0) - 1; }

WedgeFields fields(const Wedge& w, double lambda, double theta) {
  if (w.first) return directional_fields(w, lambda, theta);
  WedgeFields f;
  const Complex z = std::polar(1.0, theta), power = std::polar(1.0, lambda * theta);
  for (int k = 0; k < 4; ++k) {
    const Complex unit = k % 2 ? Complex(0, 1) : 1, phi = k < 2 ? unit * power : 0, psi = k < 2 ? 0 : unit * power;
    const Complex d_phi = lambda * phi / z, dd_phi = (lambda - 1) * d_phi / z, d_psi = lambda * psi / z;
    const Complex traction = 2 * d_phi.real() + z * z * (std::conj(z) * dd_phi + d_psi),
                  u = (kolosov(w) * phi - z * std::conj(d_phi) - std::conj(psi)) / z / (2 * shear(w));
    f.normal(k) = traction.real();
    f.shear(k) = traction.imag();
    f.ur(k) = u.real();
    f.ut(k) = u.imag();
  }
  return f;
}

}  // namespace mortise::test
