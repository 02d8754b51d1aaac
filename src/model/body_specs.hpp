// The materials of bodies, and the loads on whole bodies.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "model/field.hpp"
#include "model/moduli.hpp"

namespace mortise {

/// Units are the scene's own, used throughout (SI if E is in Pa and lengths in m).
struct Material {
  double young = 0;                         ///< E, stress, > 0; of a material that is not isotropic the largest
  double poisson = 0;                       ///< nu, -1 < nu < 0.5
  double thermal_expansion = 0;             ///< alpha, 1/K
  double density = 0;                       ///< mass per volume
  std::optional<OrthotropicModuli> moduli;  ///< of an orthotropic material
  std::optional<Mat4> stiffness;            ///< (11, 22, 33, gamma_12), of one that is not isotropic

  bool operator==(const Material&) const = default;
};

struct BodySpec {
  std::string name;      ///< physical surface
  std::string material;  ///< key of Scene::materials

  bool operator==(const BodySpec&) const = default;
};

/// One [[body_force]] entry: force per volume.
struct BodyForceSpec {
  std::string key;
  std::string body;
  VectorField force;

  bool operator==(const BodyForceSpec&) const = default;
};

/// One [[initial_strain]] entry: a strain, or a temperature change (strain alpha dT in all three directions).
struct InitialStrainSpec {
  std::string key;
  std::string body;
  std::optional<Field> temperature_change;  ///< K
  std::array<Field, 4> strain;              ///< (11, 22, 33, 12), tensor shear strain

  bool operator==(const InitialStrainSpec&) const = default;
};

}  // namespace mortise
