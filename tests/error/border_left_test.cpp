// p* where contact ends, on half planes: bodies that are exact, so that all of its error is the line's.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>
#include <random>

#include "error/fitted_pressure.hpp"
#include "error/pressure_line.hpp"

namespace mortise::test {
namespace {

using Long = long double;
using LongX = Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>;

// Vertices over -1.15 .. 1.5 either way, uneven, on two of three meshes finer towards both borders of contact.
VecX vertices(std::mt19937& draw) {
  const auto any = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(draw); };
  const int edges = std::uniform_int_distribution(20, 80)(draw);
  const bool graded = std::uniform_int_distribution(0, 2)(draw) > 0;
  const double left = any(1.15, 1.5), right = any(1.15, 1.5), least = std::pow(10, any(-1.7, -0.5)),
               growth = any(0.2, 0.6);
  VecX s = VecX::Zero(edges + 1);
  for (int e = 0; e < edges; ++e) {
    const double x = (e + 0.5) / edges * (left + right) - left;
    s(e + 1) = s(e) + any(0.75, 1.25) * (graded ? std::min(1.0, least + growth * std::abs(std::abs(x) - 1)) : 1);
  }
  return (s.array() / s(edges) * (left + right) - left).matrix();
}

// int int phi_i phi_j of the displacement -ln|x - s| / pi: second differences of x^4 (ln|x| - 25/12) / 24 in both
// places.
MatX compliance(const VecX& s) {
  const Eigen::Index count = s.size();
  LongX differences = LongX::Zero(count, count), kernel(count, count);
  for (Eigen::Index e = 0; e + 1 < count; ++e) {
    const Long slope = 1 / (Long(s(e + 1)) - Long(s(e)));
    differences(e, e + 1) += slope;
    differences(e, e) -= slope;
    differences(e + 1, e) += slope;
    differences(e + 1, e + 1) -= slope;
  }
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j) {
      const Long x = std::abs(Long(s(i)) - Long(s(j)));
      kernel(i, j) = x > 0 ? x * x * x * x * (std::log(x) - Long(25) / 12) / 24 : 0;
    }
  return (-differences * kernel * differences / std::numbers::pi_v<Long>).cast<double>();
}

// The moments of 1 and of x^2 / 2 with the hats of the inner vertices.
std::array<VecX, 2> moments(const VecX& s) {
  std::array<VecX, 2> m{VecX::Zero(s.size()), VecX::Zero(s.size())};
  for (Eigen::Index e = 0; e + 1 < s.size(); ++e) {
    const double a = s(e), b = s(e + 1), h = b - a;
    m[0](e) += h / 2;
    m[0](e + 1) += h / 2;
    m[1](e) += h * (3 * a * a + 2 * a * b + b * b) / 24;
    m[1](e + 1) += h * (a * a + 2 * a * b + 3 * b * b) / 24;
  }
  return m;
}

// Of a parabola that is pressed on with the force pi / 2: p = sqrt(1 - x^2), as hats have it. Empty if the rows that
// are closed do not settle.
VecX pressed(const VecX& s) {
  const MatX of_p = compliance(s);
  const auto [m0, m2] = moments(s);
  std::vector<char> closed(s.size(), 0);
  for (Eigen::Index i = 1; i + 1 < s.size(); ++i) closed[i] = std::abs(s(i)) < 1;
  for (int round = 0; round < 60; ++round) {
    std::vector<Eigen::Index> rows;
    for (Eigen::Index i = 0; i < s.size(); ++i)
      if (closed[i]) rows.push_back(i);
    const Eigen::Index n = Eigen::Index(rows.size());
    MatX A = MatX::Zero(n + 1, n + 1);
    A.topLeftCorner(n, n) = of_p(rows, rows);
    A.topRightCorner(n, 1) = -m0(rows);
    A.bottomLeftCorner(1, n) = m0(rows).transpose();
    VecX b(n + 1);
    b << -m2(rows), std::numbers::pi / 2;
    const VecX x = A.partialPivLu().solve(b);
    VecX p = VecX::Zero(s.size());
    p(rows) = x.head(n);
    const VecX gap = of_p * p + m2 - x(n) * m0;
    bool settled = true, tension = x.head(n).minCoeff() < 0;
    for (Eigen::Index i = 1; i + 1 < s.size(); ++i) {
      const bool change = closed[i] ? p(i) < 0 : !tension && gap(i) < -1e-13;
      if (change) closed[i] = !closed[i], settled = false;
    }
    if (settled) return p;
  }
  return {};
}

