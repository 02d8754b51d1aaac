// p* against pressures that are known, on vertices drawn at random.
#include "error/pressure_form.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <functional>
#include <numbers>
#include <random>
#include <sstream>

#include "app/accuracy.hpp"
#include "app/solve_scene.hpp"
#include "error/fitted_pressure.hpp"
#include "fem/quadrature.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

using Pressure = std::function<double(double)>;

// Uneven vertices between two places.
VecX vertices(double from, double to, int edges, std::mt19937& draw) {
  std::uniform_real_distribution<double> part(0.7, 1.4);
  VecX s = VecX::Zero(edges + 1);
  for (int i = 1; i <= edges; ++i) s(i) = s(i - 1) + part(draw);
  return (from + (to - from) / s(edges) * s.array()).matrix();
}

// int p phi_i width ds from one place to another, p smooth but for powers at these.
VecX moments(const VecX& s, const VecX& width, double from, double to, const Pressure& p) {
  const LineRule rule = gauss_legendre(60);
  VecX sums = VecX::Zero(s.size());
  for (int e = 0; e + 1 < s.size(); ++e) {
    const double a = std::max(s(e), from), b = std::min(s(e + 1), to);
    for (std::size_t q = 0; a < b && q < rule.points.size(); ++q) {
      const double t = (1 + rule.points[q]) / 2, graded = t * t * t * (10 + t * (6 * t - 15));  // towards both ends
      const double x = a + (b - a) * graded, z = (x - s(e)) / (s(e + 1) - s(e));
      const double weight = (b - a) * 30 * t * t * (1 - t) * (1 - t) * rule.weights[q] / 2 * p(x) *
                            ((1 - z) * width(e) + z * width(e + 1));
      sums(e) += weight * (1 - z);
      sums(e + 1) += weight * z;
    }
  }
  return sums;
}

MatX mass(const VecX& s, const VecX& width) {
  MatX columns(s.size(), s.size());
  for (int j = 0; j < s.size(); ++j)
    columns.col(j) = moments(s, width, s(0), s(s.size() - 1), [&](double x) {
      double hat = 0;
      if (j > 0 && x <= s(j) && x >= s(j - 1)) hat = (x - s(j - 1)) / (s(j) - s(j - 1));
      if (j + 1 < s.size() && x >= s(j) && x <= s(j + 1)) hat = (s(j + 1) - x) / (s(j + 1) - s(j));
      return hat;
    });
  return columns;
}

TEST(PressureForm, HasThePressureWhoseMomentsTheMultiplierHas) {
  // A power at each end times a cubic is in its space: found to round-off, in rings too.
  std::mt19937 draw(35);
  std::uniform_real_distribution<double> power(-0.3, 0.4), part(0, 1);
  for (int k = 0; k < 40; ++k) {
    const VecX s = vertices(1, 3, 6 + k, draw);
    const VecX width = k % 2 == 0 ? VecX::Ones(s.size()) : s;
    const double a = power(draw), b = k % 3 == 0 ? 0 : power(draw), c = part(draw), d = part(draw);
    const Pressure p = [&](double x) {
      const double r = x - 1, q = 3 - x;
      return std::pow(r, a) * (b == 0 ? 1 : std::pow(q, b)) * (1 + c * r * r + d * r * r * r);
    };
    const VecX of_p = moments(s, width, 1, 3, p);
    const LoadedPiece piece{
        .s = s, .p = mass(s, width).fullPivLu().solve(of_p), .width = width, .end = {{{.power = a}, {.power = b}}}};
    const auto form = fit_pressure(piece, {1, 3});
    ASSERT_TRUE(form) << k;
    for (double x = 1.01; x < 3; x += 0.03) EXPECT_NEAR((*form)(x), p(x), 1e-6 * p(x)) << k << " " << a << " " << b;
  }
}

