// Products of the errors that recovered stresses show.
#pragma once

#include "fem/cell_sampler.hpp"
#include "fem/patch_recovery.hpp"

namespace mortise {

/// Products of recovered errors d_k = sigma*_k - sigma_h,k, times depth (model/model.hpp).
struct ErrorProducts {
  MatX products;  ///< cells x F: int d_0 : C^-1 : d_k; column 0 estimates the cell's share of the squared energy norm
                  ///< of the error of field 0 (twice its energy)
  VecX norms;     ///< of each cell: int sigma*_0 : C^-1 : sigma*_0, initial strains included
  VecX areas;     ///< of each cell
};

/// Displacements, n x F, and the patches that they make.
struct RecoveredFields {
  MatX fields;
  StressPatches patches;
};

/// The same, in the order in which the products of another field with them are found: of each component all fields.
struct OtherFields {
  std::vector<int> row;        ///< StressPatches::row
  FieldStresses coefficients;  ///< a column a component and field, the fields of one component beside each other
  NodalFields u;

  OtherFields() = default;
  OtherFields(const RecoveredFields& fields);
  Eigen::Index count() const { return u.cols() / 2; }
};

/// sigma* as recovered_stress. `field`: field 0 alone, `others`: those after it, some and then more. What field 0 does
/// to the patches and to the nodes of a cell is found once; each further field costs a few products a cell.
ErrorProducts error_products(const Mesh& mesh, const BodyPoints& points, const std::vector<ElasticLaw>& laws,
                             const RecoveredFields& field, const std::vector<const OtherFields*>& others);

}  // namespace mortise
