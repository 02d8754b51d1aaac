// Exponents of wedges against closed forms, and against Kolosov's potentials instead of Airy's function.
#include "contact/williams.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <numbers>
#include <optional>
#include <random>

#include "contact/tip_table.hpp"
#include "model/moduli.hpp"
#include "support/wedge_fields.hpp"
#include "support/wedges.hpp"

namespace mortise {
namespace {

using test::bonded_exponent_inside;
using test::end_exponents;
using test::fields;
using test::kink_exponents;
using test::kolosov;
using test::shear;
using test::wedge_exponent;
using Fields = test::WedgeFields;
using Complex = std::complex<double>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

constexpr double pi = std::numbers::pi, one_degree = pi / 180;

Wedge wedge_of(double degrees, Face outer = Face::free, double young = 1, double poisson = 0.3) {
  return wedge(degrees * one_degree, elastic_law(young, poisson, {Plane::strain}), outer);
}

// ---- One wedge: Williams (1952) ----

TEST(Williams, KolosovsConstantIsTheOneOfThePlane) {
  const Wedge strain = wedge_of(90), stress = wedge(1, elastic_law(1, 0.3, {Plane::stress}));
  EXPECT_NEAR(kolosov(strain), 3 - 4 * 0.3, 1e-14);
  EXPECT_NEAR(kolosov(stress), (3 - 0.3) / 1.3, 1e-14);
  EXPECT_NEAR(shear(stress), 1 / 2.6, 1e-14);
}

TEST(Williams, FreeFacesHaveTheRootsOfTheCharacteristicEquation) {
  EXPECT_NEAR(wedge_exponent(wedge_of(360), Face::free).real(), 0.5, 1e-10);  // a crack
  EXPECT_NEAR(wedge_exponent(wedge_of(270), Face::free).real(), 0.5444837367,
              1e-10);  // an L: sin(lambda w) = -lambda sin w
  for (const double degrees : {200.0, 240.0, 300.0, 350.0}) {
    const Complex lambda = wedge_exponent(wedge_of(degrees), Face::free);
    EXPECT_EQ(lambda.imag(), 0);
    EXPECT_NEAR(std::sin(lambda.real() * degrees * one_degree), -lambda.real() * std::sin(degrees * one_degree), 1e-10);
  }
  for (const double degrees : {20.0, 90.0, 179.0, 180.0})
    EXPECT_EQ(wedge_exponent(wedge_of(degrees), Face::free), 1.0) << degrees;
}

TEST(Williams, ClampedAndFree) {
  EXPECT_NEAR(wedge_exponent(wedge_of(90), Face::clamped).real(), 0.7111729, 1e-7);
  const Complex flat = wedge_exponent(wedge_of(180), Face::clamped);  // Muskhelishvili (1953): 1/2 + i ln(kappa) / 2 pi
  EXPECT_NEAR(std::abs(flat - Complex(0.5, std::log(1.8) / (2 * pi))), 0, 1e-10);
  for (const double degrees : {70.0, 120.0, 150.0, 250.0, 340.0}) {
    const double w = degrees * one_degree, kappa = 1.8;
    const Complex lambda = wedge_exponent(wedge_of(degrees, Face::clamped), Face::free), s = std::sin(lambda * w);
    EXPECT_LT(lambda.real(), 1);
    EXPECT_NEAR(
        std::abs(4 * kappa * s * s - (kappa + 1) * (kappa + 1) + 4.0 * lambda * lambda * std::pow(std::sin(w), 2)), 0,
        1e-9)
        << degrees;
  }
}

TEST(Williams, HalfOfASymmetricWedgeHasItsModes) {
  EXPECT_NEAR(std::abs(wedge_exponent(wedge_of(135), Face::symmetric) - wedge_exponent(wedge_of(270), Face::free)), 0,
              1e-10);
  // The antisymmetric modes of an L: sin(lambda w) = lambda sin w, 0.9085 (Williams 1952).
  EXPECT_NEAR(wedge_exponent(wedge_of(135), Face::antisymmetric).real(), 0.9085291898, 1e-9);
}

// ---- Two wedges: Dundurs & Lee (1972) ----

TEST(Williams, AWedgeOnAHalfPlaneHasTheExponentOfDundursAndLee) {
  for (const double stiffness : {1.0, 3.0, 0.2})
    for (const double degrees : {90.0, 120.0, 160.0}) {
      const TipExponents found = end_exponents(wedge_of(degrees, Face::free, stiffness), wedge_of(180));
      const double s = found.stress.real(), w = degrees * one_degree, alpha = (stiffness - 1) / (stiffness + 1);
      ASSERT_LT(s, 1) << degrees;
      EXPECT_EQ(found.stress, found.pressure);
      EXPECT_NEAR((1 + alpha) * std::cos(pi * s) * (std::pow(std::sin(s * w), 2) - std::pow(s * std::sin(w), 2)) +
                      (1 - alpha) / 2 * std::sin(pi * s) * (std::sin(2 * s * w) + s * std::sin(2 * w)),
                  0, 1e-10);
    }
  EXPECT_NEAR(end_exponents(wedge_of(90), wedge_of(180)).pressure.real(), 0.774013, 1e-6);
  EXPECT_NEAR(end_exponents(wedge_of(90, Face::free, 1e9), wedge_of(180)).pressure.real(), 0.5, 1e-8);  // a rigid punch
}

TEST(Williams, ATableKeepsTipsApart) {
  TipTable tips;
  const std::pair<Wedge, Wedge> asked[] = {{wedge_of(90), wedge_of(180)},
                                           {wedge_of(90 + 1e-10), wedge_of(180)},  // the same
                                           {wedge_of(91), wedge_of(180)},
                                           {wedge_of(90, Face::clamped), wedge_of(180)},
                                           {wedge_of(90, Face::free, 3), wedge_of(180)},
                                           {wedge_of(180), wedge_of(90)}};
  for (int again = 0; again < 2; ++again)
    for (const auto& [a, b] : asked)
      EXPECT_NEAR(std::abs(tips.find(end_fan(a, b), 0).stress - end_exponents(a, b).stress), 0, 1e-9);
  EXPECT_EQ(tips.find(end_fan(asked[0].first, asked[0].second)).stress,
            tips.find(end_fan(asked[1].first, asked[1].second)).stress);
  const Wedge a = wedge_of(100), b = wedge_of(260);
  EXPECT_NEAR(std::abs(tips.find(kink_fan(a, b), 0).stress - kink_exponents(a, b).stress), 0, 1e-9);
}

TEST(Williams, QuarterPlanesThatMeetHaveNoneUnlessTheyAreClamped) {
  EXPECT_EQ(end_exponents(wedge_of(90), wedge_of(90)).stress, 1.0);
  EXPECT_EQ(end_exponents(wedge_of(90, Face::symmetric), wedge_of(90, Face::symmetric, 7)).stress, 1.0);
  // Each on its own, clamped and free: the other one's mirror image, p = 0.
  const TipExponents clamped = end_exponents(wedge_of(90, Face::clamped), wedge_of(90, Face::clamped));
  EXPECT_NEAR(clamped.stress.real(), wedge_exponent(wedge_of(90), Face::clamped).real(), 1e-10);
  EXPECT_EQ(clamped.pressure, 1.0);
}

// ---- Modes by fields of their own ----

Eigen::Matrix<double, 2, 4> held(const Wedge& w, double lambda, double theta) {
  const Fields f = fields(w, lambda, theta);
  Eigen::Matrix<double, 2, 4> rows;
  if (w.outer == Face::free) rows << f.normal, f.shear;
  if (w.outer == Face::clamped) rows << f.ur, f.ut;
  if (w.outer == Face::symmetric) rows << f.ut, f.shear;
  if (w.outer == Face::antisymmetric) rows << f.ur, f.normal;
  return rows;
}

Eigen::Matrix<double, 4, 8> contact(const Fields& a, const Fields& b) {
  const Eigen::RowVector4d none = Eigen::RowVector4d::Zero();
  Eigen::Matrix<double, 4, 8> rows;
  rows << a.shear, none, none, b.shear, a.normal, -b.normal, a.ut, -b.ut;
  return rows;
}

// Body a from theta = 0 up, body b from 0 down.
Matrix8 end_conditions(const Wedge& a, const Wedge& b, double lambda) {
  Matrix8 M = Matrix8::Zero();
  M.topRows<4>() = contact(fields(a, lambda, 0), fields(b, lambda, 0));
  M.block<2, 4>(4, 0) = held(a, lambda, a.angle);
  M.block<2, 4>(6, 4) = held(b, lambda, -b.angle);
  return M;
}

Matrix8 kink_conditions(const Wedge& a, const Wedge& b, double lambda) {
  Matrix8 M;
  M << contact(fields(a, lambda, 0), fields(b, lambda, 0)),
      contact(fields(a, lambda, a.angle), fields(b, lambda, -b.angle));
  return M;
}

double residual(const Matrix8& M) { return M.jacobiSvd().singularValues()(7) / M.norm(); }

// The largest |sigma_thetatheta| on the contact face over the largest coefficient of the mode.
double pressure_of_mode(const Wedge& a, const Wedge& b, double lambda) {
  const Eigen::JacobiSVD<Matrix8> svd(end_conditions(a, b, lambda), Eigen::ComputeFullV);
  const Eigen::Matrix<double, 8, 1> mode = svd.matrixV().col(7);
  return std::abs(fields(a, lambda, 0).normal.dot(mode.head<4>())) / mode.cwiseAbs().maxCoeff();
}

Wedge random_wedge(std::mt19937& random, double largest) {
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  return wedge_of(uniform(20, largest), Face(int(uniform(0, 4))), std::exp(uniform(-3, 3)), uniform(0, 0.45));
}

// The smallest lambda between 0.01 and 0.99 at which the determinant changes its sign.
std::optional<double> first_change(const Wedge& a, const Wedge& b) {
  const auto sign = [&](double lambda) { return end_conditions(a, b, lambda).determinant() > 0; };
  for (double lambda = 0.012; lambda < 0.99; lambda += 0.002)
    if (sign(lambda) != sign(lambda - 0.002)) return lambda;
  return {};
}

TEST(Williams, ModesOfTwoWedgesSatisfyTheirConditionsInKolosovsPotentials) {
  std::mt19937 random(1);
  int singular = 0;
  for (int k = 0; k < 200; ++k) {
    const Wedge a = random_wedge(random, 200), b = random_wedge(random, 160);
    const TipExponents found = end_exponents(a, b);
    const auto change = first_change(a, b);
    EXPECT_LE(found.stress.real(), change.value_or(1)) << k;
    if (found.stress.imag() != 0 || found.stress.real() == 1) continue;
    ++singular;
    const double lambda = found.stress.real();
    EXPECT_LE(residual(end_conditions(a, b, lambda)), 1e-11) << k;
    EXPECT_GE(residual(end_conditions(a, b, 0.99 * lambda)), 1e-9) << k;
    EXPECT_EQ(found.pressure == found.stress, pressure_of_mode(a, b, lambda) > 1e-6) << k;
    EXPECT_TRUE(!change || lambda < 0.012 || lambda > *change - 0.003) << k;
  }
  EXPECT_GE(singular, 60);
}

TEST(Williams, ModesOfAKinkSatisfyTheConditionsOnBothFaces) {
  for (const double turn : {2.0, 28.07, 53.13, 90.0, 150.0})
    for (const double stiffness : {1.0, 10.0})
      for (const Face bisector : {Face::symmetric, Face::antisymmetric}) {
        const Wedge a = wedge_of(180 + turn, Face::free, stiffness, 0.2), b = wedge_of(180 - turn);
        const Complex lambda = kink_exponents(a, b, bisector).pressure;
        ASSERT_LT(lambda.real(), 1);
        EXPECT_EQ(lambda.imag(), 0);
        EXPECT_LE(residual(kink_conditions(a, b, lambda.real())), 1e-11) << turn;
        EXPECT_LE(kink_exponents(a, b).stress.real(), lambda.real() + 1e-9);
      }
  EXPECT_EQ(kink_exponents(wedge_of(180), wedge_of(180)).stress, 1.0);
}

// ---- Fans of several bodies ----

// Wedges one after the other from theta = 0 up, each by potentials of its own.
Eigen::MatrixXd fan_conditions(const Fan& fan, double lambda) {
  const Eigen::Index count = Eigen::Index(fan.wedges.size());
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(4 * count, 4 * count);
  Eigen::Index row = 0;
  std::vector<double> begin{0};
  for (const Wedge& w : fan.wedges) begin.push_back(begin.back() + w.angle);
  for (std::size_t i = 0; i < fan.joints.size(); ++i) {
    const std::size_t next = (i + 1) % fan.wedges.size();
    const Fields a = fields(fan.wedges[i], lambda, begin[i + 1]), b = fields(fan.wedges[next], lambda, begin[next]);
    M.block<1, 4>(row, 4 * i) = a.shear;
    M.block<1, 4>(row + 1, 4 * next) = b.shear;
    M.block<1, 4>(row + 2, 4 * i) = a.normal;
    M.block<1, 4>(row + 2, 4 * next) = -b.normal;
    M.block<1, 4>(row + 3, 4 * i) = a.ut;
    M.block<1, 4>(row + 3, 4 * next) = -b.ut;
    row += 4;
  }
  if (row == 4 * count) return M;
  Wedge first = fan.wedges.front(), last = fan.wedges.back();
  first.outer = fan.first;
  last.outer = fan.last;
  M.block<2, 4>(row, 0) = held(first, lambda, 0);
  M.block<2, 4>(row + 2, 4 * count - 4) = held(last, lambda, begin[count]);
  return M;
}

// How near the conditions are to a mode, and its pressure on a joint.
std::pair<double, double> mode_of(const Fan& fan, double lambda, std::size_t joint) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(fan_conditions(fan, lambda), Eigen::ComputeFullV);
  const Eigen::Index last = svd.singularValues().size() - 1;
  double angle = 0;
  for (std::size_t i = 0; i <= joint; ++i) angle += fan.wedges[i].angle;
  const Fields at = fields(fan.wedges[joint], lambda, angle);
  return {svd.singularValues()(last) / svd.singularValues()(0),
          std::abs(at.normal * svd.matrixV().col(last).segment(4 * joint, 4))};
}

Fan random_fan(std::mt19937& random, int count, bool closed) {
  Fan fan{{}, std::vector<Joint>(count - (closed ? 0 : 1), Joint::sliding)};
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += fan.wedges.emplace_back(random_wedge(random, 150)).angle;
  const double all = 2 * pi * (closed ? 1 : std::uniform_real_distribution(0.4, 1.0)(random));
  for (Wedge& w : fan.wedges) w.angle *= all / sum;
  fan.first = fan.wedges.front().outer;
  fan.last = fan.wedges.back().outer;
  return fan;
}

// Whether there is a real one: a mode in potentials, with the pressure on the joint that is told. None is smaller, as
// their determinant does not change its sign below.
bool has_the_mode_of(const Fan& fan, std::size_t joint, const TipExponents& found) {
  const bool real = found.stress.imag() == 0 && found.stress.real() < 1;
  if (real) {
    const auto [residual, pressure] = mode_of(fan, found.stress.real(), joint);
    EXPECT_LE(residual, 1e-9);
    EXPECT_EQ(found.pressure == found.stress, pressure > 1e-5);
  }
  const auto sign = [&](double lambda) { return fan_conditions(fan, lambda).determinant() > 0; };
  for (double lambda = 0.012; lambda < found.stress.real() - 0.004; lambda += 0.002)
    EXPECT_EQ(sign(lambda), sign(lambda - 0.002)) << lambda;
  return real;
}

TEST(Williams, ModesOfSeveralBodiesSatisfyTheConditionsOfAllJoints) {
  std::mt19937 random(11);
  int singular = 0, smaller = 0;
  for (int k = 0; k < 60; ++k) {
    const Fan fan = random_fan(random, 3 + k % 2, k % 4 < 2);
    const std::size_t joint = random() % fan.joints.size();
    SCOPED_TRACE(k);
    const TipExponents found = exponents(fan, joint);
    singular += has_the_mode_of(fan, joint, found);
    const Fan two{{fan.wedges[0], fan.wedges[1]}, {Joint::sliding}, fan.first};
    smaller += exponents(two, 0).stress != found.stress;
  }
  EXPECT_GE(singular, 30);
  EXPECT_GE(smaller, 30);
}

// ---- Bodies with directions ----

ElasticLaw random_law(std::mt19937& random) {
  const auto power = [&] { return std::exp(std::uniform_real_distribution(-1.5, 1.5)(random)); };
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  const OrthotropicModuli m{power(),         power(),         power(), uniform(-0.1, 0.3),
                            uniform(0, 0.2), uniform(0, 0.2), power(), uniform(-2, 2)};
  const auto stiffness = orthotropic_stiffness(m);
  return stiffness ? elastic_law(*stiffness, {Plane::strain}, m.e1) : random_law(random);
}

// Fans whose bodies have directions, all or some, sliding and bonded, from one direction of the first face.
Fan random_directional_fan(std::mt19937& random, int count, bool closed) {
  Fan fan = random_fan(random, count, closed);
  double begin = 0;
  for (Wedge& w : fan.wedges) {
    if (&w == &fan.wedges[0] || random() % 3 > 0) w = wedge(w.angle, random_law(random), w.outer, begin);
    begin += w.angle;
  }
  return fan;
}

TEST(Directional, ModesSatisfyTheConditionsOfAllJointsInLekhnitskiisFunctions) {
  std::mt19937 random(5);
  int singular = 0;
  for (int k = 0; k < 80; ++k) {
    const Fan fan = random_directional_fan(random, 2 + k % 3, k % 4 < 2);
    const std::size_t joint = random() % fan.joints.size();
    SCOPED_TRACE(k);
    singular += has_the_mode_of(fan, joint, exponents(fan, joint));
  }
  EXPECT_GE(singular, 50);
}

// All bodies turned with their materials, and seen in a mirror.
TEST(Directional, ExponentsTurnWithTheBodies) {
  std::mt19937 random(6);
  for (int k = 0; k < 40; ++k) {
    Fan here{{}, {k % 2 ? Joint::sliding : Joint::bonded}, Face::free, Face(k % 4)}, there = here, mirror;
    const double turn = std::uniform_real_distribution(-4.0, 4.0)(random);
    double begin = 0.3;
    for (int i = 0; i < 2; ++i) {
      const double angle = std::uniform_real_distribution(0.6, 3.0)(random), axis = 0.7 * i + 0.2;
      const OrthotropicModuli moduli{1, 5, 2, 0.1, 0.1, 0.1, 0.7};
      const auto law = [&](double of_axis) {
        OrthotropicModuli turned = moduli;
        turned.angle = of_axis;
        return elastic_law(*orthotropic_stiffness(turned), {Plane::strain}, 1);
      };
      here.wedges.push_back(wedge(angle, law(axis), Face::free, begin));
      there.wedges.push_back(wedge(angle, law(axis + turn), Face::free, begin + turn));
      mirror.wedges.insert(mirror.wedges.begin(), wedge(angle, law(-axis), Face::free, -begin - angle));
      begin += angle;
    }
    mirror.joints = here.joints;
    mirror.first = here.last;
    mirror.last = here.first;
    EXPECT_NEAR(std::abs(exponents(here).stress - exponents(there).stress), 0, 1e-9) << k;
    EXPECT_NEAR(std::abs(exponents(here).stress - exponents(mirror).stress), 0, 1e-9) << k;
  }
}

TEST(Directional, CracksAndHalfPlanesAreThoseOfAnyMaterial) {
  std::mt19937 random(7);
  for (int k = 0; k < 20; ++k) {
    const ElasticLaw law = random_law(random);
    const double first = std::uniform_real_distribution(-3.0, 3.0)(random);
    const auto of = [&](double angle, double from) { return wedge(angle, law, Face::free, from); };
    EXPECT_NEAR(std::abs(wedge_exponent(of(2 * pi, first), Face::free) - 0.5), 0, 1e-7) << k;
    EXPECT_EQ(wedge_exponent(of(pi, first), Face::free), 1.0) << k;
    EXPECT_EQ(bonded_exponent_inside({of(2, first), of(2 * pi - 2, first + 2)}), 1.0) << k;
    const Wedge rigid = wedge_of(90, Face::free, 1e9);
    EXPECT_NEAR(end_exponents(rigid, of(pi, first)).pressure.real(), 0.5, 1e-7) << k;
  }
}

// A body on two that are each other's image: the modes of one half beside its bisector, of one kind or the other.
TEST(Williams, ABodyOnTwoOfAKindHasTheModesOfItsHalves) {
  for (const double stiffness : {0.1, 1.0, 20.0})
    for (const double degrees : {60.0, 90.0, 120.0}) {
      const Wedge block = wedge_of(degrees, Face::free, stiffness), base = wedge_of(180);
      const auto beside = [&](Face middle) { return end_exponents(block, wedge_of(90, middle)); };
      const Fan open{{block, base, block}, {Joint::sliding, Joint::sliding}};
      const TipExponents found = exponents(open, 0), same = exponents(open, 1);
      const double modes[] = {beside(Face::symmetric).pressure.real(), beside(Face::antisymmetric).pressure.real()};
      EXPECT_NEAR(found.pressure.real(), std::min(modes[0], modes[1]), 1e-7);
      EXPECT_NEAR(std::abs(found.pressure - same.pressure), 0, 1e-9);
    }
}

}  // namespace
}  // namespace mortise
