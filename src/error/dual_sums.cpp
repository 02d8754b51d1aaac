#include "error/dual_sums.hpp"

namespace mortise {

MatX DualSums::fields() const {
  MatX sum = terms_[0].z * terms_[0].of;
  for (std::size_t k = 1; k < terms_.size(); ++k) sum.noalias() += terms_[k].z * terms_[k].of;
  return sum;
}

VecX DualSums::field(Eigen::Index k) const {
  VecX sum = terms_[0].z * terms_[0].of.col(k);
  for (std::size_t t = 1; t < terms_.size(); ++t) sum.noalias() += terms_[t].z * terms_[t].of.col(k);
  return sum;
}

}  // namespace mortise
