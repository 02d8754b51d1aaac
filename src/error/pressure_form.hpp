// A pressure of the form that theory gives it, with the moments of a multiplier. docs/theory.md, section 14.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "base/types.hpp"

namespace mortise {

/// One end of a loaded piece of a contact line.
struct PieceEnd {
  double power = 0;  ///< p goes as so much of the distance from it: 1/2 at a border, exponent - 1 at a singular point
  bool border = false;  ///< contact ends between vertices
  bool even = false;    ///< on the axis of rings: p has no slope there
  bool tip = false;     ///< of a crack that slides: p_h swings beside it as at a border, the more the shorter the edges

  bool operator==(const PieceEnd&) const = default;
};

/// How far from a border or a tip, beside which p_h swings, q has no knot.
struct Swing {
  int edges = 0;
  double part = 0;  ///< of the piece's length, beside a tip

  bool operator==(const Swing&) const = default;
};

/// The vertices of a piece of a line that carries p, and beyond a border up to two more, at which it is 0.
struct LoadedPiece {
  VecX s;                       ///< arc length
  VecX p;                       ///< of the piecewise linear multiplier, stress
  VecX width;                   ///< of the line there: distance from the axis in rings, else 1
  std::array<PieceEnd, 2> end;  ///< the first and the last
  VecX moments{};               ///< with the hat functions; empty: those of p
  Swing swing{};

  Eigen::Index loaded(int which) const;  ///< the first (0) or the last (1) vertex that carries p
};

/// p* = (s - A)^a (B - s)^b q(s), q a cubic spline with knots at the vertices, none beside an end where p_h swings. Its
/// moments with the hat functions are those of p_h; where these are more than q has, in least squares of the forces
/// summed from one end, the whole force and moment exactly.
class PressureForm {
 public:
  double operator()(double s) const;  ///< p*, stress; 0 beyond the ends; infinite at an end of negative power
  const std::array<double, 2>& ends() const { return ends_; }  ///< A, B

 private:
  friend class PressureFit;
  std::array<double, 2> ends_, powers_;
  VecX knots_, q_;
};

/// What places alone make of a fit, whatever p there is.
class PressureFit {
 public:
  PressureFit(const LoadedPiece& piece, const std::array<double, 2>& ends);
  ~PressureFit();
  PressureFit(PressureFit&&) noexcept;
  PressureFit& operator=(PressureFit&&) noexcept;

  /// Of a piece with the same places. Nothing where the moments do not determine q.
  std::optional<PressureForm> form(const LoadedPiece& piece) const;

 private:
  struct Factor;
  PressureForm form_;               // without q
  VecX sizes_;                      // of the columns of q
  std::unique_ptr<Factor> factor_;  // none where q has more columns than there are moments
};

/// Time as the vertices.
std::optional<PressureForm> fit_pressure(const LoadedPiece& piece, const std::array<double, 2>& ends);

/// Fits on one line under loads that come one after another. What is asked for a second time is kept as long as each
/// load asks for it: where borders move, that is nothing.
class PressureFits {
 public:
  /// Before a load: forgets what that before did not ask for.
  void begin();
  /// As fit_pressure.
  std::optional<PressureForm> fit(const LoadedPiece& piece, const std::array<double, 2>& ends);

 private:
  struct Asked {
    LoadedPiece piece;
    std::array<double, 2> ends;
    std::optional<PressureFit> fit;
  };
  std::vector<Asked> before_, asked_;
};

/// Where the border at an end of a piece of three vertices or more lies, s: p goes as a root there (Johnson 1985,
/// section 4.2), so that the line through the squares of the last three vertices' p is zero at it, not before the last
/// of them and not beyond the next vertex. `stride`: of every so many vertices from the last on.
double border_place(const LoadedPiece& piece, int which, Eigen::Index stride = 1);

/// p* between two places of a line, where it is credible.
struct FittedPiece {
  PressureForm form;
  std::array<double, 2> vertices;  ///< s of the first and the last vertex that has p* and not the multiplier
  double fluid = 0;                ///< pressure of the fluid beside it, from which p rises
};

struct FittedPressure {
  std::vector<FittedPiece> pieces;  ///< by s
  double around = 0;                ///< length of a closed curve, whose s goes on beyond its first vertex; else 0

  /// p* at s of the line, stress; where pieces meet their mean. Nothing where p is the multiplier's.
  std::optional<double> at(double s) const;
};

/// A piece of at least four edges with every other vertex, and its moments: those of p with the hats of these.
LoadedPiece every_other(const LoadedPiece& piece);

}  // namespace mortise
