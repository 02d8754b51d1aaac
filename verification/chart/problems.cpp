#include "problems.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "gmsh/load_mesh.hpp"
#include "graded_plates.hpp"
#include "lame.hpp"
#include "support/manufactured.hpp"

namespace mortise::chart {
namespace {

// Takes `key` out of the settings.
std::optional<double> take(std::vector<Override>& settings, const std::string& key) {
  const auto found = std::find_if(settings.begin(), settings.end(), [&](const Override& o) { return o.key == key; });
  if (found == settings.end()) return std::nullopt;
  const double value = std::stod(found->value);
  settings.erase(found);
  return value;
}

double parabola(double x) { return -1.25 * x * x + x + 0.2; }

void make_manufactured(Problem& p) {
  const test::ExactField exact{p.scene.materials.at("elastic").young};
  p.exact = test::Field{[exact](const Vec2& x, int) { return exact.displacement(x); },
                        [exact](const Vec2& x, int) { return exact.stress(x); }};
  p.pressure = [exact](const Vec2& x) {
    const Vec4 s = exact.stress(x);
    const Vec2 n = Vec2(2.5 * x.x() - 1, 1).normalized();
    return -(s(0) * n.x() * n.x() + 2 * s(3) * n.x() * n.y() + s(1) * n.y() * n.y());
  };
}

void make_rings(Problem& p) {
  const Lame lame = lame_of(p.scene, p.mesh);
  p.exact = test::Field{[lame](const Vec2& x, int body) { return lame.displacement(x, body); },
                        [lame](const Vec2& x, int body) { return lame.stress(x, body); }};
  p.pressure = [lame](const Vec2&) { return lame.pressure; };
}

// Reads x,p (a header line, then x increasing); between the points p is linear in x, beyond them constant.
// Throws std::runtime_error if the file cannot be read or x does not increase.
Pressure reference_pressure(const std::string& path) {
  std::ifstream file(path);
  std::string header;
  std::getline(file, header);
  std::vector<double> xs, ps;
  double x = 0, p = 0;
  for (char comma = 0; file >> x >> comma >> p;) {
    if (!xs.empty() && x <= xs.back()) throw std::runtime_error(path + ": x does not increase at " + std::to_string(x));
    xs.push_back(x);
    ps.push_back(p);
  }
  if (header != "x,p" || xs.size() < 2) throw std::runtime_error(path + ": cannot be read; expected a CSV of x,p");
  return [xs = std::move(xs), ps = std::move(ps)](const Vec2& place) {
    const auto above = std::lower_bound(xs.begin(), xs.end(), place.x());
    if (above == xs.begin()) return ps.front();
    if (above == xs.end()) return ps.back();
    const auto i = std::size_t(above - xs.begin());
    const double t = (place.x() - xs[i - 1]) / (xs[i] - xs[i - 1]);
    return (1 - t) * ps[i - 1] + t * ps[i];
  };
}

}  // namespace

Problem make_problem(const std::string& name, std::vector<Override> settings, const std::string& reference) {
  if (name != "manufactured" && name != "rings" && name != "parabola_1")
    throw std::runtime_error("unknown problem '" + name + "'; known: manufactured, rings, parabola_1");
  const std::string folder = name == "manufactured" ? "/verification/chart/" : "/geo/";
  const std::optional<double> grading = take(settings, "chart.grading");
  Problem p;
  p.scene = read_scene(MORTISE_SOURCE_DIR + folder + name + ".toml", settings);
  p.mesh = grading ? graded_plates(parabola, p.scene.mesh_parameters, *grading)
                   : load_mesh(p.scene.mesh_file, p.scene.mesh_parameters);
  if (name == "manufactured") make_manufactured(p);
  if (name == "rings") make_rings(p);
  if (name == "parabola_1" && !reference.empty()) p.pressure = reference_pressure(reference);
  return p;
}

}  // namespace mortise::chart
