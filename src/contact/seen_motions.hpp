// Which motions of two bodies against one another their contact sees: those that change a curve, as it is drawn.
#pragma once

#include "contact/segments.hpp"
#include "contact/smooth_normals.hpp"

namespace mortise {

/// The motion that leaves the part of a curve that faces another as it is: a turn, of arcs about one centre; a slide,
/// of parallel straight lines; of other curves there is none.
struct Symmetry {
  enum class Kind { none, turn, slide } kind = Kind::none;
  Vec2 centre = Vec2::Zero();     ///< of a turn
  Vec2 direction = Vec2::Zero();  ///< of a slide, unit
};

/// `faces`: of each edge. By the smooth normals at the vertices and, where the curve is drawn, by its places between.
Symmetry symmetry(const Points& nodes, const Curve& curve, const std::vector<char>& faces);

/// A motion of one body against the other that is made of both curves' symmetries opens no gap: a disc between plates
/// may turn, and slide along them, whichever side carries the multipliers. The result's normals are those along which
/// all other motions are resisted.
SmoothNormals seen_motions(const Points& nodes, const Curve& multiplier, const Curve& opposite,
                           const std::vector<ContactPoint>& points);

}  // namespace mortise
