// The choices a scene makes, by the words of its file, and the options of the iterative solvers.
#pragma once

#include <optional>

#include "base/words.hpp"

namespace mortise {

/// axisymmetric: the meridian plane of rings, the first coordinate is the radius.
MORTISE_WORDS(Plane, strain, stress, axisymmetric)
/// tied: what is drawn as two bodies is one; cyclic: so is a sector and the next one, turned about the origin.
MORTISE_WORDS(Condition, unilateral, bilateral, tied, cyclic)

/// The undeformed gap: that between the curves that the meshes stand for, that between their edges, none, or
/// one that the scene gives.
MORTISE_WORDS(InitialGap, curve, measured, closed, given)

/// Along which normals contact acts: those of the multiplier side's edges, or of the curve that they stand for.
MORTISE_WORDS(Normals, edges, curve)
MORTISE_WORDS(Integration, segments, elements)
MORTISE_WORDS(Multipliers, quadratic, linear, dual)

/// The figure whose accuracy is asked for: the pressure along all contact lines, its largest value, half the width of a
/// contact, the mean pressure over a part of a line, the force of a pair.
MORTISE_WORDS(Goal, pressure, peak, half_width, mean, force, displacement, stress)

/// direct: a factorisation of all bodies; mssor: block SSOR on all of them; ddm: domain decomposition by two groups of
/// bodies; feti: by each body, any number of them.
MORTISE_WORDS(Solver, direct, mssor, ddm, feti)

MORTISE_WORDS(Scheme, neumann_dirichlet, neumann_neumann, dirichlet_dirichlet)
MORTISE_WORDS(Acceleration, none, aitken, anderson, krylov, minres)  // minres: of mssor only

struct DdmOptions {
  Scheme scheme = Scheme::neumann_dirichlet;
  Acceleration acceleration = Acceleration::krylov;  ///< none, aitken, anderson or krylov
  std::optional<double> beta;                        ///< relaxation, > 0; default: estimated
  double tolerance = 1e-8;                           ///< of both residuals
  int max_iterations = 1000;

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

}  // namespace mortise
