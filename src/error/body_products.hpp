// Products of recovered errors, body by body.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "error/dual_sums.hpp"
#include "fem/error_products.hpp"
#include "problem/problem.hpp"
#include "solve/contact_factor.hpp"

namespace mortise {

/// Functionals (rows x F, at least one); `loads` (n x L): of the last L of them. ContactFactor::duals.
struct DualsAsked {
  MatX functionals, loads;
};

/// Called with the duals of the functionals from the first on.
using SeeDuals = std::function<void(Eigen::Index first, const DualSums& duals)>;

/// error_products of u and of duals: the same figures, found for each body alone, on all cores.
class BodyProducts {
 public:
  /// `keeps`: what the mesh makes of it, and what was asked of the last factor, stays: for loads that come one after
  /// another on one mesh and one law. A functional that is a sum of those asked before has the same sum of their duals.
  /// Of the functionals without loads no more are kept than twice those asked at once.
  explicit BodyProducts(bool keeps = false) : keeps_(keeps) {}

  ErrorProducts of(const Problem& problem, const VecX& u) { return products(problem, u, {}); }

  /// In the order of u and the duals.
  ErrorProducts with_duals(const Problem& problem, const VecX& u, const std::shared_ptr<const ContactFactor>& factor,
                           const DualsAsked& asked, const SeeDuals& see = {});

 private:
  struct Body {
    Mesh mesh;
    BodyPoints points;
    std::unique_ptr<const PatchRecovery> recovery;  // none before the first field
  };
  struct Duals {  // some that were solved for
    DualsAsked asked;
    MatX z;
    std::vector<OtherFields> by_body;  // empty before the first product
    bool loaded() const { return asked.loads.cols() > 0; }
  };
  using Terms = std::vector<std::pair<Duals*, MatX>>;  // of DualSums
  static DualSums sums_of(const Terms& terms);
  static Body body_of(const Problem& problem, std::size_t b, int first_cell);
  static std::unique_ptr<Duals> solved(const ContactFactor& factor, DualsAsked asked);
  ErrorProducts products(const Problem& problem, const VecX& u, const Terms& terms);
  Terms find(const std::shared_ptr<const ContactFactor>& factor, const DualsAsked& asked);
  void add_unknown(const ContactFactor& factor, const MatX& functionals);
  Duals& loaded_duals(const ContactFactor& factor, DualsAsked asked);

  bool keeps_;
  std::vector<Body> bodies_;
  std::shared_ptr<const ContactFactor> factor_;  // that duals_ are of
  std::vector<std::unique_ptr<Duals>> duals_;    // functionals without loads are orthonormal
};

/// What the sum of parts, each known to its own size and with an error of its own, may be off by: its size, and twice
/// the root of the sum of the squares. No more than the parts with one sign.
inline double off_by(double sum, double squares, double sizes) {
  return std::min(std::abs(sum) + 2 * std::sqrt(squares), sizes);
}

/// Of each functional, `parts`: cells x F.
VecX off_by(const MatX& parts);

/// The duals of functionals.
struct FoundDuals {
  MatX z;     ///< n x F
  VecX sums;  ///< of each what the cells' parts make it off by
};

}  // namespace mortise
