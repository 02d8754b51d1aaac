#include "lame.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <stdexcept>

namespace mortise::chart {
namespace {

constexpr double r0 = 1, r1 = 2, r2 = 3;

double pressure_on(const Scene& scene, const std::string& curve) {
  double sum = 0;
  for (const BoundarySpec& b : scene.boundaries)
    if (b.pressure && std::find(b.on.begin(), b.on.end(), curve) != b.on.end()) sum += *b.pressure;
  return sum;
}

const Material& material_of(const Scene& scene, const std::string& body) {
  for (const BodySpec& b : scene.bodies)
    if (b.name == body) return scene.materials.at(b.material);
  throw std::runtime_error("the scene has no body '" + body + "'");
}

}  // namespace

// sigma_r = 2 (lambda + mu) A - 2 mu B / r^2: given at the bore and the rim, equal on both sides of the contact, where
// u_r is equal too. Four equations, divided by the inner ring's mu.
Lame lame_of(const Scene& scene, const Mesh& mesh) {
  if (scene.plane != Plane::strain || !scene.initial_strains.empty())
    throw std::runtime_error("Lame's solution here is of plane strain without initial strains");
  Lame lame;
  for (const std::string& body : mesh.bodies) {
    const Material& m = material_of(scene, body);
    lame.mu.push_back(m.young / (2 * (1 + m.poisson)));
    lame.lambda.push_back(m.young * m.poisson / ((1 + m.poisson) * (1 - 2 * m.poisson)));
  }
  const auto inner = std::size_t(body_index(mesh, "inner")), outer = std::size_t(body_index(mesh, "outer"));
  const double scale = lame.mu[inner];
  const auto a = [&](std::size_t b) { return 2 * (lame.lambda[b] + lame.mu[b]) / scale; };
  const auto b = [&](std::size_t body, double r) { return -2 * lame.mu[body] / (r * r) / scale; };
  Eigen::Matrix4d M;
  M << a(inner), b(inner, r0), 0, 0,                     //
      a(inner), b(inner, r1), -a(outer), -b(outer, r1),  //
      r1, 1 / r1, -r1, -1 / r1,                          //
      0, 0, a(outer), b(outer, r2);
  const Eigen::Vector4d right(-pressure_on(scene, "inner_bore") / scale, 0, 0,
                              -pressure_on(scene, "outer_rim") / scale);
  const Eigen::Vector4d x = M.partialPivLu().solve(right);
  lame.A.resize(2);
  lame.B.resize(2);
  lame.A[inner] = x(0);
  lame.B[inner] = x(1);
  lame.A[outer] = x(2);
  lame.B[outer] = x(3);
  lame.pressure = -scale * (a(inner) * x(0) + b(inner, r1) * x(1));
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