// Whatever the multiplier: where p* has not all its moments it still has its force and its moment.
TEST(PressureForm, HasTheForceAndTheMomentOfTheMultiplier) {
  std::mt19937 draw(41);
  std::uniform_real_distribution<double> power(-0.3, 0.5), part(0.5, 1.5);
  for (int k = 0; k < 40; ++k) {
    const VecX s = vertices(1, 3, 12 + k, draw), p = VecX::NullaryExpr(s.size(), [&] { return part(draw); }),
               width = k % 2 == 0 ? VecX::Ones(s.size()) : s;
    const std::array<PieceEnd, 2> ends{{{.power = power(draw)}, {.power = 0.5, .border = true}}};
    const LoadedPiece piece{.s = s, .p = p, .width = width, .end = ends, .swing = {.edges = 3 + k % 8}};
    const auto form = fit_pressure(piece, {1, 3});
    ASSERT_TRUE(form) << k;
    const VecX left = mass(s, width) * p - moments(s, width, 1, 3, *form);
    EXPECT_GT(largest_entry(left), 1e-4) << k;
    EXPECT_NEAR(left.sum(), 0, 1e-6) << k;
    EXPECT_NEAR(left.dot(s), 0, 1e-6) << k;
  }
}

// Whatever the multiplier and the ends: p* does not know in which direction s runs.
TEST(PressureForm, MirrorsAsItsMultiplierDoes) {
  std::mt19937 draw(47);
  std::uniform_real_distribution<double> power(-0.3, 0.5), part(0.5, 1.5);
  const auto an_end = [&] {
    const int kind = int(draw() % 3);
    return kind == 0   ? PieceEnd{}
           : kind == 1 ? PieceEnd{.power = 0.5, .border = true}
                       : PieceEnd{.power = power(draw), .tip = draw() % 2 == 0};
  };
  for (int k = 0; k < 100; ++k) {
    const VecX s = vertices(1, 3, 12 + k, draw), p = VecX::NullaryExpr(s.size(), [&] { return part(draw); }),
               width = k % 2 == 0 ? VecX::Ones(s.size()) : s;
    const Swing swing{.edges = 3 + k % 8, .part = k % 3 == 0 ? 0.1 : 0};
    const LoadedPiece piece{.s = s, .p = p, .width = width, .end = {an_end(), an_end()}, .swing = swing};
    const LoadedPiece mirrored{.s = 4 - s.reverse().array(),
                               .p = p.reverse(),
                               .width = width.reverse(),
                               .end = {piece.end[1], piece.end[0]},
                               .swing = swing};
    const auto form = fit_pressure(piece, {1, 3}), other = fit_pressure(mirrored, {1, 3});
    ASSERT_TRUE(form && other) << k;
    for (double x = 1.01; x < 3; x += 0.03) EXPECT_NEAR((*form)(x), (*other)(4 - x), 1e-7) << k << " at " << x;
  }
}

// Whatever pieces came before: other vertices, widths, ends, swings, places of the ends, and pressures.
TEST(PressureFits, AreThoseOfEachPieceAlone) {
  std::mt19937 draw(43);
  std::uniform_real_distribution<double> part(0.5, 1.5);
  const VecX even = vertices(1, 3, 16, draw), uneven = vertices(1, 3, 16, draw);
  const LoadedPiece first{.s = even, .p = {}, .width = VecX::Ones(even.size()), .end = {{{.power = 0.2}, {}}}};
  std::vector<LoadedPiece> pieces(7, first);
  pieces[1].s = uneven;
  pieces[2].width = even;
  pieces[3].end[1] = {.power = 0.5};
  pieces[4].end[1] = {.power = 0, .tip = true};
  pieces[4].swing = {.edges = 4};
  pieces[5] = pieces[4];
  pieces[5].swing = {.edges = 6};
  PressureFits fits;
  for (int load = 0; load < 40; ++load) {
    fits.begin();
    for (int asked = 0; asked < 4; ++asked) {
      const std::size_t k = draw() % pieces.size();
      LoadedPiece piece = pieces[k];
      piece.p = VecX::NullaryExpr(piece.s.size(), [&] { return part(draw); });
      const std::array<double, 2> ends{k == 6 ? 1.01 : 1, 3};
      const auto form = fits.fit(piece, ends), alone = fit_pressure(piece, ends);
      ASSERT_TRUE(form && alone) << k;
      for (double x = 1.02; x < 3; x += 0.1) EXPECT_EQ((*form)(x), (*alone)(x)) << load << " " << k;
    }
  }
}

