// The choices a scene makes, as words that every room understands.
#pragma once

namespace mortise {

enum class Plane { strain, stress };
enum class Condition { unilateral, bilateral };
enum class InitialGap { measured, closed };
enum class MethodKind { mortar, ddm };
enum class Integration { segments, elements };
enum class Multipliers { quadratic, linear, dual };

}  // namespace mortise
