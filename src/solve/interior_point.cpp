#include "solve/interior_point.hpp"

#include <algorithm>

namespace mortise {
namespace {

constexpr int most_steps = 150;           // a guard: ten pipes in a rack take 52
constexpr int least_progress = 5;         // lambda w that does not halve in so many steps: round-off, or no solution
constexpr double exact = 1e-12;           // of the largest terms: some thousand round-offs
constexpr double balanced = 1e-10;        // likewise, of the equations: differences of springs' terms
constexpr double path_round_off = 1e-15;  // of the largest terms, its square of their product
constexpr double least_told = path_round_off / balanced;  // pressures, of the start: what is balanced can be computed
constexpr double apart = 1e5;          // pressure over gap, or gap over pressure, of a row that is told
constexpr double good_enough = 1e-5;   // the same, for the rows to be told apart
constexpr double runaway = 1e8;        // pressures over those of the start, where nothing carries the load
constexpr double to_the_edge = 0.995;  // of the way to where a pressure or a gap is zero (Mehrotra 1992)

// Newton's method for x = -lambda and z = w, both positive on unilateral rows. Compared are x over, and gaps times, the
// root of the compliance of each row, and work over the root of each motion's stiffness: all are then of one unit.
class Path {
 public:
  explicit Path(ContactRows& rows)
      : rows_(rows),
        unilateral_(rows.unilateral()),
        root_(rows.diagonal().cwiseSqrt()),
        motion_(rows.stiffness().cwiseSqrt()),
        at_{.lambda = VecX::Zero(root_.size()), .mu = VecX::Zero(rows.motions())},
        z_(VecX::Zero(root_.size())) {
    for (double& size : motion_) size = std::max(size, negligible_motion * motion_.maxCoeff());
    unit_ = largest(gap_size(rows_.gaps(at_)), work_size(rows_.unbalanced(at_.lambda)));
    for_each_unilateral([&](Eigen::Index a) {
      ++count_;
      at_.lambda(a) = -unit_ / root_(a);
      z_(a) = unit_ * root_(a);
    });
    look();
  }

  bool trivial() const { return !(unit_ > 0); }
  bool finite() const { return std::isfinite(error_); }
  bool runs_away() const { return largest_pressure() > runaway * unit_; }
  /// How far from the solution: what is left of the equations, and of lambda w, over the largest terms.
  double error() const { return error_; }
  /// Of lambda w, over the square of the largest terms of the start: it goes on to fall where `error` is round-off.
  double product() const { return mean_ / (unit_ * unit_); }
  const ContactRows::Forces& at() const { return at_; }

  // A row that carries a millionth of the others' pressures may be what holds a body along the contact: the path is
  // followed until lambda w is small of their square and each row is told, or, where some just touch, to its end.
  bool told() const {
    bool all = mean_ <= exact * largest_pressure() * largest_pressure();
    for_each_unilateral([&](Eigen::Index a) {
      const double pressure = -at_.lambda(a) * root_(a), gap = z_(a) / root_(a);
      all = all && (pressure > apart * gap || gap > apart * pressure);
    });
    return all;
  }

  std::vector<char> closed() const {
    std::vector<char> closed(unilateral_.size(), 1);
    for_each_unilateral([&](Eigen::Index a) { closed[a] = -at_.lambda(a) * root_(a) > z_(a) / root_(a); });
    return closed;
  }

  // Towards lambda w = 0 first, which says how near to it the path can be followed; then with what is quadratic.
  bool step() {
    VecX softness = VecX::Zero(root_.size());
    for_each_unilateral([&](Eigen::Index a) { softness(a) = -z_(a) / at_.lambda(a); });
    if (!rows_.soften(softness)) return false;
    VecX products = VecX::Zero(root_.size());
    for_each_unilateral([&](Eigen::Index a) { products(a) = -at_.lambda(a) * z_(a); });
    const Step first = towards(products);
    const double t = longest(first), after = count_ > 0 ? product(moved(first, t)) : 0,
                 sigma = count_ > 0 ? std::pow(after / mean_, 3) : 0;
    for_each_unilateral([&](Eigen::Index a) { products(a) += -first.forces.lambda(a) * first.z(a) - sigma * mean_; });
    const Step second = towards(products);
    const double most = std::min(1.0, to_the_edge * longest(second));
    if (!(most > 0)) return false;
    const auto [forces, z] = moved(second, most);
    at_ = forces;
    z_ = z;
    look();
    return true;
  }

