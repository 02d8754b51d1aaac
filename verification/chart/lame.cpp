#include "lame.hpp"

#include <algorithm>
#include <stdexcept>

namespace mortise::chart {
namespace {

constexpr double r0 = 1, r1 = 2, r2 = 3;

double pressure_on(const Scene& scene, const std::string& curve) {
  double sum = 0;
  for (const BoundarySpec& b : scene.boundaries)
    if (const auto* pressure = std::get_if<mortise::Pressure>(&b.what))
      if (std::find(b.on.begin(), b.on.end(), curve) != b.on.end()) sum += pressure->value.constant();
  return sum;
}

const Material& material_of(const Scene& scene, const std::string& body) {
  for (const BodySpec& b : scene.bodies)
    if (b.name == body) return scene.materials.at(b.material);
  throw std::runtime_error("the scene has no body '" + body + "'");
}

}  // namespace

// Each ring by the pressures inside and outside; the pressure between them is that which closes the gap, linear in it.
Lame lame_of(const Scene& scene, const Mesh& mesh) {
  if (scene.model.plane != Plane::strain || !scene.initial_strains.empty())
    throw std::runtime_error("Lame's solution here is of plane strain without initial strains");
  Lame lame;
  for (const std::string& body : mesh.bodies) {
    const Material& m = material_of(scene, body);
    lame.mu.push_back(m.young / (2 * (1 + m.poisson)));
    lame.lambda.push_back(m.young * m.poisson / ((1 + m.poisson) * (1 - 2 * m.poisson)));
  }
  lame.A.resize(2);
  lame.B.resize(2);
  const auto inner = std::size_t(body_index(mesh, "inner")), outer = std::size_t(body_index(mesh, "outer"));
  const double bore = pressure_on(scene, "inner_bore"), rim = pressure_on(scene, "outer_rim");
  const auto load = [&](std::size_t i, double a, double b, double inside, double outside) {
    lame.A[i] = (inside * a * a - outside * b * b) / (2 * (lame.lambda[i] + lame.mu[i]) * (b * b - a * a));
    lame.B[i] = (inside - outside) * a * a * b * b / (2 * lame.mu[i] * (b * b - a * a));
    return lame.A[i] * r1 + lame.B[i] / r1;  // u_r at the contact
  };
  const auto gap = [&](double p) { return load(outer, r1, r2, p, rim) - load(inner, r0, r1, bore, p); };
  const double some = lame.mu[inner], open = gap(0);
  lame.pressure = -open * some / (gap(some) - open);
  gap(lame.pressure);
  return lame;
}

Vec2 Lame::displacement(const Vec2& x, int body) const { return (A[body] + B[body] / x.squaredNorm()) * x; }

Vec4 Lame::stress(const Vec2& x, int body) const {
  const auto i = std::size_t(body);
  const double r2 = x.squaredNorm(), mean = 2 * (lambda[i] + mu[i]) * A[i], half = 2 * mu[i] * B[i] / r2;
  const double c = (x.x() * x.x() - x.y() * x.y()) / r2, s = 2 * x.x() * x.y() / r2;  // of twice the angle
  return {mean - half * c, mean + half * c, 2 * lambda[i] * A[i], -half * s};
}

}  // namespace mortise::chart