TEST(PressureForm, HasNoSlopeOnAnAxis) {
  // p = sqrt(1 - r^2) (1 + r^2 / 3) of rings: the moment of the vertex on the axis is none, its p all the same there.
  std::mt19937 draw(37);
  for (int edges = 8; edges < 40; edges += 3) {
    const VecX s = vertices(0, 1, edges, draw);
    const VecX of_p = moments(s, s, 0, 1, [](double r) { return std::sqrt(1 - r * r) * (1 + r * r / 3); });
    LoadedPiece piece{
        .s = s, .p = mass(s, s).fullPivLu().solve(of_p), .width = s, .end = {{{.even = true}, {.power = 0.5}}}};
    const auto form = fit_pressure(piece, {0, 1});
    ASSERT_TRUE(form) << edges;
    EXPECT_NEAR((*form)(0), 1, 30 * std::pow(edges, -4)) << edges;
    EXPECT_NEAR((*form)(1e-7), (*form)(0), 1e-10) << edges;
  }
}

// p_h at the tip of a crack that slides: off by as much as it is large itself over the last edges, however short.
TEST(PressureForm, IsSmoothBesideATipHoweverThePressureSwings) {
  std::mt19937 draw(39);
  std::uniform_real_distribution<double> part(-1, 1);
  for (int k = 0; k < 20; ++k) {
    const Eigen::Index count = 40;
    VecX s(count), p(count);
    for (Eigen::Index i = 0; i < count; ++i) s(i) = 1 - std::pow(0.7, double(i));  // the last edge is 1e-6 long
    s(count - 1) = 1;
    const Pressure exact = [](double x) { return 1 + x - 0.3 * x * x; };
    for (Eigen::Index i = 0; i < count; ++i)
      p(i) = exact(s(i)) * (1 + part(draw) * std::exp2(-std::max(0.0, double(count - 3 - i))));
    const auto form = fit_pressure(
        {.s = s, .p = p, .width = VecX::Ones(count), .end = {{{}, {.tip = true}}}, .swing = {.edges = 4, .part = 0.25}},
        {0, 1});
    ASSERT_TRUE(form) << k;
    EXPECT_NEAR((*form)(1), exact(1), 2e-3) << k;
    EXPECT_GT(largest_entry(p - s.unaryExpr(exact)), 0.1) << k;
  }
}

TEST(PressureForm, OfEveryOtherVertexHasTheMomentsOfItsHats) {
  std::mt19937 draw(48);
  for (int k = 0; k < 40; ++k) {
    const VecX s = vertices(1, 3, 6 + k, draw), p = VecX::Random(s.size()),
               width = k % 2 == 0 ? VecX::Ones(s.size()) : s;
    const LoadedPiece coarse = every_other({.s = s, .p = p, .width = width, .end = {}});
    const Eigen::Index edges = s.size() - 1, last = coarse.s.size() - 1;
    ASSERT_EQ(last, edges % 2 == 0 ? edges / 2 : edges / 4 * 2 + 1);
    for (Eigen::Index i = 0; 2 * i < last; ++i) {
      EXPECT_EQ(coarse.s(i), s(2 * i));
      EXPECT_EQ(coarse.s(last - i), s(edges - 2 * i));
    }
    const VecX all = mass(s, width) * p;
    for (Eigen::Index i = 0; i < coarse.s.size(); ++i) {
      double moment = 0;  // a hat of the coarse vertices is a sum of hats of the fine ones, by its values there
      for (Eigen::Index j = 0; j < s.size(); ++j) {
        const double before = i > 0 ? (s(j) - coarse.s(i - 1)) / (coarse.s(i) - coarse.s(i - 1)) : 1,
                     after = i + 1 < coarse.s.size() ? (coarse.s(i + 1) - s(j)) / (coarse.s(i + 1) - coarse.s(i)) : 1;
        moment += std::max(0.0, std::min(before, after)) * all(j);
      }
      EXPECT_NEAR(coarse.moments(i), moment, 1e-12) << k << " " << i;
    }
  }
}