 private:
  static constexpr double negligible_motion = 1e-5;  // of the largest: what opens less, the rows do not hold

  struct Step {
    ContactRows::Forces forces;
    VecX z;
  };

  template <typename Visit>
  void for_each_unilateral(Visit visit) const {
    for (Eigen::Index a = 0; a < root_.size(); ++a)
      if (unilateral_[a]) visit(a);
  }

  double gap_size(const VecX& w) const { return largest_entry(w.cwiseQuotient(root_)); }
  double work_size(const VecX& work) const { return largest_entry(work.cwiseQuotient(motion_)); }
  double largest_pressure() const { return largest_entry(at_.lambda.cwiseProduct(root_)); }

  void look() {
    left_ = rows_.gaps(at_) - z_;
    work_ = rows_.unbalanced(at_.lambda);
    mean_ = product({at_, z_});
    const double size = largest(largest_pressure(), count_ > 0 ? least_told * unit_ : unit_);
    error_ =
        fraction(largest({gap_size(left_), work_size(work_), count_ > 0 ? mean_ / std::min(unit_, size) : 0}), size);
  }

  // Mean of -lambda w.
  double product(const Step& s) const {
    double sum = 0;
    for_each_unilateral([&](Eigen::Index a) { sum -= s.forces.lambda(a) * s.z(a); });
    return sum / double(std::max<Eigen::Index>(count_, 1));
  }

  Step towards(const VecX& products) {
    VecX gap = left_;
    for_each_unilateral([&](Eigen::Index a) { gap(a) -= products(a) / at_.lambda(a); });
    Step step{rows_.solve_softened(gap, work_), VecX::Zero(root_.size())};
    for_each_unilateral(
        [&](Eigen::Index a) { step.z(a) = (products(a) - z_(a) * step.forces.lambda(a)) / at_.lambda(a); });
    return step;
  }

  double longest(const Step& step) const {
    double t = 1;
    for_each_unilateral([&](Eigen::Index a) {
      if (step.forces.lambda(a) > 0) t = std::min(t, -at_.lambda(a) / step.forces.lambda(a));
      if (step.z(a) < 0) t = std::min(t, -z_(a) / step.z(a));
    });
    return t;
  }

  Step moved(const Step& by, double t) const {
    return {{at_.lambda + t * by.forces.lambda, at_.mu + t * by.forces.mu}, z_ + t * by.z};
  }

  ContactRows& rows_;
  const std::vector<char>& unilateral_;
  VecX root_, motion_;
  Eigen::Index count_ = 0;  // of unilateral rows
  ContactRows::Forces at_;
  VecX z_, left_, work_;
  double unit_ = 0, mean_ = 0, error_ = 0;
};

}  // namespace

InteriorPoint find_interior_point(ContactRows& rows) {
  Path path(rows);
  InteriorPoint best{.converged = path.trivial(), .steps = 0, .at = path.at(), .closed = path.closed()};
  double least = path.error();
  constexpr double round_off = path_round_off * path_round_off;
  Halving product(path.product(), least_progress);
  bool goes_on = !best.converged;
  while (goes_on && path.finite() && best.steps < most_steps && !path.runs_away() && path.step()) {
    ++best.steps;
    const bool nearer = path.error() <= std::max(least, balanced);
    if (nearer) {
      least = std::min(least, path.error());
      best.at = path.at();
      best.closed = path.closed();
    }
    const bool converged = path.error() <= balanced && (path.told() || path.product() <= round_off);
    goes_on = product.goes_on(std::max(path.product(), round_off)) && !converged;
  }
  best.converged = least <= good_enough;
  return best;
}

}  // namespace mortise
