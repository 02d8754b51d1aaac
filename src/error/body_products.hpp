// Products of recovered errors, body by body.
#pragma once

#include "fem/patch_recovery.hpp"

namespace mortise {

/// error_products of the patches that recover_patches makes of `fields` (n x F, displacements): the same figures, found
/// for each body alone, on all cores.
ErrorProducts products_by_body(const Mesh& mesh, const BodyPoints& points, const std::vector<ElasticLaw>& laws,
                               const MatX& fields);

}  // namespace mortise
