// The sum of forces.
#pragma once

#include "base/types.hpp"

namespace mortise {

/// Force and moment of forces at places, times depth (model/model.hpp). The moment is about the origin, positive
/// counter-clockwise.
struct Resultant {
  Vec2 force = Vec2::Zero();
  double moment = 0;
  double size = 0, arms = 0;   ///< sums of |f| and of |x| |f|: what force and moment are round-off of
  Vec2 places = Vec2::Zero();  ///< sum of |f| x

  void add(const Vec2& x, const Vec2& f) {
    force += f;
    moment += x.x() * f.y() - x.y() * f.x();
    size += f.norm();
    arms += x.norm() * f.norm();
    places += f.norm() * x;
  }

  /// A moment by itself; `length`: of its arms.
  void add_moment(double value, double length) {
    moment += value;
    arms += std::abs(value);
    if (length > 0) size += std::abs(value) / length;
  }

  Resultant& operator+=(const Resultant& other) {
    force += other.force;
    moment += other.moment;
    size += other.size;
    arms += other.arms;
    places += other.places;
    return *this;
  }

  /// The mean of the places where the forces act; the origin if there are none.
  Vec2 centre() const { return size > 0 ? Vec2(places / size) : Vec2::Zero(); }

  double moment_about(const Vec2& x) const { return moment - (x.x() * force.y() - x.y() * force.x()); }
};

}  // namespace mortise
