// The pressure of a loaded piece of a contact line in the form that it has there, from moments with hat functions.
#pragma once

#include <array>
#include <optional>

#include "base/types.hpp"
#include "error/spline.hpp"

namespace mortise {

/// How p goes at an end of the piece: as |s - centre|^(exponent - 1) times a smooth function.
struct PieceEnd {
  double place = 0;       ///< arc length
  double centre = 0;      ///< of the power: the place, or beyond it in the next edge
  double exponent = 1;    ///< > 0
  bool border = false;    ///< contact ends freely: the place is found, on the edge beside the first loaded vertex
  bool mirrored = false;  ///< p is even about the place
};

/// A piece of a line, vertex by vertex. At a border the first vertex is the one that carries nothing any more.
struct LoadedPiece {
  VecX s;                    ///< arc length, ascending
  VecX depth;                ///< of the model at the vertices, over any unit: 1, or the radius of rings
  VecX moments;              ///< int p phi depth ds with the hat phi of each vertex
  std::vector<char> joined;  ///< of each edge: only the sum of its two vertices' moments is known
  std::array<PieceEnd, 2> ends;
};

/// p* of a piece: the powers of both ends times a spline.
struct PressureForm {
  std::array<PieceEnd, 2> ends;
  Knots knots;
  VecX q;  ///< coefficients of the spline; empty: none was found

  double at(double s) const;  ///< stress; 0 beyond the ends
};

struct FormSpec {
  int degree = 3;  ///< of the spline
  int every = 1;   ///< vertices to a knot
  int clear = 10;  ///< edges from a border without a knot
};

/// p* with the moments of the piece (docs/theory.md eq. 48c): all of them where the spline has as many coefficients.
/// With fewer, beside borders, the forces summed from one end on are those of the least sum of squares; the whole force
/// and its first moment are kept exactly. Borders stay where they are.
PressureForm fit_form(const LoadedPiece& piece, const FormSpec& spec = {});

/// Puts the borders where p* fits best, each by the edges next to it.
void place_borders(LoadedPiece& piece, const FormSpec& spec = {});

}  // namespace mortise
