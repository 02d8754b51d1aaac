// How to cut a cell so that functions upon it are integrated as they are: spots, waves and jumps within the cell too.
#pragma once

#include <array>
#include <functional>

#include "fem/quadrature.hpp"
#include "model/field_range.hpp"

namespace mortise {

/// A field that varies over bodies, and by how much, > 0.
struct ScaledField {
  const Field* field;
  FieldRange range;
  double scale;
};

/// A part of a reference cell: a triangle, or a rectangle with sides along the axes.
struct CellPiece {
  int corners;
  std::array<Vec2, 4> at;  ///< reference coordinates, counter-clockwise
  double part = 1;         ///< of the cell's area, 0 ... 1
};

/// Pieces of a cell on each of which the fields vary nearly linearly (by 0.05 of the scale) or which are so small that
/// it does not matter (1e-7 of the cell, at most 400 pieces): 4 x 4 points a piece then integrate them, of a jump to
/// 1e-3 of the cell or better. Empty where they are linear to 0.01 on the whole cell, which need not be cut. What lies
/// between samples is found by the fields' ranges; where one is not known it is looked at in 64 pieces first.
std::vector<CellPiece> resolving_pieces(const Points& nodes, const Cell& cell, const std::vector<ScaledField>& fields);

/// All of a cell.
CellPiece whole_cell(CellKind kind);

/// 4 x 4 points on each piece: of degree 6, so that with the shape functions what smooth fields leave is 1e-8 of them.
CellRule piece_rule(const std::vector<CellPiece>& pieces);

/// Functions less the polynomials that stand for them.
struct CellMisfit {
  double root_mean_square;  ///< over the cell, of the length of the vector of differences
  double mean;              ///< likewise, without squares
  Vec2 at;                  ///< place of the largest difference
  double finest;            ///< side of a square as large as the smallest piece that has a hundredth of it, length
};

/// `values`: of all functions at a place. The polynomials, in reference coordinates of degree 1 or 2, are projections
/// in L2.
CellMisfit misfit(const Points& nodes, const Cell& cell, const std::vector<CellPiece>& pieces, int degree,
                  const std::function<VecX(const Vec2&)>& values);

}  // namespace mortise
