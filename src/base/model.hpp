// The choices a scene makes, as words that every room understands.
#pragma once

namespace mortise {

enum class Plane { strain, stress };
enum class Condition { unilateral, bilateral };
enum class InitialGap { measured, closed };
enum class MethodKind { mortar, ddm };
enum class Integration { segments, elements };
enum class Solver { direct, mssor };
enum class Multipliers { quadratic, linear, dual };

// Domain decomposition: the iteration, and what makes it (or an iterative solver) faster.
enum class Scheme { neumann_dirichlet, neumann_neumann, dirichlet_dirichlet };
enum class Acceleration { none, aitken, anderson, krylov, minres };  // minres: of mssor only

}  // namespace mortise