PressureLine line_of(const VecX& s, const VecX& p) {
  const Eigen::Index count = s.size();
  PressureLine line;
  line.s = s;
  line.p = p;
  line.h = VecX::Zero(count);
  line.h.head(count - 1) += (s.tail(count - 1) - s.head(count - 1)) / 2;
  line.h.tail(count - 1) += (s.tail(count - 1) - s.head(count - 1)) / 2;
  line.faced.assign(count - 1, 1);
  line.loaded.assign(count, 0);
  for (Eigen::Index i = 1; i + 1 < count; ++i)
    if (p.segment(i - 1, 3).maxCoeff() > 0) line.loaded[i] = 1;
  return line;
}

// int (p* - sqrt(1 - x^2))^2 over half of both edges at vertex i.
double square_at(const PressureForm& form, const VecX& s, Eigen::Index i) {
  constexpr int places = 200;
  double sum = 0;
  for (const Eigen::Index next : {i - 1, i + 1})
    for (int k = 0; k < places; ++k) {
      const double x = s(i) + (s(next) - s(i)) * (k + 0.5) / (2 * places);
      sum += std::pow(form(x) - std::sqrt(std::max(0.0, 1 - x * x)), 2) * std::abs(s(next) - s(i)) / (2 * places);
    }
  return sum;
}

// Beside a border all bodies are half planes, and p is a root: what p* is off by there depends on the edges alone.
TEST(FittedPressure, IsOffAtABorderByHalfOfWhatTheMultiplierMayBe) {
  std::mt19937 draw(61);
  double most = 0, sum = 0;
  int count = 0;
  for (int k = 0; k < 150; ++k) {
    const VecX s = vertices(draw), p = pressed(s);
    if (p.size() == 0) continue;
    const LineError local = line_error(line_of(s, p));
    Eigen::Index first = 0, last = s.size() - 1;
    while (p(first) == 0) ++first;
    while (p(last) == 0) --last;
    if (first < 2 || last > s.size() - 3) continue;
    const PieceEnd border{.power = 0.5, .border = true};
    LoadedPiece piece{.s = s.segment(first - 2, last - first + 5),
                      .p = p.segment(first - 2, last - first + 5),
                      .width = VecX::Ones(last - first + 5),
                      .end = {border, border}};
    const std::array<double, 2> ends{border_place(piece, 0), border_place(piece, 1)};
    std::optional<PressureForm> form;
    for (piece.swing.edges = 10; !form && piece.swing.edges >= 4; piece.swing.edges -= 2)
      form = fit_pressure(piece, ends);
    if (!form) continue;
    for (const auto& [from, to] : {std::pair{first - 1, first + 1}, {last - 1, last + 1}}) {
      double off = 0, told = 0;
      for (Eigen::Index i = from; i <= to; ++i) {
        ASSERT_TRUE(local.border[i]) << k << " " << i;
        off += square_at(*form, s, i);
        told += local.l2(i) * local.l2(i);
      }
      const double part = std::sqrt(off / told);
      EXPECT_LE(part, border_left) << k << " " << s(from);
      most = std::max(most, part);
      sum += part;
      ++count;
    }
  }
  EXPECT_GT(count, 200);
  EXPECT_GT(most, 0.6 * border_left);
  EXPECT_LT(sum / count, 0.4 * border_left);
}

}  // namespace
}  // namespace mortise::test
