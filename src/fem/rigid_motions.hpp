// Motions of whole bodies: which of them nothing resists.
#pragma once

#include "fem/constraints.hpp"
#include "mesh/body_points.hpp"

namespace mortise {

/// A small motion of a body as a whole.
struct RigidMotion {
  int body;
  Vec2 translation;
  double rotation;  ///< radians
  Vec2 centre;      ///< of the body

  /// The displacement at x, length: translation and rotation by a small angle about the centre.
  Vec2 at(const Vec2& x) const { return translation + rotation * Vec2(centre.y() - x.y(), x.x() - centre.x()); }
};

/// A place where contact keeps two bodies from moving into or away from one another, along a unit normal.
struct ContactNormal {
  Vec2 position, normal;
  int body, other;  ///< other: -1 where it is the place itself that the body is not to move from
};

/// Each body's centre and half-diagonal, so that the three motions of a body are of one size.
struct BodyFrames {
  std::vector<Vec2> centre;
  std::vector<double> size;
};
BodyFrames body_frames(const Mesh& mesh, const BodyPoints& points);

/// Motions of single bodies and of groups of bodies that neither constraints, springs nor `rows * u = 0` resist.
/// `rows` (m x degrees of freedom) are the contact conditions that can hold a body; m may be zero.
/// Each element is one free motion: the bodies that move in it (unit size: translations of about 1). No two motions
/// are mixed that could be told apart: five floating bodies are five motions.
std::vector<std::vector<RigidMotion>> free_motions(const Mesh& mesh, const Constraints& constraints,
                                                   const SparseMatrix& rows);

/// The same with contact along `normals`, and motions that open or close it by less than 1e-6 of their size.
std::vector<std::vector<RigidMotion>> free_motions(const Mesh& mesh, const Constraints& constraints,
                                                   const std::vector<ContactNormal>& normals);

/// "body 'upper': translation (0, 1); body 'pin': clockwise rotation about (2, 0)" for messages.
std::string describe(const Mesh& mesh, const std::vector<RigidMotion>& motion);

}  // namespace mortise
