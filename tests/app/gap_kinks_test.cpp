// Given gaps with kinks within edges: p has a logarithm there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "app/accuracy.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {
namespace {

struct Kinked {
  std::string gap;
  std::vector<double> kinks;
};

// A gap with kinks at random places of -5 ... 5, as users write them; `along`: what runs so.
Kinked draw_gap(std::mt19937& random, int kind, const std::string& along) {
  std::uniform_real_distribution<double> unit(0, 1);
  const double slope = (unit(random) < 0.5 ? 1 : -1) * std::pow(10, -3.5 + 1.5 * unit(random)),
               x = 3 * unit(random) - 4, y = x + 1.5 + 2 * unit(random);
  std::ostringstream text;
  text.precision(17);
  text << slope << " * ";
  const auto abs_of = [&](double at) { return "abs(" + along + " - (" + std::to_string(at) + "))"; };
  const double first = std::stod(std::to_string(x)), second = std::stod(std::to_string(y));
  switch (kind % 4) {
    case 0:
      text << abs_of(x);
      return {text.str(), {first}};
    case 1:
      text << "max(0, " << along << " - (" << std::to_string(y) << "))";
      return {text.str(), {second}};
    case 2:
      text << "(" << abs_of(x) << " - 0.6 * " << abs_of(y) << ")";
      return {text.str(), {first, second}};
    default:
      text << "(min(" << abs_of(x) << ", 0.5 * " << abs_of(y) << ") + 0.01 * " << along << "^2)";
      const double between = (first + 0.5 * second) / 1.5, beyond = first - (second - first);
      return {text.str(),
              beyond > -5 ? std::vector{beyond, first, between, second} : std::vector{first, between, second}};
  }
}

// Two blocks, 10 wide, pressed by a part of what closes the gap. `cuts`: vertices that both curves have.
Scene blocks(const TemporaryFolder& folder, const std::string& gap, const std::vector<double>& cuts, bool axisymmetric,
             double pressure, double accuracy) {
  const double from = axisymmetric ? 1 : -5;
  std::ostringstream geo, low, up;
  geo.precision(17);
  geo << "Mesh.ElementOrder = 2;\nx0 = " << from << "; Point(1) = {x0, -4, 0}; Point(2) = {x0 + 10, -4, 0}; Point(7) = "
      << "{x0 + 10, 4, 0}; Point(8) = {x0, 4, 0};\n";
  const int pieces = int(cuts.size()) + 1;
  for (const int side : {100, 200})
    for (int i = 0; i <= pieces; ++i) {
      geo << "Point(" << side + i << ") = {"
          << (i == 0        ? from
              : i == pieces ? from + 10
                            : cuts[i - 1] + from + 5)
          << ", 0, 0};\n";
      if (i > 0) geo << "Line(" << side + i << ") = {" << side + i - 1 << ", " << side + i << "};\n";
    }
  geo << "Line(1) = {1, 2}; Line(2) = {2, " << 100 + pieces << "}; Line(4) = {100, 1}; Line(6) = {" << 200 + pieces
      << ", 7}; Line(7) = {7, 8}; Line(8) = {8, 200};\nCurve Loop(1) = {1, 2, ";
  for (int i = pieces; i > 0; --i) geo << -(100 + i) << ", ";
  geo << "4}; Curve Loop(2) = {201 ... " << 200 + pieces << ", 6, 7, 8};\n"
      << "Plane Surface(1) = {1}; Plane Surface(2) = {2}; Physical Surface(\"low\") = {1}; Physical Surface(\"up\") = "
      << "{2};\nPhysical Curve(\"ground\") = {1}; Physical Curve(\"track\") = {101 ... " << 100 + pieces
      << "}; Physical Curve(\"foot\") = {201 ... " << 200 + pieces
      << "};\nPhysical Curve(\"top\") = {7}; Physical Curve(\"left\") = {4, 8};\n";
  folder.write("kinks.geo", geo.str());
  std::ostringstream toml;
  toml.precision(17);
  toml << "mesh.file = \"kinks.geo\"\nmodel.plane = \"" << (axisymmetric ? "axisymmetric" : "strain") << "\"\n"
       << R"(materials.steel = { young = 210e3, poisson = 0.3 }
materials.soft = { young = 70e3, poisson = 0.3 }
bodies = { low = "steel", up = "soft" }
boundary = [{ on = "ground", displacement = { y = 0 } }, { on = "left", displacement = { x = 0 } }, { on = "top", pressure = )"
       << pressure << " }]\ncontact = [{ between = [\"foot\", \"track\"], initial_gap = \"" << gap
       << "\", multipliers_on = \"foot\" }]\naccuracy.value = " << accuracy << "\n";
  return read_scene(folder.write("kinks.toml", toml.str()));
}

// p between the vertices of a line by x.
double at(const PressureEstimate& e, double x) {
  std::vector<std::pair<double, double>> line;
  for (Eigen::Index i = 0; i < e.line.p.size(); ++i)
    line.emplace_back(e.line.position[i].x(), e.fitted.at(e.line.s(i)).value_or(e.line.p(i)));
  std::ranges::sort(line);
  const auto next = std::ranges::lower_bound(line, std::pair{x, 0.0});
  if (next == line.begin() || next == line.end()) return next == line.end() ? line.back().second : next->second;
  const auto before = next - 1;
  const double part = (x - before->first) / (next->first - before->first);
  return before->second + part * (next->second - before->second);
}

// Against a mesh of a quarter of the error, with vertices at the kinks.
TEST(GapKinks, AreWithinTheirBarsAtPlacesThatNoVertexKnows) {
  const TemporaryFolder folder;
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int variant = 0; variant < 5; ++variant) {
    const bool axisymmetric = variant % 4 == 3 || variant == 0;
    const Kinked drawn = draw_gap(random, variant, axisymmetric ? "(x - 6)" : "x");
    const double pressure = 210 * std::pow(10, -1 + unit(random));
    SCOPED_TRACE(drawn.gap + (axisymmetric ? " of rings" : ""));
    const auto found = solve_to_accuracy(blocks(folder, drawn.gap, {}, axisymmetric, pressure, 0.01)),
               fine = solve_to_accuracy(blocks(folder, drawn.gap, drawn.kinks, axisymmetric, pressure, 0.0025));
    ASSERT_TRUE(found && fine);
    EXPECT_TRUE(found->accuracy->reached()) << found->accuracy->reason;
    const PressureEstimate &e = found->estimate->pressures[0], &reference = fine->estimate->pressures[0];
    double square = 0, size = 0;
    int out = 0, count = 0;
    for (Eigen::Index i = 0; i < e.line.p.size(); ++i) {
      if (!e.line.loaded[i] || e.excluded[i]) continue;
      const double x = e.line.position[i].x(), exact = at(reference, x),
                   off = std::abs(e.fitted.at(e.line.s(i)).value_or(e.line.p(i)) - exact);
      square += off * off * e.line.h(i);
      size += exact * exact * e.line.h(i);
      out += off > e.bar(i) + reference.bar(reference.line.nearest(e.line.position[i]));
      ++count;
    }
    EXPECT_LE(std::sqrt(square / size), 0.01 + fine->estimate->pressure());
    EXPECT_LE(out, count / 20) << "of " << count;
  }
}

}  // namespace
}  // namespace mortise::test
