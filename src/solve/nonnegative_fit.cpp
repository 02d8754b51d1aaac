#include "solve/nonnegative_fit.hpp"

#include <Eigen/QR>

namespace mortise {
namespace {

constexpr double fit_round_off = 1e-12;  // of the largest terms

class Fit {
 public:
  Fit(const MatX& A, const VecX& b, const std::vector<char>& free)
      : A_(A), b_(b), free_(free), used_(free), x_(VecX::Zero(A.cols())), size_(A.colwise().norm()) {}

  NonnegativeFit run() {
    solve();
    for (Eigen::Index step = 0; step < 3 * A_.cols(); ++step) {  // each of them lessens the residual: one or two a row
      const Eigen::Index next = steepest();
      if (next < 0) break;
      used_[next] = 1;
      if (!solve(next)) {  // round-off: it lessens nothing
        used_[next] = 0;
        refused_[next] = 1;
      } else {
        refused_.assign(used_.size(), 0);
      }
    }
    return {x_, b_ - A_ * x_};
  }

 private:
  // The unused column that lessens the residual most, or -1.
  Eigen::Index steepest() const {
    const VecX residual = b_ - A_ * x_, along = A_.transpose() * residual;
    const double terms = largest_entry(b_) + largest_entry(A_.cwiseAbs() * x_.cwiseAbs());
    Eigen::Index best = -1;
    double most = fit_round_off * terms;
    for (Eigen::Index a = 0; a < along.size(); ++a)
      if (!used_[a] && !refused_[a] && size_(a) > 0 && along(a) / size_(a) > most) {
        best = a;
        most = along(a) / size_(a);
      }
    return best;
  }

  // Least squares in the used columns, from x along the straight line, without those that it meets at zero. False where
  // the one that was added last would be negative.
  bool solve(Eigen::Index added = -1) {
    for (;;) {
      std::vector<Eigen::Index> columns;
      for (std::size_t a = 0; a < used_.size(); ++a)
        if (used_[a]) columns.push_back(Eigen::Index(a));
      if (columns.empty()) return true;
      VecX found = VecX::Zero(x_.size());
      const MatX used = A_(Eigen::all, columns);
      const VecX fitted = used.completeOrthogonalDecomposition().solve(b_);
      found(columns) = fitted;
      if (added >= 0 && !(found(added) > 0)) return false;
      added = -1;
      double t = 1;
      Eigen::Index first = -1;
      for (const Eigen::Index a : columns)
        if (!free_[a] && found(a) <= 0 && x_(a) / (x_(a) - found(a)) < t) {
          t = x_(a) / (x_(a) - found(a));
          first = a;
        }
      x_ += t * (found - x_);
      if (first < 0) return true;
      used_[first] = 0;
      x_(first) = 0;
    }
  }

  const MatX& A_;
  const VecX& b_;
  const std::vector<char>& free_;
  std::vector<char> used_, refused_ = std::vector<char>(used_.size(), 0);
  VecX x_, size_;
};

}  // namespace

NonnegativeFit fit_nonnegative(const MatX& A, const VecX& b, const std::vector<char>& free) {
  return Fit(A, b, free).run();
}

}  // namespace mortise
