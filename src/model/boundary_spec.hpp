// One [[boundary]] entry: what is prescribed on curves and points.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "model/field.hpp"

namespace mortise {

/// Prescribed displacements, length; a component that is not given is free.
struct Displacement {
  std::optional<Field> x, y;

  bool operator==(const Displacement&) const = default;
};

/// u . n, length, n outward.
struct NormalDisplacement {
  Field value;

  bool operator==(const NormalDisplacement&) const = default;
};

struct DirectedDisplacement {
  Vec2 direction;  ///< a unit vector, along which
  Field value;     ///< is prescribed, length

  bool operator==(const DirectedDisplacement&) const = default;
};

/// Curves that move as a rigid body.
struct RigidSpec {
  std::optional<double> x, y;      ///< prescribed displacement of `about`, length
  std::optional<double> rotation;  ///< prescribed, radians counter-clockwise
  Vec2 force = Vec2::Zero();       ///< at `about`, times depth (model/model.hpp)
  double moment = 0;               ///< the same times length, positive counter-clockwise
  std::optional<Vec2> about;       ///< none: the curves' centre

  bool operator==(const RigidSpec&) const = default;
};

struct Pressure {
  Field value;  ///< positive pushes onto the body, stress

  bool operator==(const Pressure&) const = default;
};

struct SurfaceTraction {
  VectorField value;  ///< stress

  bool operator==(const SurfaceTraction&) const = default;
};

/// On curves the sum of a constant traction on all of them, at points that of equal forces on them.
struct TotalForce {
  Vec2 value;  ///< times depth (model/model.hpp)

  bool operator==(const TotalForce&) const = default;
};

/// Springs to the ground along the normal.
struct NormalFoundation {
  Field modulus;  ///< stress per length, >= 0

  bool operator==(const NormalFoundation&) const = default;
};

/// Springs to the ground along x and y.
struct AxesFoundation {
  VectorField moduli;  ///< stress per length, >= 0

  bool operator==(const AxesFoundation&) const = default;
};

/// Springs to the ground at points, along x and y.
struct PointSpring {
  Vec2 stiffness;  ///< force times depth per length, >= 0

  bool operator==(const PointSpring&) const = default;
};

using BoundaryCondition = std::variant<Displacement, NormalDisplacement, DirectedDisplacement, RigidSpec, Pressure,
                                       SurfaceTraction, TotalForce, NormalFoundation, AxesFoundation, PointSpring>;

struct BoundarySpec {
  std::string key;              ///< where it stands, for messages: "boundary.2 (line 31)", counted from 0
  std::vector<std::string> on;  ///< physical curves; of displacements, forces and springs also points
  BoundaryCondition what;
  bool stiffness = false;  ///< of a support whether its stiffness is asked for (results/joint_stiffness.hpp)

  bool operator==(const BoundarySpec&) const = default;
};

bool is_load(const BoundaryCondition& what);
bool is_foundation(const BoundaryCondition& what);

/// The functions of place in it.
std::vector<const Field*> fields_of(const BoundaryCondition& what);

}  // namespace mortise
