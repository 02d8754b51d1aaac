// What the error of the contact pressure itself does to a functional of the solution.
#pragma once

#include "error/pressure_line.hpp"

namespace mortise {

/// The edges whose p a border of contact on edge e may move: e, and the next within (-1: there is none).
std::array<Eigen::Index, 2> edges_at(const PressureLine& line, Eigen::Index e);

/// At each contact point of a pair by how much it opens under displacements z (n x F), length: points x F.
MatX openings(const ContactPair& pair, const MatX& z);

/// Of one pair, in the functionals' units (docs/theory.md eq. 48a and 48b).
struct LinePart {
  MatX vertices;  ///< vertices x F: of the local error between the borders of contact
  MatX borders;   ///< LineError::borders x F: of moving each of them
  VecX sum() const { return (vertices.colwise().sum() + borders.colwise().sum()).transpose(); }
};

/// `opened`: points x F, by how much the functionals' dual solutions open the gap beyond what the functional asks of
/// it: on the closed line zero in the mean, beyond the border of contact what p does there if contact reaches farther.
/// An error of p does to the functional the integral of both. Between the borders that is at most the product of the
/// L2 norms at each vertex. At a border all that is known is that contact ends somewhere on one edge: p on that edge
/// and the next within may be anywhere on the two, so that its force times the largest opening there is a bound.
LinePart line_part(const ContactPair& pair, const PressureLine& line, const LineError& local, MatX opened);

}  // namespace mortise
