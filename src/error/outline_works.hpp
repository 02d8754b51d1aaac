// What straight sides that stand for a curve do to functionals, by their dual solutions (docs/theory.md eq. 51c).
#pragma once

#include <map>

#include "problem/boundary_conditions.hpp"
#include "problem/problem.hpp"

namespace mortise {

class OutlineWorks {
 public:
  OutlineWorks(const Problem& problem, const VecX& u) : problem_(problem), u_(u) {}

  /// Of each dual solution z: what fills the space between a straight side and its curve carries f . z - sigma(u) :
  /// eps(z) per volume, which is the derivative of the functional by the place of a boundary that is free, and loads
  /// act on the curve with what their functions are there. What else presses on the side moves along with it, as a
  /// pressure. One a dual, signed, in the functionals' units; each z: n.
  VecX of(const DataMisfit& on, const std::vector<VecX>& z);

 private:
  // A load along a curve that has the side for its edge.
  struct Load {
    const BoundaryEntry* entry;
    const NamedBoundary* on;
    int edge;
    TractionField traction;
    double s_at(const Vec2& x) const { return on->s ? on->s->at(edge, x) : 0; }
  };
  // What it acts with at a point of the side, and at the curve `away` from there.
  struct Forces {
    double xi, away;
    Vec2 on_side, on_curve;
  };

  const std::vector<Load>& loads_on(const DataMisfit& on);
  std::vector<Forces> forces(const Load& load, const DataMisfit& on) const;

  const Problem& problem_;
  const VecX& u_;
  std::optional<std::map<std::pair<int, int>, std::vector<Load>>> loads_;  // by cell and side
};

/// One a misfit of the outline, for a functional that a rigid motion, n, tells: they weigh, and move the loads.
VecX outline_works(const Problem& problem, const VecX& u, const VecX& motion);

}  // namespace mortise
