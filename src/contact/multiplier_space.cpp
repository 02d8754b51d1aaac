#include "contact/multiplier_space.hpp"

#include <Eigen/LU>

#include "fem/edges.hpp"

namespace mortise {

Eigen::Vector3d EdgeMultipliers::shape(double xi) const {
  const EdgeShape s = edge_shape(count, xi);
  return A * Eigen::Vector3d(s.N[0], s.N[1], s.N[2]);
}

EdgeMultipliers edge_multipliers(const Edge& edge, Multipliers space, std::span<const ContactPoint> points) {
  EdgeMultipliers m{space == Multipliers::linear ? 2 : edge.node_count};
  if (space != Multipliers::dual || points.empty()) return m;

  MatX mass = MatX::Zero(m.count, m.count);
  VecX weight = VecX::Zero(m.count);
  for (const ContactPoint& p : points) {
    const EdgeShape s = edge_shape(m.count, p.xi);
    const Eigen::Map<const VecX> N(s.N.data(), m.count);
    mass += p.dA * N * N.transpose();
    weight += p.dA * N;
  }
  const Eigen::FullPivLU<MatX> lu(mass);
  // A sliver of the edge cannot tell the functions apart: keep the standard ones there.
  if (lu.rcond() > 1e-8) m.A.topLeftCorner(m.count, m.count) = weight.asDiagonal() * lu.inverse();
  return m;
}

}  // namespace mortise