// Sphere on a block, exact (Hertz): p* of meshes drawn at random is nearer than the multiplier, on the axis too.
TEST(FittedPressure, OfHertzsSphereIsNearerThanTheMultiplier) {
  std::mt19937 draw(38);
  const double E_star = 210e9 / (2 * (1 - 0.09)), force = std::numbers::pi * 48970.7517;
  const double a = std::cbrt(3 * force / (4 * E_star)), p0 = 3 * force / (2 * std::numbers::pi * a * a);
  double all = 0, all_h = 0;
  for (int k = 0; k < 4; ++k) {
    const int edges = std::uniform_int_distribution(18, 40)(draw);
    Scene scene = read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/hertz_sphere.toml");
    scene.mesh_parameters["n_upper"] = edges;
    scene.mesh_parameters["n_lower"] = edges + edges / 4;
    Results r = solve_scene(scene);
    estimate(r);
    double off = 0, off_h = 0;
    for (const ContactNode& node : r.recovery.contacts[0].multiplier.nodes) {
      if (node.p_multiplier == 0) continue;
      const double exact = p0 * std::sqrt(std::max(0.0, 1 - std::pow(node.position.x() / a, 2)));
      off += std::pow(node.p - exact, 2);
      off_h += std::pow(node.p_multiplier - exact, 2);
      EXPECT_LE(std::abs(node.p - exact), node.p_error) << edges << " " << node.position.x();
      if (node.position.x() == 0) EXPECT_NEAR(node.p, exact, 1.5e-3 * exact) << edges;
    }
    EXPECT_LT(off, off_h / 1.5) << edges;
    const PressureEstimate& e = r.estimate->pressures[0];
    const LineError of_multiplier = line_error(e.line);
    for (Eigen::Index i = 0; i < e.line.p.size(); ++i) {
      if (!e.line.loaded[i] || e.line.p(i) == 0) continue;
      if (of_multiplier.border[i])  // where contact ends is known no better
        EXPECT_NEAR(e.local.l2(i), of_multiplier.l2(i), 1e-9 * of_multiplier.l2(i)) << edges << " " << i;
      else
        EXPECT_LT(e.local.l2(i), 0.9 * of_multiplier.l2(i)) << edges << " " << i;
    }
    all += off;
    all_h += off_h;
  }
  EXPECT_LT(std::sqrt(all), std::sqrt(all_h) / 3);
}

// Bars so wide that they hold anything: p* that would swing by more than the multiplier's noise is none.
TEST(FittedPressure, IsNoneWhereItWouldSwingMoreThanTheMultiplier) {
  Scene scene = read_scene(std::string(MORTISE_SOURCE_DIR) + "/geo/hertz_sphere.toml");
  scene.mesh_parameters["n_upper"] = 80;
  scene.mesh_parameters["n_lower"] = 100;
  Results r = solve_scene(scene);
  estimate(r);
  const PressureEstimate smooth = r.estimate->pressures[0];
  const FittedPiece& fitted = smooth.fitted.pieces.at(0);
  std::mt19937 draw(39);
  int taken = 0, left = 0;
  for (int k = 0; k < 40; ++k) {
    const double size = std::pow(10, std::uniform_real_distribution(-5., 0.)(draw)) * smooth.line.p.maxCoeff();
    PressureEstimate e = smooth;
    for (Eigen::Index i = 0; i < e.line.p.size(); ++i) {
      if (e.line.p(i) > 0) e.line.p(i) += size * std::normal_distribution()(draw);
      e.local.raise(i, e.line.p.maxCoeff());
    }
    PressureFits fits;
    find_fitted_pressure(r.problem, r.problem.pairs[0], fits, e);
    double off = 0, off_h = 0;
    for (Eigen::Index i = 0; i < e.line.p.size(); ++i) {
      if (!(e.line.p(i) > 0) || e.local.border[i]) continue;
      const double exact = fitted.form(e.line.s(i));
      const double p = e.fitted.pieces.empty() ? e.line.p(i) : e.fitted.pieces[0].form(e.line.s(i));
      off += std::pow(p - exact, 2);
      off_h += std::pow(e.line.p(i) - exact, 2);
    }
    EXPECT_LE(off, 2 * off_h) << size;
    (e.fitted.pieces.empty() ? left : taken)++;
  }
  EXPECT_GT(taken, 10);
  EXPECT_GT(left, 10);
}

