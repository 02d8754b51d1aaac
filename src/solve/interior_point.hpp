// Unilateral contact as a convex quadratic programme, by a path through the interior.
#pragma once

#include "solve/contact_rows.hpp"

namespace mortise {

struct InteriorPoint {
  bool converged = false;
  int steps = 0;             ///< each one factorisation of rows that give way
  ContactRows::Forces at;    ///< lambda < 0 on all unilateral rows
  std::vector<char> closed;  ///< m: rows whose lambda is more than their gap
};

/// Whether a measure that is to fall to zero halves within so many steps of an iteration, however slowly that goes.
class Halving {
 public:
  Halving(double first, int within) : known_(first), within_(within), left_(within) {}
  bool goes_on(double now) {
    --left_;
    if (now < 0.5 * known_) {
      known_ = now;
      left_ = within_;
    }
    return left_ > 0;
  }

 private:
  double known_;
  int within_, left_;
};

/// min 1/2 lambda^T C lambda - r^T lambda, H^T lambda = h, lambda <= 0 on unilateral rows, by Mehrotra's
/// predictor-corrector (SIAM J. Optim. 2 (1992) 575-601): Newton's method on lambda w = -sigma, with sigma falling to
/// zero. A step solves with rows that give way by -w / lambda each, which is a well posed system however few rows are
/// closed in the end; the number of steps hardly depends on that of the rows. Where no lambda carries the load it
/// grows without limit, and the method ends without having converged.
InteriorPoint find_interior_point(ContactRows& rows);

}  // namespace mortise
