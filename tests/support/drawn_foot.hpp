// A body whose foot gmsh draws, above a flat one, at random.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "base/types.hpp"

namespace mortise::test {

double draw(std::mt19937& random, double low, double high);
double draw_power(std::mt19937& random, double low, double high);  ///< decimal logarithms

/// The foot is a chain of curves, turned and moved; lengths in widths of the foot, angles from its chord.
struct DrawnFoot {
  struct Piece {
    std::string kind;  // Line, Circle, Ellipse, Spline, BSpline, Bezier
    double length, radius;
    bool bulges;          // towards the flat body
    double turn_to_next;  // radians
  };
  std::vector<Piece> pieces;
  std::vector<double> sizes;  // of the mesh where the pieces begin and end
  double width, place, angle;
  int order;
};

/// `finest`: the decimal logarithm of the finest size.
DrawnFoot random_foot(std::mt19937& random, int pieces, double finest);

/// Its curves, sizes and place, for messages.
std::string name_of(const DrawnFoot& foot);

struct FootFile {
  std::string geo;
  std::vector<Vec2> vertices;  // where pieces begin and end
};

FootFile file_of(const DrawnFoot& foot);

}  // namespace mortise::test