// A bush in pieces in a housing that is too tight by 0.01: its joints are closed, so that p is the same all round
// (Lame), though each pair's own two bodies would make it grow without limit at a joint.
TEST(FittedPressure, IsSmoothWhereAThirdBodyClosesTheCorner) {
  std::mt19937 random(40);
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int n = 2; n <= 5; ++n) {
    const TemporaryFolder folder;
    std::ostringstream geo, scene;
    geo << "n = " << n << "; t = " << draw(1, 6) << "; from = " << draw(0, 1) << ";\n"
        << R"(Mesh.ElementOrder = 2; Mesh.MeshSizeMax = 4;
Point(1) = {0, 0, 0};
For k In {0 : n - 1}
  o = 100 + 20 * k;
  For j In {0 : 2}
    a = from + 2 * Pi * (k + j / 2) / n;
    Point(o + j) = {22 * Cos(a), 22 * Sin(a), 0}; Point(o + 5 + j) = {(22 - t) * Cos(a), (22 - t) * Sin(a), 0};
  EndFor
  Circle(o + 1) = {o, 1, o + 1}; Circle(o + 2) = {o + 1, 1, o + 2};
  Circle(o + 3) = {o + 7, 1, o + 6}; Circle(o + 4) = {o + 6, 1, o + 5};
  Line(o + 5) = {o + 5, o}; Line(o + 6) = {o + 2, o + 7};
  Curve Loop(o) = {o + 1, o + 2, o + 6, o + 3, o + 4, o + 5}; Plane Surface(o) = {o};
  Physical Surface(Sprintf("piece_%g", k)) = {o}; Physical Curve(Sprintf("back_%g", k)) = {o + 1, o + 2};
  Physical Curve(Sprintf("start_%g", k)) = {o + 5}; Physical Curve(Sprintf("end_%g", k)) = {o + 6};
EndFor
For j In {0 : 3}
  Point(10 + j) = {22 * Cos(Pi * j / 2), 22 * Sin(Pi * j / 2), 0}; Point(20 + j) = {34 * Cos(Pi * j / 2), 34 * Sin(Pi * j / 2), 0};
EndFor
For j In {0 : 3}
  Circle(10 + j) = {10 + j, 1, 10 + (j + 1) % 4}; Circle(20 + j) = {20 + j, 1, 20 + (j + 1) % 4};
EndFor
Curve Loop(1) = {20 : 23}; Curve Loop(2) = {10 : 13}; Plane Surface(1) = {1, 2};
Physical Surface("housing") = {1}; Physical Curve("bore") = {10 : 13}; Physical Curve("rim") = {20 : 23};
)";
    folder.write("a.geo", geo.str());
    scene
        << "mesh.file = \"a.geo\"\nmaterials.steel = { young = 210e3, poisson = 0.3 }\nbodies = { \"*\" = \"steel\" }\n"
        << "boundary = [{ on = \"rim\", displacement = { x = 0, y = 0 } }]\naccuracy.value = 0.01\ncontact = [\n";
    for (int k = 0; k < n; ++k)
      scene << "{ between = [\"back_" << k << "\", \"bore\"], clearance = -0.01 },\n{ between = [\"end_" << k
            << "\", \"start_" << (k + 1) % n << "\"], initial_gap = \"closed\" },\n";
    scene << "]\n";
    const Results r = *solve_to_accuracy(read_scene(folder.write("a.toml", scene.str())));
    EXPECT_TRUE(r.accuracy->reached()) << n;
    double p_max = 0, p_min = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < r.recovery.contacts.size(); k += 2)
      for (const ContactNode& node : r.recovery.contacts[k].multiplier.nodes) {
        p_max = std::max(p_max, node.p);
        p_min = std::min(p_min, node.p);
      }
    EXPECT_LE(p_max, 1.01 * p_min) << n;
  }
}

}  // namespace
}  // namespace mortise::test
