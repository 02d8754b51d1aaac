#include "error/banded_fit.hpp"

#include <Eigen/Jacobi>
#include <algorithm>

namespace mortise {

BandedFit::BandedFit(Eigen::Index columns, Eigen::Index band)
    : triangle_(MatX::Zero(columns, band)), right_(VecX::Zero(columns)) {}

void BandedFit::add(Eigen::Index first, const VecX& row, double right) {
  const Eigen::Index columns = triangle_.rows(), band = triangle_.cols();
  VecX rest = VecX::Zero(band);
  rest.head(row.size()) = row;
  for (Eigen::Index k = first; k < columns; ++k) {
    if (rest(0) != 0) {
      Eigen::JacobiRotation<double> turn;
      turn.makeGivens(triangle_(k, 0), rest(0));
      for (Eigen::Index j = 0; j < std::min(band, columns - k); ++j) {
        const double above = triangle_(k, j);
        triangle_(k, j) = turn.c() * above - turn.s() * rest(j);
        rest(j) = turn.s() * above + turn.c() * rest(j);
      }
      const double above = right_(k);
      right_(k) = turn.c() * above - turn.s() * right;
      right = turn.s() * above + turn.c() * right;
    }
    std::rotate(rest.begin(), rest.begin() + 1, rest.end());
    rest(band - 1) = 0;
    if (rest.isZero(0)) break;
  }
}

bool BandedFit::is_regular() const {
  constexpr double least = 1e-13;
  for (Eigen::Index k = 0; k < triangle_.rows(); ++k)
    if (!(std::abs(triangle_(k, 0)) > least * triangle_.row(k).cwiseAbs().maxCoeff())) return false;
  return true;
}

VecX BandedFit::back(VecX right) const {
  const Eigen::Index columns = triangle_.rows(), band = triangle_.cols();
  for (Eigen::Index k = columns - 1; k >= 0; --k) {
    for (Eigen::Index j = 1; j < std::min(band, columns - k); ++j) right(k) -= triangle_(k, j) * right(k + j);
    right(k) /= triangle_(k, 0);
  }
  return right;
}

VecX BandedFit::back_turned(VecX right) const {
  const Eigen::Index columns = triangle_.rows(), band = triangle_.cols();
  for (Eigen::Index k = 0; k < columns; ++k) {
    right(k) /= triangle_(k, 0);
    for (Eigen::Index j = 1; j < std::min(band, columns - k); ++j) right(k + j) -= triangle_(k, j) * right(k);
  }
  return right;
}

VecX BandedFit::solve() const { return is_regular() ? back(right_) : VecX(); }

VecX BandedFit::solve(const VecX& g, double value) const {
  if (!is_regular()) return {};
  const VecX free = back(right_), toward = back(back_turned(g));
  const double turn = g.dot(toward);
  return turn > 0 ? VecX(free + toward * ((value - g.dot(free)) / turn)) : free;
}

}  // namespace mortise
