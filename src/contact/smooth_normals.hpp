// The normals of the curve that a mesh stands for, where its own edges have those of their chords.
#pragma once

#include "fem/rigid_motions.hpp"
#include "mesh/curve.hpp"

namespace mortise {

/// At each vertex of the edges that face another curve: the normal of the circle through the vertex and its neighbours,
/// exact on straight lines and circles however the vertices are spaced; where edges meet at more than 20 degrees, the
/// normals of both. A turn of a disc about its centre moves nothing along these, while the chords' own normals resist
/// it by as much as the spacing is uneven. `faces`: of each edge; `other`: the body that it faces.
std::vector<ContactNormal> smooth_normals(const Points& nodes, const Curve& curve, int other,
                                          const std::vector<char>& faces);

/// How far the edges leave such a curve, as part of its radius: angle^2 / 8 of a chord, angle^4 / 128 of a 3-node edge
/// (an upper bound for a parabola through three points of an arc). What loads do in a turn is known no better.
double edge_error(const Points& nodes, const Curve& curve);

}  // namespace mortise
