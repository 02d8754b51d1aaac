// Shape functions of the multipliers on one edge.
#pragma once

#include <span>

#include "contact/segments.hpp"
#include "model/choices.hpp"

namespace mortise {

/// psi(xi) = A N(xi), N the Lagrange functions of start, end (and middle): the identity for standard
/// spaces, biorthogonal to N for dual ones.
struct EdgeMultipliers {
  int count;  ///< 2 (start, end) or 3 (and middle)
  Eigen::Matrix3d A = Eigen::Matrix3d::Identity();

  Eigen::Vector3d shape(double xi) const;
};

/// Dual functions are made biorthogonal over the contact points of the edge, so that they stay so where only part of
/// it faces the other side (Cichosz & Bischoff 2011): A = diag(int N) (int N N^T)^-1, docs/theory.md eq. 12.
/// `points` are the contact points of this edge.
EdgeMultipliers edge_multipliers(const Edge& edge, Multipliers space, std::span<const ContactPoint> points);

}  // namespace mortise
