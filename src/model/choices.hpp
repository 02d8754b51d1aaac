// The choices a scene makes, as words that every room understands, and the options of the iterative solvers.
#pragma once

#include <optional>
#include <string>

namespace mortise {

/// axisymmetric: the meridian plane of rings, the first coordinate is the radius.
enum class Plane { strain, stress, axisymmetric };
/// tied: what is drawn as two bodies is one; cyclic: so is a sector and the next one, turned about the origin.
enum class Condition { unilateral, bilateral, tied, cyclic };

/// The undeformed gap: that between the curves that the meshes stand for, that between their edges, none, or
/// one that the scene gives.
enum class InitialGap { curve, measured, closed, given };

/// Along which normals contact acts: those of the multiplier side's edges, or of the curve that they stand for.
enum class Normals { edges, curve };
enum class Integration { segments, elements };
enum class Multipliers { quadratic, linear, dual };

/// The figure whose accuracy is asked for: the pressure along all contact lines, its largest value, half the width of a
/// contact, the mean pressure over a part of a line, the force of a pair.
enum class Goal { pressure, peak, half_width, mean, force, displacement, stress };

/// direct: a factorisation of all bodies; mssor: block SSOR on all of them; ddm: domain decomposition by two groups of
/// bodies; feti: by each body, any number of them.
enum class Solver { direct, mssor, ddm, feti };

enum class Scheme { neumann_dirichlet, neumann_neumann, dirichlet_dirichlet };
enum class Acceleration { none, aitken, anderson, krylov, minres };  // minres: of mssor only

struct DdmOptions {
  Scheme scheme = Scheme::neumann_dirichlet;
  Acceleration acceleration = Acceleration::krylov;  ///< none, aitken, anderson or krylov
  std::optional<double> beta;                        ///< relaxation, > 0; default: estimated
  double tolerance = 1e-8;                           ///< of both residuals
  int max_iterations = 100;

  bool operator==(const DdmOptions&) const = default;
};

struct MssorOptions {
  double omega = 1.3;                                ///< of the SSOR splitting of K, 0 < omega < 2
  double tau = 0.7;                                  ///< of the step of the multipliers, > 0
  Acceleration acceleration = Acceleration::krylov;  ///< none, krylov or minres
  double tolerance = 1e-10;                          ///< of both residuals
  int max_iterations = 20000;

  bool operator==(const MssorOptions&) const = default;
};

struct FetiOptions {
  double tolerance = 1e-10;  ///< of both residuals
  int max_iterations = 1000;

  bool operator==(const FetiOptions&) const = default;
};

/// The words of the scene file ("strain", "bilateral", ...).
std::string to_string(Plane value);
std::string to_string(Condition value);
std::string to_string(InitialGap value);
std::string to_string(Normals value);
std::string to_string(Integration value);
std::string to_string(Multipliers value);
std::string to_string(Goal value);
std::string to_string(Solver value);
std::string to_string(Scheme value);
std::string to_string(Acceleration value);

}  // namespace mortise
