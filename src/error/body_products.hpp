// Products of recovered errors, body by body.
#pragma once

#include <functional>

#include "fem/error_products.hpp"
#include "problem/problem.hpp"
#include "solve/contact_factor.hpp"

namespace mortise {

/// error_products of the patches that recover_patches makes of `fields` (n x F, displacements): the same figures, found
/// for each body alone, on all cores.
ErrorProducts products_by_body(const Problem& problem, const MatX& fields);

/// Called with u and, after it, the duals (n x some) of the functionals from the first on, before their products are
/// taken: to be looked at, or to be added to.
using SeeDuals = std::function<void(Eigen::Index first, MatX& fields)>;

/// Of u and the duals of functionals (rows x F, at least one), in the order of both; `loads` (n x L): of the last L of
/// them. `see`: called with u and some of the duals after another.
ErrorProducts products_with_duals(const Problem& problem, const VecX& u, const ContactFactor& factor,
                                  const MatX& functionals, const MatX& loads, const SeeDuals& see = {});

/// The duals of functionals.
struct FoundDuals {
  MatX z;     ///< n x F
  VecX sums;  ///< of each the sum of the cells' parts without their signs
};

FoundDuals find_duals(const Problem& problem, const VecX& u, const ContactFactor& factor, const MatX& functionals);

}  // namespace mortise
