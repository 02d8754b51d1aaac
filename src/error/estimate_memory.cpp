#include "error/estimate_memory.hpp"

#include "base/parallel.hpp"
#include "contact/gap_cuts.hpp"
#include "solve/threads.hpp"

namespace mortise {

void EstimateMemory::keep_for(const Problem& p) {
  const std::vector<char>& fixed = p.discretisation.system.constraints.fixed;
  if (fixed != fixed_) {
    fixed_ = fixed;
    corners_.reset();
    statics_.reset();
    known_.clear();
    supports_.reset();
    if (!p.idle.empty()) {
      supports_ = p.discretisation.system.constraints;
      for (const int unknown : p.idle) supports_->fixed[unknown] = 0;
    }
  }
  known_.resize(p.pairs.size());
  places_.resize(p.pairs.size());
  fits_.resize(p.pairs.size());
}

Surroundings EstimateMemory::around(const Problem& p) {
  if (!sides_) sides_.emplace(p.mesh);
  if (!ties_) ties_.emplace(p.mesh, *sides_);
  const Constraints& supports = supports_ ? *supports_ : p.discretisation.system.constraints;
  return {p.mesh, *sides_, *ties_, supports, p.discretisation.laws, tips_};
}

const std::vector<BodyCorner>& EstimateMemory::corners(const Problem& p) {
  if (!corners_) corners_ = body_corners(around(p));
  return *corners_;
}

const Statics& EstimateMemory::statics(const Problem& p) {
  if (!statics_) statics_.emplace(p.mesh, p.points, p.discretisation.system, p.idle);
  return *statics_;
}

std::vector<std::vector<SingularPoint>> EstimateMemory::points(const Problem& p,
                                                               const std::vector<ContactReach>& reached) {
  const Surroundings of = around(p);
  for_each_index(p.pairs.size(), solver_threads(), [&](std::size_t k) {
    const ContactPair& pair = p.pairs[k];
    const bool one_curve = pair.spec.initial_gap == InitialGap::closed || pair.spec.initial_gap == InitialGap::given;
    const GivenGap given{.one_curve = one_curve,
                         .end_slopes = gap_slopes_at_ends(of.mesh.nodes, pair.multiplier, pair.geometry)};
    if (known_[k] && known_[k]->reach == reached[k] && known_[k]->given == given) return;
    known_[k] = {reached[k], given};
    places_[k] = contact_places(of, pair.multiplier, pair.opposite, reached[k], given);
    for (ContactPlace& place : places_[k]) place.soft = pair.spec.stiffness.has_value();
  });
  return singular_points(places_, tips_, solver_threads());
}

}  // namespace mortise
