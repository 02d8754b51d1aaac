// What estimates on one mesh share.
#pragma once

#include <map>

#include "contact/singular_points.hpp"
#include "error/body_products.hpp"
#include "error/pressure_form.hpp"
#include "error/statics.hpp"

namespace mortise {

/// What the mesh, the bodies and what is fixed make, each part when it is first asked for. Of one problem, whose loads,
/// closed rows and, by keep_for, fixed unknowns may change.
class EstimateMemory {
 public:
  BodyProducts products;
  std::optional<LocalRecovery> beside;  ///< the curves of the pairs that swing

  /// `keeps`: as of BodyProducts.
  explicit EstimateMemory(bool keeps = false) : products(keeps), keeps_(keeps) {}

  /// Before all below: forgets what was made with other unknowns fixed.
  void keep_for(const Problem& problem);
  Surroundings around(const Problem& problem);
  const std::vector<BodyCorner>& corners(const Problem& problem);
  const Statics& statics(const Problem& problem);
  /// Of pair k, to work with; of several pairs at once.
  template <typename Work>
  void with_fits(std::size_t k, Work work) {
    PressureFits own;
    work(keeps_ ? fits_[k] : own);
  }
  /// Of each pair; its places are found again where contact reaches other vertices or the gap is another.
  std::vector<std::vector<SingularPoint>> points(const Problem& problem, const std::vector<ContactReach>& reached);

 private:
  struct KnownPlaces {
    ContactReach reach;
    GivenGap given;
  };
  bool keeps_;
  TipTable tips_;
  std::optional<SideTable> sides_;
  std::optional<TiedVertices> ties_;
  std::vector<char> fixed_;
  std::optional<Constraints> supports_;  // those of the problem without what holds idle motions, where it does
  std::optional<std::vector<BodyCorner>> corners_;
  std::optional<Statics> statics_;
  std::vector<std::optional<KnownPlaces>> known_;  // of each pair
  std::vector<std::vector<ContactPlace>> places_;
  std::vector<PressureFits> fits_;
};

}  // namespace mortise
