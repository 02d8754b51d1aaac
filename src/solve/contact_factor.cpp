#include "solve/contact_factor.hpp"

#include "solve/bordered_system.hpp"

namespace mortise {

ContactFactor::ContactFactor(const SaddlePointSystem& system, std::vector<int> free, BorderedCholesky factor,
                             MultiplierSystem multipliers)
    : row_scale_(system.row_scale),
      unknowns_(system.K.cols()),
      springs_(system.grounded.size()),
      free_(std::move(free)),
      factor_(std::move(factor)),
      multipliers_(std::move(multipliers)) {}

VecX ContactFactor::dual(const VecX& w) const {
  VecX rhs = VecX::Zero(w.size() + springs_), z = VecX::Zero(unknowns_);
  rhs.head(w.size()) = -w.cwiseQuotient(row_scale_);
  z(free_) = factor_.backward(VecX::Zero(Eigen::Index(free_.size()) + rhs.size()), multipliers_.solve(rhs));
  return z;
}

std::shared_ptr<const ContactFactor> factorise_contact(const SaddlePointSystem& s, const std::vector<char>& closed) {
  BorderedSystem reduced = bordered_system(s);
  BorderedCholesky factor(std::move(reduced.matrix), reduced.blocks);
  std::vector<int> rows;
  for (int a = 0; a < int(closed.size()); ++a)
    if (closed[a]) rows.push_back(a);
  MultiplierSystem multipliers(factor.take_border_compliance(), Eigen::Index(s.grounded.size()), std::move(rows));
  return std::make_shared<ContactFactor>(s, std::move(reduced.free), std::move(factor), std::move(multipliers));
}

}  // namespace mortise
