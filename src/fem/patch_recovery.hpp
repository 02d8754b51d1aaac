// Stresses that are better than the elements' own, and the energy error that they show.
#pragma once

#include "fem/stress.hpp"

namespace mortise {

/// Stress (11, 22, 33, 12) as a polynomial about a vertex.
struct StressPatch {
  Vec2 centre = Vec2::Zero();
  double size = 1;  ///< of the patch, length: the polynomial is in (x - centre) / size
  int terms = 0;    ///< 1, x, y, x^2, xy, y^2: 1, 3 or 6 of them; 0: no vertex
  Eigen::Matrix<double, 6, 4> coefficients = Eigen::Matrix<double, 6, 4>::Zero();

  Vec4 at(const Vec2& x) const;
};

/// Superconvergent patch recovery (Zienkiewicz & Zhu 1992): at each vertex of each body (by body point) the polynomial
/// that fits the stresses at the superconvergent points of the cells around it in least squares, of degree 2 if these
/// are quadratic, else 1; where they are few, as on the boundary, the cells around these too. `samples`: a row a point,
/// cell after cell, as gauss_stresses() gives them.
std::vector<StressPatch> recover_patches(const Mesh& mesh, const BodyPoints& points, const Stresses& samples);

/// Energies per thickness times two, with d = sigma* - sigma_h.
struct EnergyErrors {
  VecX errors;      ///< of each cell int d : C^-1 : d, an estimate of its share of the squared energy norm of the error
  VecX areas;       ///< of each cell
  double norm = 0;  ///< int sigma* : C^-1 : sigma*, of all cells
};

/// sigma* blends the patches of a cell's vertices by the linear shape functions of its corners.
EnergyErrors energy_errors(const Mesh& mesh, const BodyPoints& points, const std::vector<ElasticLaw>& laws,
                           const VecX& u, const std::vector<StressPatch>& patches);

}  // namespace mortise
